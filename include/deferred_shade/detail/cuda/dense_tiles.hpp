// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include <deferred_shade/detail/cuda/architectures.hpp>
#include <deferred_shade/detail/cuda/begin_tile.hpp>
#include <deferred_shade/detail/cuda/call.hpp>
#include <deferred_shade/detail/cuda/launch.hpp>
#include <deferred_shade/detail/cuda/occupancy.hpp>
#include <deferred_shade/detail/cuda/tile_sort.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade::detail {
inline namespace DEFERRED_SHADE_ARCHITECTURES {

/// Sorts one tile and runs the switch over the sorted requests. Warps diverge only where the
/// requests of one shader end and those of the next begin.
template <std::uint32_t Threads, std::uint32_t Items, class Count, class Ids, class... Shaders>
__global__ void __launch_bounds__(Threads)
    dense_kernel(Count n, Ids ids, shader_list<Shaders...> const __grid_constant__ shaders) {
  using sort = tile_sort<sizeof...(Shaders), Threads, Items>;
  static_assert((sizeof...(Shaders) + 1) * sort::size <= 0x10000,
                "deferred_shade: cuda_tuning::tile must not choose dense for more than 63 shaders");
  __shared__ typename sort::temporary_storage temporary;
  __shared__ std::uint32_t starts[sort::columns];
  __shared__ std::uint16_t order[sort::size];  // shaders and positions
  request_index first;
  std::uint32_t size;
  if (!detail::begin_tile<sort::size>(n, first, size)) return;

  std::uint32_t keys[Items];
  std::uint32_t places[Items];
  sort::load(ids, first, size, keys);
  sort::find_places(temporary, keys, places, starts);
#pragma unroll
  for (std::uint32_t item = 0; item < Items; ++item) {
    order[places[item]] =
        static_cast<std::uint16_t>(keys[item] * sort::size + sort::position(item));
  }
  __syncthreads();
#pragma unroll 1
  for (std::uint32_t item = 0; item < Items; ++item) {
    std::uint32_t const entry = order[item * Threads + threadIdx.x];
    shaders.visit(entry / sort::size, run_on_device{first + entry % sort::size});
  }
}

template <class Tuning, std::uint32_t Items, class Policy, class Count, class Ids, class... Shaders>
void launch_dense(Policy const& exec, Count n, Ids ids, shader_table<Shaders...> const& shaders) {
  detail::launch<&dense_kernel<Tuning::dense_threads, Items, Count, Ids, Shaders...>>(
      "local_sort_then_dispatch", detail::stream_of(exec),
      {detail::blocks_for(detail::maximum_of(n), Tuning::dense_threads * Items),
       Tuning::dense_threads},
      n, ids, shaders);
}

// Unused bytes of a fetched sector stay in the second-level cache for neighbouring requests of the
// tile. With one request for each thread, no more requests are under way than in a plain switch,
// and the cache has room. With several, warps are fuller: they are used if all of the batch then
// runs at once.
template <class Tuning, class Policy, class Count, class Ids, class... Shaders>
void run_dense_tiles(Policy const& exec, Count n, Ids ids,
                     shader_table<Shaders...> const& shaders) {
  std::size_t const maximum = detail::maximum_of(n);
  auto const occupancy = detail::occupancy_of<
      &dense_kernel<Tuning::dense_threads, Tuning::dense_items, Count, Ids, Shaders...>>(
      Tuning::dense_threads);
  std::size_t const threads = occupancy.resident_blocks * Tuning::dense_threads;
  if (threads < maximum && maximum <= threads * Tuning::dense_items) {
    detail::launch_dense<Tuning, Tuning::dense_items>(exec, n, ids, shaders);
  } else {
    detail::launch_dense<Tuning, 1>(exec, n, ids, shaders);
  }
}

}  // namespace DEFERRED_SHADE_ARCHITECTURES
}  // namespace deferred_shade::detail
