// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cub/block/block_scan.cuh>

#include <deferred_shade/cuda/launch.hpp>
#include <deferred_shade/cuda/load_keys.hpp>
#include <deferred_shade/cuda/rank_in_warp.hpp>
#include <deferred_shade/cuda/warp.hpp>
#include <deferred_shade/types.hpp>
#include <deferred_shade/workspace.hpp>

// Buckets for a table of up to 32 shaders, each of which has a lane of every warp to look after it.

namespace deferred_shade::detail {

inline constexpr std::uint32_t bucket_threads = 256;
inline constexpr std::uint32_t bucket_items = 16;
inline constexpr std::uint32_t bucket_warps = bucket_threads / warp_size;
inline constexpr std::uint32_t bucket_tile = bucket_threads * bucket_items;

/// Where a grouping is written.
struct bucket_output {
  request_index* permutation;
  request_index* offsets;
};

/// The requests that a thread block owns: all but the last block have `bucket_tile` of them.
struct tile_of_block {
  request_index first;
  std::uint32_t size;

  __device__ explicit tile_of_block(request_index n) {
    std::uint64_t const begin = min(std::uint64_t{n}, std::uint64_t{blockIdx.x} * bucket_tile);
    first = static_cast<request_index>(begin);
    size = min(bucket_tile, n - first);
  }
};

/// counts[k * tiles + t] becomes the number of requests of shader k in tile t.
///
/// Every thread has a byte per shader to itself, in a column of shared memory that is one bank
/// wide: no two lanes ever meet, whatever the ids.
template <shader_id Shaders, class Count, class Ids>
__global__ void __launch_bounds__(bucket_threads)
    small_bucket_count_kernel(Count n, Ids ids, std::uint32_t* counts) {
  constexpr std::uint32_t words = Shaders / 4 + 1;
  __shared__ std::uint32_t bytes[words][bucket_threads];
  static_assert(bucket_items * bucket_warps <= 255, "the counts of all warps fit in a byte");
  tile_of_block const tile(size_of(n));
#pragma unroll
  for (std::uint32_t word = 0; word < words; ++word) bytes[word][threadIdx.x] = 0;
  std::uint32_t const mine = threadIdx.x * bucket_items;
  std::uint32_t keys[bucket_items];
  load_neighbours<Shaders>(ids, tile.first + mine, mine < tile.size ? tile.size - mine : 0, keys);
#pragma unroll
  for (std::uint32_t const key : keys) {
    ++reinterpret_cast<std::uint8_t*>(&bytes[key / 4][threadIdx.x])[key % 4];
  }
  __syncthreads();

  // A warp takes one word of four bytes: sums of all warps fit in bytes, of all lanes in halves.
  std::uint32_t const lane = threadIdx.x % warp_size;
  for (std::uint32_t word = threadIdx.x / warp_size; word < words; word += bucket_warps) {
    std::uint32_t sum = 0;
#pragma unroll
    for (std::uint32_t w = 0; w < bucket_warps; ++w) sum += bytes[word][w * warp_size + lane];
    std::uint32_t const even = __reduce_add_sync(all_lanes, sum & 0x00ff00ffU);
    std::uint32_t const odd = __reduce_add_sync(all_lanes, sum >> 8 & 0x00ff00ffU);
    std::uint32_t const k = word * 4 + lane;
    if (lane < 4 && k < Shaders) {
      counts[k * gridDim.x + blockIdx.x] = (lane % 2 == 0 ? even : odd) >> lane / 2 * 16 & 0xffff;
    }
  }
}

inline constexpr std::uint32_t bucket_scan_threads = 1024;

/// Turns the counts of shader blockIdx.x into the number of its requests in the tiles before, and
/// totals[k] into the number of all its requests.
template <std::uint32_t Threads = bucket_scan_threads>
__global__ void __launch_bounds__(Threads)
    small_bucket_scan_kernel(std::uint32_t tiles, std::uint32_t* counts, std::uint32_t* totals) {
  using block_scan = cub::BlockScan<std::uint32_t, Threads>;
  constexpr std::uint32_t items = 4;
  __shared__ typename block_scan::TempStorage shared;
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

/// Puts the requests of every tile to their places; see small_bucket_scan_kernel.
template <shader_id Shaders, class Count, class Ids>
__global__ void __launch_bounds__(bucket_threads, 4)
    small_bucket_place_kernel(Count n, Ids ids, std::uint32_t const* counts,
                              std::uint32_t const* totals, bucket_output output) {
  __shared__ std::uint32_t counts_of_warps[bucket_warps][warp_size];
  __shared__ std::uint32_t slots[bucket_tile];  // the sorted tile: the shader above the position
  std::uint32_t const lane = threadIdx.x % warp_size;
  std::uint32_t const warp = threadIdx.x / warp_size;
  tile_of_block const tile(size_of(n));

  // A warp owns neighbouring requests and takes them 32 at a time.
  std::uint32_t const mine = warp * warp_size * bucket_items + lane;
  std::uint32_t keys[bucket_items];
  load_rows<Shaders>(ids, tile.first + mine, mine < tile.size ? tile.size - mine : 0, keys);
  std::uint32_t ranks[bucket_items];
  std::uint32_t const count = rank_in_warp<Shaders>(keys, ranks);
  counts_of_warps[warp][lane] = count;
  __syncthreads();

  std::uint32_t in_warps_before = 0;
  std::uint32_t in_tile = 0;
#pragma unroll
  for (std::uint32_t w = 0; w < bucket_warps; ++w) {
    if (w == warp) in_warps_before = in_tile;
    in_tile += counts_of_warps[w][lane];
  }
  std::uint32_t const start = exclusive_sum_of_warp(in_tile);
  std::uint32_t const used = __shfl_sync(all_lanes, start + in_tile, static_cast<int>(Shaders - 1));
  std::uint32_t const begin = start + in_warps_before;
#pragma unroll
  for (std::uint32_t row = 0; row < bucket_items; ++row) {
    std::uint32_t const key = keys[row];
    std::uint32_t const slot = __shfl_sync(all_lanes, begin, static_cast<int>(key)) + ranks[row];
    // With 32 shaders, no lane has ranked the requests that name none.
    if (Shaders == warp_size && key == Shaders) continue;
    slots[slot] = key << 16 | (mine + row * warp_size);
  }

  std::uint32_t const total = lane < Shaders ? totals[lane] : 0;
  std::uint32_t const offset = exclusive_sum_of_warp(total);
  std::uint32_t const earlier = lane < Shaders ? counts[lane * gridDim.x + blockIdx.x] : 0;
  std::uint32_t const shift = offset + earlier - start;  // from places in the tile to the wave's
  if (blockIdx.x == 0 && warp == 0 && lane < Shaders) {
    output.offsets[lane] = offset;
    if (lane == Shaders - 1) output.offsets[Shaders] = offset + total;
  }
  __syncthreads();
#pragma unroll
  for (std::uint32_t row = 0; row < bucket_items; ++row) {
    std::uint32_t const p = row * bucket_threads + threadIdx.x;
    std::uint32_t const slot = slots[p];
    std::uint32_t const there = __shfl_sync(all_lanes, shift, static_cast<int>(slot >> 16));
    if (p < used) output.permutation[there + p] = tile.first + (slot & 0xffff);
  }
}

template <shader_id Shaders, class Count, class Ids, class Workspace>
grouping small_bucket_grouping(cudaStream_t stream, Count n, Ids ids, Workspace& scratch) {
  std::size_t const maximum = maximum_of(n);
  std::size_t const tiles = std::max(std::size_t{1}, (maximum + bucket_tile - 1) / bucket_tile);
  auto const [permutation, counts, totals, offsets] =
      scratch.take(elements<request_index>(maximum), elements<std::uint32_t>(tiles * Shaders),
                   elements<std::uint32_t>(Shaders), elements<request_index>(Shaders + 1));
  launch_shape const shape{tiles, bucket_threads};
  launch("bucket count", stream, shape, small_bucket_count_kernel<Shaders, Count, Ids>, n, ids,
         counts);
  launch("bucket scan", stream, {Shaders, bucket_scan_threads}, small_bucket_scan_kernel<>,
         static_cast<std::uint32_t>(tiles), counts, totals);
  launch("bucket place", stream, shape, small_bucket_place_kernel<Shaders, Count, Ids>, n, ids,
         counts, totals, bucket_output{permutation, offsets});
  return {permutation, offsets, maximum};
}

}  // namespace deferred_shade::detail
