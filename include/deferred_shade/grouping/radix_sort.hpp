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

#include <deferred_shade/blocks.hpp>
#include <deferred_shade/grouping/counting_sort.hpp>
#include <deferred_shade/system.hpp>
#include <deferred_shade/types.hpp>
#include <deferred_shade/workspace.hpp>
#ifdef __CUDACC__
#include <deferred_shade/grouping/cuda/radix_sort.hpp>
#endif

namespace deferred_shade {
namespace detail {

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

template <shader_id Shaders, class Policy, class Ids, class Workspace>
grouping radix_grouping(host_system, Policy const& exec, request_index n, Ids ids,
                        Workspace& scratch) {
  using key = sort_key<Shaders>;
  block_partition const blocks(n, Shaders);
  constexpr shader_id columns = Shaders + 1;
  constexpr std::size_t pair_size = sizeof(key) + sizeof(request_index);
  auto const [permutation, keys, indices, temporary, counts, offsets] =
      scratch.take(elements<request_index>(n), elements<key>(n), elements<request_index>(n),
                   elements<std::byte>((std::size_t{n} + 63) / 64 * 64 * pair_size),
                   elements<std::uint32_t>(blocks.max_count(n, Shaders) * columns),
                   elements<request_index>(columns));

  for_each_block(
      exec, blocks,
      [=, keys = keys, indices = indices, temporary = temporary, counts = counts](std::size_t b) {
        std::size_t const begin = blocks.begin(b);
        std::size_t const size = blocks.end(b) - begin;
        key* const first = keys + begin;
        load_keys<Shaders>(ids_from(ids, static_cast<request_index>(begin)), size, first);
        std::iota(indices + begin, indices + begin + size, static_cast<request_index>(begin));
        arena memory(temporary + begin * pair_size, (size + 63) / 64 * 64 * pair_size);
        thrust::stable_sort_by_key(thrust::cpp::par(memory), first, first + size, indices + begin);

        std::uint32_t* const row = counts + b * columns;
        key const* run = first;
        for (shader_id k = 0; k <= Shaders; ++k) {
          auto const end = std::upper_bound<key const*>(run, first + size, static_cast<key>(k));
          row[k] = static_cast<std::uint32_t>(end - run);
          run = end;
        }
      });
  scan_columns(blocks, columns, counts, offsets);
  for_each_block(exec, blocks,
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
/// `ids` is a random-access iterator of `n` ids; `n` is a request_index, or on CUDA a device_count.
/// The result lives in `scratch` until its next use.
template <shader_id Shaders, class Policy, class Count, class Ids, class Workspace>
grouping group_by_radix_sort(Policy const& exec, Count n, Ids ids, Workspace& scratch) {
  [[maybe_unused]] auto const grouped = scratch.begin_phase({"group"});
  return detail::radix_grouping<Shaders>(detail::system_of<Policy>{}, exec, n, ids, scratch);
}

}  // namespace deferred_shade
