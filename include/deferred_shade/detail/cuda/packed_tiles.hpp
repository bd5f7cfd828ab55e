// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include <deferred_shade/detail/cuda/launch.hpp>
#include <deferred_shade/detail/cuda/occupancy.hpp>
#include <deferred_shade/detail/cuda/tile_sort.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade::detail {

/// The largest table whose index shaders run in packed tiles: with more, a tile as small as those
/// has less than a warp's worth of requests of each.
inline constexpr shader_id most_packed_shaders = 8;

inline constexpr std::uint32_t packed_threads = 256;

/// What a tile has for each thread where it takes more than one.
inline constexpr std::uint32_t packed_items = 4;

/// Sorts one tile and runs the switch over it, shader next to shader: warps diverge where one ends
/// and the next begins, and nowhere else.
template <std::uint32_t Items, class Count, class Ids, class... Shaders>
__global__ void __launch_bounds__(packed_threads)
    packed_kernel(Count n, Ids ids, shader_table<Shaders...> const __grid_constant__ shaders) {
  using sort = tile_sort<sizeof...(Shaders), packed_threads, Items>;
  static_assert((sizeof...(Shaders) + 1) * sort::size <= 0x10000,
                "deferred_shade: a shader and a position in a tile must fit in 16 bits");
  __shared__ typename sort::temporary_storage temporary;
  __shared__ std::uint32_t starts[sort::columns];
  __shared__ std::uint16_t order[sort::size];  // shaders and positions
  begin_after_earlier_kernels();
  std::size_t const tile = std::size_t{blockIdx.x} * sort::size;
  std::size_t const end = size_of(n);
  if (tile >= end) return;
  auto const first = static_cast<request_index>(tile);
  auto const size = static_cast<std::uint32_t>((min)(std::size_t{sort::size}, end - tile));

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
    std::uint32_t const entry = order[item * packed_threads + threadIdx.x];
    shaders.run(entry / sort::size, first + entry % sort::size);
  }
}

template <std::uint32_t Items, class Policy, class Count, class Ids, class... Shaders>
void launch_packed(Policy const& exec, Count n, Ids ids, shader_table<Shaders...> const& shaders) {
  launch<&packed_kernel<Items, Count, Ids, Shaders...>>(
      "local_sort_then_dispatch", stream_of(exec),
      {blocks_for(maximum_of(n), packed_threads * Items), packed_threads}, n, ids, shaders);
}

// What a request leaves over of the memory that is read or written for it waits in the second-level
// cache for its neighbours in the tile. With one request for each thread, no more of them are under
// way than in a plain switch, and the cache has room. Several for each thread fill warps better,
// and are taken where the batch is so small that it is under way as a whole then.
template <class Policy, class Count, class Ids, class... Shaders>
void run_packed_tiles(Policy const& exec, Count n, Ids ids,
                      shader_table<Shaders...> const& shaders) {
  std::size_t const maximum = maximum_of(n);
  auto const occupancy =
      occupancy_of<&packed_kernel<packed_items, Count, Ids, Shaders...>>(packed_threads);
  std::size_t const threads = occupancy.resident_blocks * packed_threads;
  if (threads < maximum && maximum <= threads * packed_items) {
    launch_packed<packed_items>(exec, n, ids, shaders);
  } else {
    launch_packed<1>(exec, n, ids, shaders);
  }
}

}  // namespace deferred_shade::detail
