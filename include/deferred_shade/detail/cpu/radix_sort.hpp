// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thrust/sort.h>
#include <thrust/system/cpp/execution_policy.h>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <new>
#include <numeric>
#include <utility>

#include <deferred_shade/detail/cpu/block_partition.hpp>
#include <deferred_shade/detail/cpu/counting_sort.hpp>
#include <deferred_shade/detail/fail.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/types.hpp>
#include <deferred_shade/workspace.hpp>

namespace deferred_shade::detail {

/// Hands out a piece of a workspace to a Thrust algorithm, front to back, and takes nothing back.
class arena {
 public:
  using value_type = std::byte;

  arena(std::byte* first, std::size_t size) noexcept : next_(first), last_(first + size) {}

  std::byte* allocate(std::size_t size) {
    std::size_t const aligned = (size + 15) / 16 * 16;
    if (aligned > static_cast<std::size_t>(last_ - next_)) detail::fail<std::bad_alloc>();
    return std::exchange(next_, next_ + aligned);
  }
  void deallocate(std::byte*, std::size_t) noexcept {}

 private:
  std::byte* next_;
  std::byte* last_;
};

/// What is sorted: keys of one byte, and else of four. With keys of two bytes, Thrust takes 512 KiB
/// of a worker's stack; of four bytes, it skips those that are the same in all keys.
template <shader_id Shaders>
using radix_key = std::conditional_t<(Shaders <= 0xff), std::uint8_t, std::uint32_t>;

constexpr std::size_t radix_bytes(host_system, std::size_t n, std::size_t shaders) {
  std::size_t const key = shaders <= 0xff ? 1 : 4;
  std::size_t const pair = key + sizeof(request_index);
  return 2 * detail::array_bytes<request_index>(n) + detail::array_bytes<std::byte>(n * key) +
         detail::array_bytes<std::byte>((n + 63) / 64 * 64 * pair) +
         detail::array_bytes<std::uint32_t>(block_partition::max_counters(n, shaders)) +
         detail::array_bytes<request_index>(shaders + 1);
}

/// Sorts `size` keys stably, and their indices with them. `temporary` has room for as many pairs
/// again, rounded up to a multiple of 64.
template <class Key>
void sort_pairs(Key* keys, request_index* indices, std::size_t size, std::byte* temporary) {
  std::size_t const room = (size + 63) / 64 * 64;
#if DEFERRED_SHADE_HAS_EXCEPTIONS && THRUST_HOST_SYSTEM == THRUST_HOST_SYSTEM_CPP
  arena memory(temporary, room * (sizeof(Key) + sizeof(request_index)));
  thrust::stable_sort_by_key(thrust::cpp::par(memory), keys, keys + size, indices);
#else
  // Thrust's sort does not compile: it throws; and where plain pointers belong to another system,
  // it finds none that it shares with cpp. A counting sort for each byte.
  auto* const other_indices = reinterpret_cast<request_index*>(temporary);
  auto* const other_keys = reinterpret_cast<Key*>(other_indices + room);
  for (std::size_t byte = 0; byte < sizeof(Key); ++byte) {
    auto const digit = [byte](Key key) { return key >> 8 * byte & 0xff; };
    std::size_t next[257] = {};
    for (std::size_t i = 0; i < size; ++i) ++next[digit(keys[i]) + 1];
    std::partial_sum(next, next + 257, next);
    for (std::size_t i = 0; i < size; ++i) {
      std::size_t const place = next[digit(keys[i])]++;
      other_keys[place] = keys[i];
      other_indices[place] = indices[i];
    }
    std::copy_n(other_keys, size, keys);
    std::copy_n(other_indices, size, indices);
  }
#endif
}

template <shader_id Shaders, class Policy, class Ids, class Workspace>
grouping radix_grouping(host_system, Policy const& exec, request_index n, Ids ids,
                        Workspace& scratch) {
  using key = radix_key<Shaders>;
  block_partition const blocks(n, Shaders);
  constexpr shader_id columns = Shaders + 1;
  constexpr std::size_t pair_size = sizeof(key) + sizeof(request_index);
  auto const [permutation, keys, indices, temporary, counts, offsets] =
      scratch.take(elements<request_index>(n), elements<key>(n), elements<request_index>(n),
                   elements<std::byte>((std::size_t{n} + 63) / 64 * 64 * pair_size),
                   elements<std::uint32_t>(blocks.max_count(n, Shaders) * columns),
                   elements<request_index>(columns));

  detail::for_each_block(
      exec, blocks,
      [=, keys = keys, indices = indices, temporary = temporary, counts = counts](std::size_t b) {
        std::size_t const begin = blocks.begin(b);
        std::size_t const size = blocks.end(b) - begin;
        key* const first = keys + begin;
        detail::load_keys<Shaders>(detail::ids_from(ids, static_cast<request_index>(begin)), size,
                                   first);
        std::iota(indices + begin, indices + begin + size, static_cast<request_index>(begin));
        detail::sort_pairs(first, indices + begin, size, temporary + begin * pair_size);

        std::uint32_t* const row = counts + b * columns;
        key const* run = first;
        for (shader_id k = 0; k <= Shaders; ++k) {
          auto const end = std::upper_bound<key const*>(run, first + size, static_cast<key>(k));
          row[k] = static_cast<std::uint32_t>(end - run);
          run = end;
        }
      });
  detail::scan_columns(blocks, columns, counts, offsets);
  detail::for_each_block(exec, blocks,
                         [=, permutation = permutation, indices = indices, counts = counts,
                          offsets = offsets](std::size_t b) {
                           std::uint32_t const* const row = counts + b * columns;
                           request_index const* run = indices + blocks.begin(b);
                           for (shader_id k = 0; k < Shaders; ++k) {
                             // The next block's place in the segment, or the segment's end, tells
                             // how long the run is.
                             std::uint32_t const end =
                                 b + 1 < blocks.count() ? row[columns + k] : offsets[k + 1];
                             std::copy_n(run, end - row[k], permutation + row[k]);
                             run += end - row[k];
                           }
                         });
  return {permutation, offsets, n};
}

}  // namespace deferred_shade::detail
