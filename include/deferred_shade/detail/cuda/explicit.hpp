// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include <deferred_shade/detail/cuda/launch.hpp>
#include <deferred_shade/detail/cuda/occupancy.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade::detail {

/// Runs one shader on the requests that name it.
template <shader_id Id, shader_id Shaders, class Count, class Ids, class Shader>
__global__ void masked_kernel(bool first, Count n, Ids ids, Shader const __grid_constant__ shader) {
  independent_kernel const among_those_of_all_shaders(first);
  std::size_t const p = std::size_t{blockIdx.x} * blockDim.x + threadIdx.x;
  auto const i = static_cast<request_index>(p);
  if (p < size_of(n) && detail::shader_of(ids, i, Shaders) == Id) static_cast<void>(shader(i));
}

/// Runs one shader on its segment. The grid does not know how long that is: a block takes one
/// stretch after another until none is left.
template <class Shader>
__global__ void segment_kernel(bool first, request_index const* permutation,
                               request_index const* offset, Shader const __grid_constant__ shader) {
  independent_kernel const among_those_of_all_shaders(first);
  std::size_t const end = offset[1];
  std::size_t const stride = std::size_t{gridDim.x} * blockDim.x;
  std::size_t p = offset[0] + std::size_t{blockIdx.x} * blockDim.x + threadIdx.x;
  for (; p < end; p += stride) static_cast<void>(shader(permutation[p]));
}

template <class Policy, class Count, class Ids, class... Shaders, class Workspace>
void run_explicit(cuda_system, Policy const& exec, Count n, Ids ids,
                  shader_table<Shaders...> const& shaders, Workspace const& scratch) {
  cudaStream_t const stream = stream_of(exec);
  auto const expected = shaders.expected();
  bool first = true;
  shaders.for_each([&](auto id, auto const& shader) {
    if (!expected[id]) return;
    [[maybe_unused]] auto const running = scratch.begin_phase({"shader", id});
    using type = std::decay_t<decltype(shader)>;
    constexpr auto kernel =
        &masked_kernel<decltype(id)::value, sizeof...(Shaders), Count, Ids, type>;
    std::uint32_t const threads = occupancy_of<kernel>(declared_block_size<type>).threads;
    launch<kernel>("explicit_serialization", stream, {blocks_for(maximum_of(n), threads), threads},
                   std::exchange(first, false), n, ids, shader);
  });
}

template <class Policy, class... Shaders, class Workspace>
void run_explicit(cuda_system, Policy const& exec, grouping group,
                  shader_table<Shaders...> const& shaders, Workspace const& scratch) {
  cudaStream_t const stream = stream_of(exec);
  auto const expected = shaders.expected();
  bool first = true;
  shaders.for_each([&](auto id, auto const& shader) {
    if (!expected[id]) return;
    [[maybe_unused]] auto const running = scratch.begin_phase({"shader", id});
    using type = std::decay_t<decltype(shader)>;
    constexpr auto kernel = &segment_kernel<type>;
    auto const [threads, resident] = occupancy_of<kernel>(declared_block_size<type>);
    // Enough for an equal share of the requests, and to fill the device if one shader has them all.
    std::size_t const share = blocks_for(group.maximum / expected.count(), threads);
    std::size_t const blocks =
        (std::min)(blocks_for(group.maximum, threads), (std::max)(resident, share));
    launch<kernel>("explicit_serialization", stream, {blocks, threads}, std::exchange(first, false),
                   group.permutation, group.offsets + id, shader);
  });
}

}  // namespace deferred_shade::detail
