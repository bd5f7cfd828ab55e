// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cub/block/block_scan.cuh>

#include <deferred_shade/detail/cuda/architectures.hpp>
#include <deferred_shade/detail/cuda/bucket_tile.hpp>
#include <deferred_shade/detail/cuda/copied_ids.hpp>
#include <deferred_shade/detail/cuda/launch.hpp>
#include <deferred_shade/detail/cuda/sorted_bucket_tile.hpp>
#include <deferred_shade/detail/cuda/tuning.hpp>
#include <deferred_shade/detail/cuda/warp.hpp>
#include <deferred_shade/types.hpp>
#include <deferred_shade/workspace.hpp>

// Buckets for tables of up to 32 shaders: each shader has a lane of every warp.

namespace deferred_shade::detail {
inline namespace DEFERRED_SHADE_ARCHITECTURES {

/// The position of the count of one shader in one tile.
struct tile_count_layout {
  std::uint32_t shader_stride;
  std::uint32_t tile_stride;
  __host__ __device__ std::size_t operator()(shader_id k, std::uint32_t tile) const {
    return std::size_t{k} * shader_stride + std::size_t{tile} * tile_stride;
  }
};

/// Counts the requests of each shader in each tile.
template <shader_id Shaders, class Count, class Ids>
__global__ void __launch_bounds__(bucket_threads)
    lane_bucket_count_kernel(Count n, Ids ids, tile_count_layout layout, std::uint32_t* counts) {
  __shared__ tile_counts<Shaders> counters;
  detail::begin_after_earlier_kernels();
  counters.count(ids, tile_of_block(detail::size_of(n)),
                 [&](shader_id k, std::uint32_t count) { counts[layout(k, blockIdx.x)] = count; });
}

/// Sorts every tile and writes each request to the place that `Output` gives for its shader and
/// tile.
///
/// If `ids` are the renderer's, the kernel that counted has waited for them; if they are a copy,
/// that kernel writes them.
template <shader_id Shaders, bool Copied, class Count, class Ids, class Output>
__global__ void __launch_bounds__(bucket_threads,
                                  blocks_that_fit(place_blocks(Shaders), bucket_threads))
    lane_bucket_place_kernel(Count n, Ids ids, Output output) {
  __shared__ sorted_bucket_tile<Shaders> sorted;
  __shared__ typename Output::shared_memory shared;
  detail::let_next_kernel_start();
  if (Copied) detail::wait_for_earlier_kernels();
  tile_of_block const tile(detail::size_of(n));
  auto const [start, used] = sorted.sort(ids, tile);
  if (!Copied) detail::wait_for_earlier_kernels();  // for the counts
  output.prepare(shared);
  __syncthreads();
  std::uint32_t const shift = output.place_of_lane(shared) - start;
  std::uint32_t const left = used - (min)(used, threadIdx.x);
#pragma unroll
  for (std::uint32_t row = 0; row < bucket_items; ++row) {
    std::uint32_t const slot = sorted.at_row(row);
    std::uint32_t const there = __shfl_sync(all_lanes, shift, static_cast<int>(slot >> 24));
    if (row * bucket_threads >= left) continue;
    output.write(there + (row * bucket_threads + threadIdx.x), tile.first, slot);
  }
}

/// Turns each count of shader k = blockIdx.x into the number of its requests in earlier tiles, and
/// sets totals[k] to the number of all its requests.
template <std::uint32_t Threads = bucket_scan_threads>
__global__ void __launch_bounds__(Threads)
    lane_bucket_scan_kernel(std::uint32_t tiles, std::uint32_t* counts, std::uint32_t* totals) {
  using block_scan = cub::BlockScan<std::uint32_t, Threads>;
  constexpr std::uint32_t items = 4;
  __shared__ typename block_scan::TempStorage shared;
  detail::let_next_kernel_start();  // as in lane_bucket_place_kernel
  detail::wait_for_earlier_kernels();
  std::uint32_t* const row = counts + std::size_t{blockIdx.x} * tiles;
  std::uint32_t total = 0;
  for (std::uint32_t first = 0; first < tiles; first += Threads * items) {
    std::uint32_t const mine = first + threadIdx.x * items;
    std::uint32_t values[items];
#pragma unroll
    for (std::uint32_t i = 0; i < items; ++i) values[i] = mine + i < tiles ? row[mine + i] : 0;
    std::uint32_t sum = 0;
    block_scan(shared).ExclusiveSum(values, values, sum);
#pragma unroll
    for (std::uint32_t i = 0; i < items; ++i) {
      if (mine + i < tiles) row[mine + i] = total + values[i];
    }
    total += sum;
    __syncthreads();
  }
  if (threadIdx.x == 0) totals[blockIdx.x] = total;
}

/// The places of a grouping, from the number of each shader's requests in earlier tiles and in all.
template <shader_id Shaders>
struct bucket_output {
  std::uint32_t const* earlier;
  std::uint32_t const* totals;
  request_index* permutation;
  request_index* offsets;

  struct shared_memory {};

  __device__ void prepare(shared_memory&) const {}

  /// The first place for requests of this block's tile that name the shader of this lane.
  __device__ std::uint32_t place_of_lane(shared_memory const&) const {
    std::uint32_t const lane = threadIdx.x % warp_size;
    std::uint32_t const total = lane < Shaders ? totals[lane] : 0;
    std::uint32_t const offset = detail::exclusive_sum_of_warp(total);
    if (blockIdx.x == 0 && threadIdx.x == lane && lane < Shaders) {
      offsets[lane] = offset;
      if (lane == Shaders - 1) offsets[Shaders] = offset + total;
    }
    return offset + (lane < Shaders ? earlier[lane * gridDim.x + blockIdx.x] : 0);
  }

  __device__ void write(std::uint32_t place, request_index first, std::uint32_t slot) const {
    permutation[place] = first | (slot & (bucket_tile - 1));  // a tile begins at a multiple
  }
};

template <shader_id Shaders, class Count, class Ids, class Workspace>
grouping lane_bucket_grouping(cudaStream_t stream, Count n, Ids ids, Workspace& scratch) {
  std::size_t const maximum = detail::maximum_of(n);
  std::size_t const tiles = (std::max)(std::size_t{1}, detail::blocks_for(maximum, bucket_tile));
  using passes = two_passes<Shaders, Ids>;
  using first_ids = typename passes::first;
  using second_ids = typename passes::second;
  using output = bucket_output<Shaders>;
  auto const [permutation, counts, totals, offsets, copy] =
      scratch.take(elements<request_index>(maximum), elements<std::uint32_t>(tiles * Shaders),
                   elements<std::uint32_t>(Shaders), elements<request_index>(Shaders + 1),
                   passes::memory(maximum));
  auto const row = static_cast<std::uint32_t>(tiles);
  launch_shape const shape{tiles, bucket_threads};
  detail::launch<&lane_bucket_count_kernel<Shaders, Count, first_ids>>(
      "bucket count", stream, shape, n, passes::read_first(ids, copy), tile_count_layout{row, 1},
      counts);
  detail::launch<&lane_bucket_scan_kernel<>>("bucket scan", stream, {Shaders, bucket_scan_threads},
                                             row, counts, totals);
  detail::launch<&lane_bucket_place_kernel<Shaders, passes::copies, Count, second_ids, output>>(
      "bucket place", stream, shape, n, passes::read_second(ids, copy),
      output{counts, totals, permutation, offsets});
  return {permutation, offsets, maximum};
}

}  // namespace DEFERRED_SHADE_ARCHITECTURES
}  // namespace deferred_shade::detail
