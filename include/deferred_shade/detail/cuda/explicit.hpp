// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include <deferred_shade/detail/cuda/architectures.hpp>
#include <deferred_shade/detail/cuda/call.hpp>
#include <deferred_shade/detail/cuda/launch.hpp>
#include <deferred_shade/detail/cuda/occupancy.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/shader_traits.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade::detail {
inline namespace DEFERRED_SHADE_ARCHITECTURES {

/// Runs one shader on the requests that name it.
template <shader_id Id, shader_id Shaders, class Count, class Ids, class Shader>
__global__ void masked_kernel(bool first, Count n, Ids ids, Shader const __grid_constant__ shader) {
  independent_kernel const among_those_of_all_shaders(first);
  std::size_t const p = std::size_t{blockIdx.x} * blockDim.x + threadIdx.x;
  auto const i = static_cast<request_index>(p);
  if (p < detail::size_of(n) && detail::shader_of(ids, i, Shaders) == Id)
    detail::call_on_device(shader, i);
}

/// Runs one shader on its segment. The host does not know its length: the threads of the grid
/// stride over the segment until its end. (Blocks that take the next stretch by a counter are not
/// faster: docs/results/h200-own-kernels.md.)
template <class Shader>
__global__ void segment_kernel(bool first, request_index const* permutation,
                               request_index const* offset, Shader const __grid_constant__ shader) {
  independent_kernel const among_those_of_all_shaders(first);
  std::size_t const end = offset[1];
  std::size_t const stride = std::size_t{gridDim.x} * blockDim.x;
  std::size_t p = offset[0] + std::size_t{blockIdx.x} * blockDim.x + threadIdx.x;
  for (; p < end; p += stride) detail::call_on_device(shader, permutation[p]);
}

/// The launches of masked_kernel, one for each shader.
template <class Count, class Ids, class... Shaders>
struct masked_launches {
  std::size_t maximum;

  template <shader_id Id, class Shader>
  static constexpr auto kernel = &masked_kernel<Id, sizeof...(Shaders), Count, Ids, Shader>;

  template <shader_id Id, class Shader>
  launch_shape shape() const {
    std::uint32_t const threads =
        detail::occupancy_of<kernel<Id, Shader>>(shader_traits<Shader>::block_size).threads;
    return {detail::blocks_for(maximum, threads), threads};
  }
};

struct segment_launches {
  std::size_t maximum;
  std::size_t shaders;  // that may occur

  template <shader_id, class Shader>
  static constexpr auto kernel = &segment_kernel<Shader>;

  /// Enough blocks for an equal share of the requests, and to fill the device if one shader has
  /// them all.
  template <shader_id Id, class Shader>
  launch_shape shape() const {
    auto const [threads, resident] =
        detail::occupancy_of<kernel<Id, Shader>>(shader_traits<Shader>::block_size);
    std::size_t const share = detail::blocks_for(maximum / shaders, threads);
    return {(std::min)(detail::blocks_for(maximum, threads), (std::max)(resident, share)), threads};
  }
};

/// Calls `launch_one(id, shader, shape, first)` for all shaders that may occur, after checking that
/// all launches fit in a grid. (Shapes are computed once: the host's work for a launch takes as
/// long as a short shader on the GPU.)
template <class Launches, class... Shaders, class Workspace, class Launch>
void launch_each(Launches const& launches, shader_table<Shaders...> const& shaders,
                 Workspace const& scratch, Launch const& launch_one) {
  auto const expected = shaders.expected();
  launch_shape shapes[sizeof...(Shaders)];
  shaders.for_each([&](auto id, auto const& shader) {
    using type = std::decay_t<decltype(shader)>;
    if (!expected[id]) return;
    shapes[id] = launches.template shape<decltype(id)::value, type>();
    detail::check_grid("explicit_serialization", shapes[id]);
  });
  bool first = true;
  shaders.for_each([&](auto id, auto const& shader) {
    if (!expected[id]) return;
    [[maybe_unused]] auto const running = scratch.begin_phase({"shader", id});
    launch_one(id, shader, shapes[id], std::exchange(first, false));
  });
}

template <class Policy, class Count, class Ids, class... Shaders, class Workspace>
void run_explicit(cuda_system, Policy const& exec, Count n, Ids ids,
                  shader_table<Shaders...> const& shaders, Workspace const& scratch) {
  using launches = masked_launches<Count, Ids, Shaders...>;
  detail::launch_each(launches{detail::maximum_of(n)}, shaders, scratch,
                      [&](auto id, auto const& shader, launch_shape shape, bool first) {
                        using type = std::decay_t<decltype(shader)>;
                        detail::launch<launches::template kernel<decltype(id)::value, type>>(
                            "explicit_serialization", detail::stream_of(exec), shape, first, n, ids,
                            shader);
                      });
}

template <class Policy, class... Shaders, class Workspace>
void run_explicit(cuda_system, Policy const& exec, grouping group,
                  shader_table<Shaders...> const& shaders, Workspace const& scratch) {
  segment_launches const launches{group.maximum, shaders.expected().count()};
  detail::launch_each(
      launches, shaders, scratch, [&](auto id, auto const& shader, launch_shape shape, bool first) {
        using type = std::decay_t<decltype(shader)>;
        detail::launch<&segment_kernel<type>>("explicit_serialization", detail::stream_of(exec),
                                              shape, first, group.permutation, group.offsets + id,
                                              shader);
      });
}

}  // namespace DEFERRED_SHADE_ARCHITECTURES
}  // namespace deferred_shade::detail
