// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include <deferred_shade/detail/cuda/architectures.hpp>
#include <deferred_shade/detail/cuda/begin_tile.hpp>
#include <deferred_shade/detail/cuda/call.hpp>
#include <deferred_shade/detail/cuda/dense_tiles.hpp>
#include <deferred_shade/detail/cuda/launch.hpp>
#include <deferred_shade/detail/cuda/staged_tiles.hpp>
#include <deferred_shade/detail/cuda/staging.hpp>
#include <deferred_shade/detail/cuda/tile_rows.hpp>
#include <deferred_shade/detail/cuda/tile_sort.hpp>
#include <deferred_shade/detail/cuda/tuning.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/detail/tile_sorts.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade::detail {
inline namespace DEFERRED_SHADE_ARCHITECTURES {

/// Sorts one tile and shades it row by row. A row is up to 32 requests of one shader. A warp takes
/// the next row as soon as it has finished one.
template <std::uint32_t Threads, std::uint32_t Items, class Count, class Ids, class... Shaders>
__global__ void __launch_bounds__(Threads)
    tile_kernel(Count n, Ids ids, shader_list<Shaders...> const __grid_constant__ shaders) {
  using sort = tile_sort<sizeof...(Shaders), Threads, Items>;
  __shared__ typename sort::temporary_storage temporary;
  __shared__ std::uint32_t starts[sort::columns];
  __shared__ tile_rows<sort> rows;
  __shared__ std::uint16_t order[sort::size];
  request_index first;
  std::uint32_t size;
  if (!detail::begin_tile<sort::size>(n, first, size)) return;

  std::uint32_t keys[Items];
  std::uint32_t places[Items];
  sort::load(ids, first, size, keys);
  sort::find_places(temporary, keys, places, starts);
  __syncthreads();
#pragma unroll
  for (std::uint32_t item = 0; item < Items; ++item) {
    if (sort::has_place(keys[item]))
      order[places[item]] = static_cast<std::uint16_t>(sort::position(item));
  }
  rows.find(starts);
  __syncthreads();
  rows.for_each(starts, [&](shader_id id, std::uint32_t place) {
    shaders.visit(id, run_on_device{first + order[place]});
  });
}

/// Sorts a block of 256 requests by a bitonic network and runs the switch over them.
template <class Count, class Ids, class... Shaders>
__global__ void __launch_bounds__(bitonic::tile)
    bitonic_kernel(Count n, Ids ids, shader_list<Shaders...> const __grid_constant__ shaders) {
  __shared__ std::uint32_t keys[bitonic::tile];
  std::uint32_t const t = threadIdx.x;
  request_index first;
  std::uint32_t size;
  if (!detail::begin_tile<bitonic::tile>(n, first, size)) return;
  std::uint32_t key = 0xffffffffU;
  if (t < size) {
    key = detail::bitonic_key<sizeof...(Shaders)>(
        detail::shader_of(ids, first + t, sizeof...(Shaders)), t);
  }
  // Each pair of lanes compares its keys: one keeps the smaller and one the larger.
#pragma unroll
  for (std::uint32_t run = 2; run <= bitonic::tile; run *= 2) {
#pragma unroll
    for (std::uint32_t distance = run / 2; distance > 0; distance /= 2) {
      std::uint32_t other;
      if (distance < warp_size) {
        other = __shfl_xor_sync(all_lanes, key, static_cast<int>(distance));
      } else {
        __syncthreads();
        keys[t] = key;
        __syncthreads();
        other = keys[t ^ distance];
      }
      bool const ascending = (t & run) == 0;
      bool const lower = (t & distance) == 0;
      key = ascending == lower ? (min)(key, other) : (max)(key, other);
    }
  }
  if (key != 0xffffffffU)
    shaders.visit(key / bitonic::tile, run_on_device{first + key % bitonic::tile});
}

template <class Policy, class Count, class Ids, class... Shaders, class Workspace>
void run_tiles(cuda_system, bitonic, Policy const& exec, Count n, Ids ids,
               shader_table<Shaders...> const& shaders, Workspace const&) {
  constexpr std::uint32_t threads = bitonic::tile;
  detail::launch<&bitonic_kernel<Count, Ids, Shaders...>>(
      "local_sort_then_dispatch<bitonic>", detail::stream_of(exec),
      {detail::blocks_for(detail::maximum_of(n), threads), threads}, n, ids, shaders);
}

/// Runs every tile by the algorithm that tuning chooses.
template <class Policy, class Count, class Ids, class... Shaders, class Workspace>
void run_tiles(cuda_system here, counting, Policy const& exec, Count n, Ids ids,
               shader_table<Shaders...> const& shaders, Workspace const& scratch) {
  using tuning = cuda_tuning_of<Workspace>;
  constexpr bool records = staging<Shaders...>::possible;
  constexpr tile_algorithm algorithm = tuning::tile(sizeof...(Shaders), records);
  if constexpr (algorithm == tile_algorithm::bitonic) {
    detail::run_tiles(here, bitonic{}, exec, n, ids, shaders, scratch);
  } else if constexpr (algorithm == tile_algorithm::staged) {
    static_assert(records,
                  "deferred_shade: cuda_tuning::tile must not choose staged for tables that cannot "
                  "be staged (docs/limits.md, Records)");
    detail::run_staged<tuning>(exec, n, ids, shaders);
  } else if constexpr (algorithm == tile_algorithm::dense) {
    detail::run_dense_tiles<tuning>(exec, n, ids, shaders);
  } else {
    static_assert(
        sizeof...(Shaders) <= 255,
        "deferred_shade: cuda_tuning::tile must not choose rows for more than 255 shaders");
    detail::launch<&tile_kernel<tuning::tile_threads, tuning::tile_items, Count, Ids, Shaders...>>(
        "local_sort_then_dispatch", detail::stream_of(exec),
        {detail::blocks_for(detail::maximum_of(n), tuning::tile_threads * tuning::tile_items),
         tuning::tile_threads},
        n, ids, shaders);
  }
}

}  // namespace DEFERRED_SHADE_ARCHITECTURES
}  // namespace deferred_shade::detail
