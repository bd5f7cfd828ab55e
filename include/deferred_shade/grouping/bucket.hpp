// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include <deferred_shade/blocks.hpp>
#include <deferred_shade/system.hpp>
#include <deferred_shade/types.hpp>
#include <deferred_shade/workspace.hpp>
#ifdef __CUDACC__
#include <deferred_shade/grouping/cuda/bucket.hpp>
#endif

namespace deferred_shade {
namespace detail {

/// Counts the requests of every shader among those from `begin` to `end`; `counts[Shaders]` takes
/// those that name none.
template <shader_id Shaders, class Ids>
void count_block(Ids const& ids, std::size_t begin, std::size_t end, std::uint32_t* counts) {
  // Neighbours often name the same shader. Four counters in turn keep the one increment from
  // waiting for the other, as long as they stay in the first-level cache.
  constexpr std::size_t ways = Shaders < 512 ? 4 : 1;
  std::uint32_t partial[ways][Shaders + 1] = {};
  std::size_t i = begin;
  for (; i + ways <= end; i += ways) {
    for (std::size_t w = 0; w < ways; ++w) {
      ++partial[w][shader_of(ids, static_cast<request_index>(i + w), Shaders)];
    }
  }
  for (; i < end; ++i) ++partial[0][shader_of(ids, static_cast<request_index>(i), Shaders)];
  for (shader_id k = 0; k <= Shaders; ++k) {
    counts[k] = 0;
    for (std::size_t w = 0; w < ways; ++w) counts[k] += partial[w][k];
  }
}

template <shader_id Shaders, class Policy, class Ids, class Workspace>
grouping bucket_grouping(host_system, Policy const& exec, request_index n, Ids ids,
                         Workspace& scratch) {
  block_partition const blocks(n, Shaders);
  constexpr shader_id columns = Shaders + 1;
  auto const [permutation, counts, offsets] = scratch.take(
      elements<request_index>(n), elements<std::uint32_t>(blocks.max_count(n, Shaders) * columns),
      elements<request_index>(columns));

  for_each_block(exec, blocks, [=, counts = counts](std::size_t b) {
    count_block<Shaders>(ids, blocks.begin(b), blocks.end(b), counts + b * columns);
  });
  scan_columns(blocks, columns, counts, offsets);
  for_each_block(exec, blocks, [=, counts = counts, permutation = permutation](std::size_t b) {
    std::uint32_t* const next = counts + b * columns;
    for (std::size_t i = blocks.begin(b); i < blocks.end(b); ++i) {
      auto const request = static_cast<request_index>(i);
      permutation[next[shader_of(ids, request, Shaders)]++] = request;
    }
  });
  return {permutation, offsets, n};
}

}  // namespace detail

/// Groups requests by one parallel stable counting pass: every block counts its shaders, a scan
/// over the counts gives each block its place in each segment, and the block puts its requests
/// there. Reads the ids twice and writes the permutation once.
///
/// `ids` is a random-access iterator of `n` ids; `n` is a request_index, or on CUDA a device_count.
/// The result lives in `scratch` until its next use.
template <shader_id Shaders, class Policy, class Count, class Ids, class Allocator>
grouping group_by_bucket(Policy const& exec, Count n, Ids ids, workspace<Allocator>& scratch) {
  return detail::bucket_grouping<Shaders>(detail::system_of<Policy>{}, exec, n, ids, scratch);
}

}  // namespace deferred_shade
