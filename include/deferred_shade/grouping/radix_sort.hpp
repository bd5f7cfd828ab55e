// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thrust/binary_search.h>
#include <thrust/copy.h>
#include <thrust/execution_policy.h>
#include <thrust/sequence.h>
#include <thrust/sort.h>
#include <thrust/system/cpp/execution_policy.h>
#include <cstddef>
#include <cstdint>
#include <new>
#include <type_traits>

#include <deferred_shade/blocks.hpp>
#include <deferred_shade/types.hpp>
#include <deferred_shade/workspace.hpp>

namespace deferred_shade {
namespace detail {

/// The narrowest key that holds the ids 0 to `Shaders`, the last one for requests that name none.
template <shader_id Shaders>
using sort_key =
    std::conditional_t<(Shaders <= 0xff), std::uint8_t,
                       std::conditional_t<(Shaders <= 0xffff), std::uint16_t, std::uint32_t>>;

/// Hands out a piece of a workspace to a Thrust algorithm, front to back, and takes nothing back.
class arena {
 public:
  using value_type = std::byte;

  arena(std::byte* first, std::size_t size) noexcept : next_(first), last_(first + size) {}

  std::byte* allocate(std::size_t size) {
    std::size_t const aligned = (size + 15) / 16 * 16;
    if (aligned > static_cast<std::size_t>(last_ - next_)) throw std::bad_alloc();
    return std::exchange(next_, next_ + aligned);
  }
  void deallocate(std::byte*, std::size_t) noexcept {}

 private:
  std::byte* next_;
  std::byte* last_;
};

}  // namespace detail

/// Groups requests by Thrust's radix sort of (id, index) pairs. The keys are no wider than the
/// table needs, so that 255 shaders take a single pass over one byte.
///
/// Every block is sorted by the worker that owns it, with temporary memory from the workspace; a
/// scan over the lengths of the runs gives each run its place, and the block copies its runs there.
/// (Thrust's own parallel sort on a CPU allocates for every call and merges block by block.)
///
/// For two-byte keys and blocks of 32768 requests or more, Thrust takes 512 KiB of a worker's
/// stack.
///
/// `ids` is a random-access iterator of `n` ids. The result lives in `scratch` until its next use.
template <shader_id Shaders, class Policy, class Ids, class Allocator>
grouping group_by_radix_sort(Policy const& exec, request_index n, Ids ids,
                             workspace<Allocator>& scratch) {
  using key = detail::sort_key<Shaders>;
  detail::block_partition const blocks(n, Shaders);
  constexpr shader_id columns = Shaders + 1;
  constexpr std::size_t pair_size = sizeof(key) + sizeof(request_index);
  std::size_t const padded = (std::size_t{n} + 63) / 64 * 64;
  auto const [permutation, keys, indices, temporary, counts, offsets] =
      scratch.take(elements<request_index>(n), elements<key>(n), elements<request_index>(n),
                   elements<std::byte>(padded * pair_size),
                   elements<std::uint32_t>(blocks.max_count(n, Shaders) * columns),
                   elements<request_index>(columns));

  detail::for_each_block(
      exec, blocks,
      [=, keys = keys, indices = indices, temporary = temporary, counts = counts](std::size_t b) {
        std::size_t const begin = blocks.begin(b);
        std::size_t const size = blocks.end(b) - begin;
        key* const first = keys + begin;
        for (std::size_t i = 0; i < size; ++i) {
          first[i] =
              static_cast<key>(shader_of(ids, static_cast<request_index>(begin + i), Shaders));
        }
        thrust::sequence(thrust::seq, indices + begin, indices + begin + size,
                         static_cast<request_index>(begin));
        detail::arena memory(temporary + begin * pair_size, (size + 63) / 64 * 64 * pair_size);
        thrust::stable_sort_by_key(thrust::cpp::par(memory), first, first + size, indices + begin);

        std::uint32_t* const row = counts + b * columns;
        key const* run = first;
        for (shader_id k = 0; k <= Shaders; ++k) {
          key const* const end = thrust::upper_bound(
              thrust::seq, run, static_cast<key const*>(first + size), static_cast<key>(k));
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
                             thrust::copy_n(thrust::seq, run, end - row[k], permutation + row[k]);
                             run += end - row[k];
                           }
                         });
  return {permutation, offsets};
}

}  // namespace deferred_shade
