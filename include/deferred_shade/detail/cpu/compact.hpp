// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thrust/copy.h>
#include <thrust/count.h>
#include <thrust/execution_policy.h>
#include <thrust/iterator/counting_iterator.h>
#include <thrust/scan.h>
#include <bitset>
#include <cstddef>
#include <cstdint>

#include <deferred_shade/detail/cpu/block_partition.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/types.hpp>
#include <deferred_shade/workspace.hpp>

namespace deferred_shade::detail {

constexpr std::size_t compact_bytes(host_system, std::size_t n, std::size_t shaders) {
  return detail::array_bytes<request_index>(n) +
         detail::array_bytes<std::uint32_t>(block_partition::max_count(n, 0) + 1) +
         detail::array_bytes<request_index>(shaders + 1);
}

template <shader_id Shaders, class Policy, class Ids, class Workspace>
grouping compact_grouping(host_system, Policy const& exec, request_index n, Ids ids,
                          Workspace& scratch, std::bitset<Shaders> const& wanted) {
  block_partition const blocks(n, Shaders);
  auto const [permutation, counts, offsets] = scratch.take(
      elements<request_index>(n), elements<std::uint32_t>(blocks.max_count(n, Shaders) + 1),
      elements<request_index>(Shaders + 1));
  auto const request = [](std::size_t i) {
    return thrust::counting_iterator<request_index>(static_cast<request_index>(i));
  };

  offsets[0] = 0;
  for (shader_id k = 0; k < Shaders; ++k) {
    offsets[k + 1] = offsets[k];
    if (!wanted[k]) continue;
    auto const named = [ids, k](request_index i) {
      return detail::shader_of(ids, i, Shaders) == k;
    };
    detail::for_each_block(exec, blocks, [=, counts = counts](std::size_t b) {
      counts[b] = static_cast<std::uint32_t>(
          thrust::count_if(thrust::seq, request(blocks.begin(b)), request(blocks.end(b)), named));
    });
    counts[blocks.count()] = 0;
    thrust::exclusive_scan(thrust::seq, counts, counts + blocks.count() + 1, counts, offsets[k]);
    offsets[k + 1] = counts[blocks.count()];
    detail::for_each_block(
        exec, blocks, [=, counts = counts, permutation = permutation](std::size_t b) {
          thrust::copy_if(thrust::seq, request(blocks.begin(b)), request(blocks.end(b)),
                          permutation + counts[b], named);
        });
  }
  return {permutation, offsets, n};
}

}  // namespace deferred_shade::detail
