// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include <deferred_shade/detail/cuda/launch.hpp>
#include <deferred_shade/detail/cuda/warp.hpp>
#include <deferred_shade/detail/cuda/window_grouping.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade::detail {

// The warps of a block mostly run one shader, and share its instructions. The more shaders, the
// more blocks of a multiprocessor differ in theirs, and the larger a block should be; else smaller
// ones keep it better filled.
template <class... Shaders>
inline constexpr std::uint32_t window_threads = sizeof...(Shaders) <= 8    ? 256
                                                : sizeof...(Shaders) <= 16 ? 512
                                                                           : 768;

/// Runs the requests of every window in the order of their shaders.
template <class... Shaders>
__global__ void __launch_bounds__(window_threads<Shaders...>)
    window_kernel(window_grouping windows, std::size_t maximum,
                  shader_table<Shaders...> const __grid_constant__ shaders) {
  begin_after_earlier_kernels();
  std::size_t const p = std::size_t{blockIdx.x} * blockDim.x + threadIdx.x;
  std::size_t const window = p / window_size;
  if (p >= maximum || p % window_size >= windows.used[window]) return;
  std::uint32_t const request = windows.sorted[p];
  shaders.run(request >> 24,
              static_cast<request_index>(window * window_size + (request & 0xffffff)));
}

/// Whether a table of so many shaders is run in windows.
constexpr bool has_windows(cuda_system, shader_id shaders) { return shaders <= warp_size; }

template <class Policy, class Count, class Ids, class... Shaders, class Workspace>
void run_windows(cuda_system, Policy const& exec, Count n, Ids ids,
                 shader_table<Shaders...> const& shaders, Workspace& scratch) {
  window_grouping const windows =
      group_windows<sizeof...(Shaders)>(stream_of(exec), n, ids, scratch);
  [[maybe_unused]] auto const dispatched = scratch.begin_phase({"dispatch"});
  std::size_t const maximum = maximum_of(n);
  constexpr std::uint32_t threads = window_threads<Shaders...>;
  // Else it would run with what the sort leaves of the first-level cache, next to nothing.
  launch_shape const shape{blocks_for(maximum, threads), threads, 0, true};
  launch<&window_kernel<Shaders...>>("window_sort_then_dispatch", stream_of(exec), shape, windows,
                                     maximum, shaders);
}

}  // namespace deferred_shade::detail
