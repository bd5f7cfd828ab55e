// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include <deferred_shade/detail/cuda/launch.hpp>
#include <deferred_shade/detail/cuda/packed_tiles.hpp>
#include <deferred_shade/detail/cuda/staged_tiles.hpp>
#include <deferred_shade/detail/cuda/staging.hpp>
#include <deferred_shade/detail/cuda/tile_rows.hpp>
#include <deferred_shade/detail/cuda/tile_sort.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/detail/tile_sorts.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade::detail {

// A tile is the largest that a multiprocessor has room for with two blocks: all warps of a block
// then run the same shader at the same time, or nearly, and share its instructions.
inline constexpr std::uint32_t tile_threads = 512;
inline constexpr std::uint32_t tile_items = 8;

/// The largest table that a tile has counters for in shared memory; larger ones sort with bitonic.
inline constexpr shader_id most_tile_shaders = 255;

/// Sorts one tile, shades it row by row: a row is 32 requests of one shader, or what is left of
/// them, and a warp takes the next row as soon as it has done one.
template <class Count, class Ids, class... Shaders>
__global__ void __launch_bounds__(tile_threads)
    tile_kernel(Count n, Ids ids, shader_table<Shaders...> const __grid_constant__ shaders) {
  using sort = tile_sort<sizeof...(Shaders), tile_threads, tile_items>;
  __shared__ typename sort::temporary_storage temporary;
  __shared__ std::uint32_t starts[sort::columns];
  __shared__ tile_rows<sort> rows;
  __shared__ std::uint16_t order[sort::size];
  begin_after_earlier_kernels();
  std::size_t const tile = std::size_t{blockIdx.x} * sort::size;
  std::size_t const end = size_of(n);
  if (tile >= end) return;
  auto const first = static_cast<request_index>(tile);
  auto const size = static_cast<std::uint32_t>((min)(std::size_t{sort::size}, end - tile));

  std::uint32_t keys[tile_items];
  std::uint32_t places[tile_items];
  sort::load(ids, first, size, keys);
  sort::find_places(temporary, keys, places, starts);
  __syncthreads();
#pragma unroll
  for (std::uint32_t item = 0; item < tile_items; ++item) {
    if (sort::has_place(keys[item]))
      order[places[item]] = static_cast<std::uint16_t>(sort::position(item));
  }
  rows.find(starts);
  __syncthreads();
  rows.for_each(starts,
                [&](shader_id id, std::uint32_t place) { shaders.run(id, first + order[place]); });
}

/// Sorts a block of 256 requests by a bitonic network and runs the switch over them.
template <class Count, class Ids, class... Shaders>
__global__ void __launch_bounds__(bitonic::tile)
    bitonic_kernel(Count n, Ids ids, shader_table<Shaders...> const __grid_constant__ shaders) {
  __shared__ std::uint32_t keys[bitonic::tile];
  begin_after_earlier_kernels();
  std::uint32_t const t = threadIdx.x;
  std::size_t const tile = std::size_t{blockIdx.x} * bitonic::tile;
  std::size_t const end = size_of(n);
  if (tile >= end) return;
  auto const first = static_cast<request_index>(tile);
  std::uint32_t key = 0xffffffffU;
  if (tile + t < end) {
    key = bitonic_key<sizeof...(Shaders)>(detail::shader_of(ids, first + t, sizeof...(Shaders)), t);
  }
  // Each pair of lanes compares what each other holds; one keeps the smaller and one the larger
  // key.
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
  if (key != 0xffffffffU) shaders.run(key / bitonic::tile, first + key % bitonic::tile);
}

template <class Policy, class Count, class Ids, class... Shaders>
void run_tiles(cuda_system, bitonic, Policy const& exec, Count n, Ids ids,
               shader_table<Shaders...> const& shaders) {
  constexpr std::uint32_t threads = bitonic::tile;
  launch<&bitonic_kernel<Count, Ids, Shaders...>>(
      "local_sort_then_dispatch<bitonic>", stream_of(exec),
      {blocks_for(maximum_of(n), threads), threads}, n, ids, shaders);
}

template <class Policy, class Count, class Ids, class... Shaders>
void run_tiles(cuda_system, counting, Policy const& exec, Count n, Ids ids,
               shader_table<Shaders...> const& shaders) {
  if constexpr (sizeof...(Shaders) > most_tile_shaders) {
    run_tiles(cuda_system{}, bitonic{}, exec, n, ids, shaders);
  } else if constexpr (staging<Shaders...>::possible) {
    run_staged(exec, n, ids, shaders);
  } else if constexpr (sizeof...(Shaders) <= most_packed_shaders) {
    run_packed_tiles(exec, n, ids, shaders);
  } else {
    launch<&tile_kernel<Count, Ids, Shaders...>>(
        "local_sort_then_dispatch", stream_of(exec),
        {blocks_for(maximum_of(n), tile_threads * tile_items), tile_threads}, n, ids, shaders);
  }
}

}  // namespace deferred_shade::detail
