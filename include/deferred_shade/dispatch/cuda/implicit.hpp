// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thrust/binary_search.h>
#include <thrust/execution_policy.h>
#include <cstddef>

#include <deferred_shade/cuda/launch.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/system.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade::detail {

/// Runs every request through the shader that it names.
template <class Count, class Ids, class... Shaders>
__global__ void switch_kernel(Count n, Ids ids,
                              shader_table<Shaders...> const __grid_constant__ shaders) {
  begin_after_earlier_kernels();
  std::size_t const p = std::size_t{blockIdx.x} * blockDim.x + threadIdx.x;
  auto const i = static_cast<request_index>(p);
  if (p < size_of(n)) shaders.run(shader_of(ids, i, sizeof...(Shaders)), i);
}

/// Runs the requests of a grouping through the shaders of their segments.
template <class... Shaders>
__global__ void segments_kernel(request_index const* permutation, request_index const* offsets,
                                shader_table<Shaders...> const __grid_constant__ shaders) {
  begin_after_earlier_kernels();
  std::size_t const p = std::size_t{blockIdx.x} * blockDim.x + threadIdx.x;
  if (p >= offsets[sizeof...(Shaders)]) return;
  request_index const* const ends = offsets + 1;
  auto const id = thrust::upper_bound(thrust::seq, ends, ends + sizeof...(Shaders), p) - ends;
  shaders.run(static_cast<shader_id>(id), permutation[p]);
}

inline constexpr std::uint32_t switch_threads = 256;

template <class Policy, class Count, class Ids, class... Shaders>
void run_implicit(cuda_system, Policy const& exec, Count n, Ids ids,
                  shader_table<Shaders...> const& shaders) {
  launch<&switch_kernel<Count, Ids, Shaders...>>(
      "implicit_serialization", stream_of(exec),
      {blocks_for(maximum_of(n), switch_threads), switch_threads}, n, ids, shaders);
}

template <class Policy, class... Shaders>
void run_implicit(cuda_system, Policy const& exec, grouping group,
                  shader_table<Shaders...> const& shaders) {
  launch<&segments_kernel<Shaders...>>("implicit_serialization", stream_of(exec),
                                       {blocks_for(group.maximum, switch_threads), switch_threads},
                                       group.permutation, group.offsets, shaders);
}

}  // namespace deferred_shade::detail
