// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <deferred_shade/detail/cuda/architectures.hpp>
#include <deferred_shade/detail/cuda/copied_ids.hpp>
#include <deferred_shade/detail/cuda/lane_bucket.hpp>
#include <deferred_shade/detail/cuda/launch.hpp>
#include <deferred_shade/detail/cuda/tuning.hpp>
#include <deferred_shade/detail/cuda/warp.hpp>
#include <deferred_shade/types.hpp>
#include <deferred_shade/workspace.hpp>

// Buckets of each window of the batch by itself. Windows do not depend on each other and need no
// scan: a tile adds up the counts of its window.

namespace deferred_shade::detail {
inline namespace DEFERRED_SHADE_ARCHITECTURES {

/// The requests of a batch, sorted by shader inside each window: a view of memory of a workspace.
struct window_grouping {
  std::uint32_t const*
      sorted;                 ///< the shader in the upper 8 bits, the position in the window below
  std::uint32_t const* used;  ///< for each window, the requests that name a shader: they come first
};

/// The places of requests in windows, from the counts of each tile.
template <shader_id Shaders>
struct window_output {
  std::uint32_t const* counts;
  std::uint32_t* sorted;
  std::uint32_t* used;

  struct shared_memory {
    std::uint32_t totals[bucket_warps][warp_size];
    std::uint32_t earlier[bucket_warps][warp_size];
  };

  /// Every warp adds up the counts of its share of the window's tiles, a shader in each lane.
  __device__ void prepare(shared_memory& shared) const {
    constexpr std::uint32_t share = window_tiles / bucket_warps;
    std::uint32_t const lane = threadIdx.x % warp_size;
    std::uint32_t const warp = threadIdx.x / warp_size;
    std::uint32_t const first = blockIdx.x / window_tiles * window_tiles + warp * share;
    std::uint32_t total = 0;
    std::uint32_t earlier = 0;
#pragma unroll
    for (std::uint32_t tile = first; tile < first + share; ++tile) {
      bool const exists = tile < gridDim.x && lane < Shaders;
      std::uint32_t const count = exists ? counts[std::size_t{tile} * Shaders + lane] : 0;
      total += count;
      if (tile < blockIdx.x) earlier += count;
    }
    shared.totals[warp][lane] = total;
    shared.earlier[warp][lane] = earlier;
  }

  /// The first place for requests of this block's tile that name the shader of this lane.
  __device__ std::uint32_t place_of_lane(shared_memory const& shared) const {
    std::uint32_t const lane = threadIdx.x % warp_size;
    std::uint32_t const window = blockIdx.x / window_tiles;
    std::uint32_t total = 0;
    std::uint32_t earlier = 0;
#pragma unroll
    for (std::uint32_t w = 0; w < bucket_warps; ++w) {
      total += shared.totals[w][lane];
      earlier += shared.earlier[w][lane];
    }
    std::uint32_t const begin = detail::exclusive_sum_of_warp(total);
    if (blockIdx.x % window_tiles == 0 && threadIdx.x == Shaders - 1) used[window] = begin + total;
    return window * window_size + begin + earlier;
  }

  __device__ void write(std::uint32_t place, request_index, std::uint32_t slot) const {
    sorted[place] = slot + blockIdx.x % window_tiles * bucket_tile;
  }
};

template <shader_id Shaders, class Count, class Ids, class Workspace>
window_grouping group_windows(cudaStream_t stream, Count n, Ids ids, Workspace& scratch) {
  [[maybe_unused]] auto const grouped = scratch.begin_phase({"group"});
  std::size_t const maximum = detail::maximum_of(n);
  std::size_t const tiles = detail::blocks_for(maximum, bucket_tile);
  using passes = two_passes<Shaders, Ids>;
  using first_ids = typename passes::first;
  using second_ids = typename passes::second;
  using output = window_output<Shaders>;
  auto const [sorted, counts, used, copy] = scratch.take(
      elements<std::uint32_t>(maximum), elements<std::uint32_t>(tiles * Shaders),
      elements<std::uint32_t>(detail::blocks_for(maximum, window_size)), passes::memory(maximum));
  launch_shape const shape{tiles, bucket_threads};
  detail::launch<&lane_bucket_count_kernel<Shaders, Count, first_ids>>(
      "window count", stream, shape, n, passes::read_first(ids, copy),
      tile_count_layout{1, Shaders}, counts);
  detail::launch<&lane_bucket_place_kernel<Shaders, passes::copies, Count, second_ids, output>>(
      "window place", stream, shape, n, passes::read_second(ids, copy),
      output{counts, sorted, used});
  return {sorted, used};
}

}  // namespace DEFERRED_SHADE_ARCHITECTURES
}  // namespace deferred_shade::detail
