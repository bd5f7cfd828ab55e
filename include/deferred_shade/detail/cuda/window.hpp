// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include <deferred_shade/detail/cuda/architectures.hpp>
#include <deferred_shade/detail/cuda/call.hpp>
#include <deferred_shade/detail/cuda/launch.hpp>
#include <deferred_shade/detail/cuda/tuning.hpp>
#include <deferred_shade/detail/cuda/window_grouping.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade::detail {
inline namespace DEFERRED_SHADE_ARCHITECTURES {

/// Runs the requests of every window in shader order.
template <std::uint32_t Threads, class... Shaders>
__global__ void __launch_bounds__(Threads)
    window_kernel(window_grouping windows, std::size_t maximum,
                  shader_list<Shaders...> const __grid_constant__ shaders) {
  detail::begin_after_earlier_kernels();
  std::size_t const p = std::size_t{blockIdx.x} * blockDim.x + threadIdx.x;
  std::size_t const window = p / window_size;
  if (p >= maximum || p % window_size >= windows.used[window]) return;
  std::uint32_t const request = windows.sorted[p];
  shaders.visit(request >> 24, run_on_device{static_cast<request_index>(window * window_size +
                                                                        (request & 0xffffff))});
}

/// Whether a table of `shaders` shaders is run in windows.
template <class Workspace>
constexpr bool has_windows(cuda_system, shader_id shaders) {
  return cuda_tuning_of<Workspace>::windows(shaders);
}

template <class Policy, class Count, class Ids, class... Shaders, class Workspace>
void run_windows(cuda_system, Policy const& exec, Count n, Ids ids,
                 shader_table<Shaders...> const& shaders, Workspace& scratch) {
  using tuning = cuda_tuning_of<Workspace>;
  static_assert(sizeof...(Shaders) <= warp_size,
                "deferred_shade: cuda_tuning::windows must be false for more than 32 shaders");
  window_grouping const windows =
      detail::group_windows<sizeof...(Shaders)>(detail::stream_of(exec), n, ids, scratch);
  [[maybe_unused]] auto const dispatched = scratch.begin_phase({"dispatch"});
  std::size_t const maximum = detail::maximum_of(n);
  constexpr std::uint32_t threads = tuning::window_threads(sizeof...(Shaders));
  // Without that preference, the kernel runs with what the sort leaves of the first-level cache:
  // next to nothing.
  launch_shape const shape{detail::blocks_for(maximum, threads), threads, 0, true};
  detail::launch<&window_kernel<threads, Shaders...>>(
      "window_sort_then_dispatch", detail::stream_of(exec), shape, windows, maximum, shaders);
}

}  // namespace DEFERRED_SHADE_ARCHITECTURES
}  // namespace deferred_shade::detail
