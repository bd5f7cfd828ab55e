// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <deferred_shade/detail/cuda/architectures.hpp>
#include <deferred_shade/detail/cuda/bucket_tile.hpp>
#include <deferred_shade/detail/cuda/load_keys.hpp>
#include <deferred_shade/detail/cuda/rank_in_warp.hpp>
#include <deferred_shade/detail/cuda/thread_counts.hpp>
#include <deferred_shade/detail/cuda/warp.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade::detail {
inline namespace DEFERRED_SHADE_ARCHITECTURES {

/// A tile in shared memory, sorted by shader. Each shader has a lane of every warp.
template <shader_id Shaders>
class sorted_bucket_tile {
 public:
  /// What a lane knows about its shader, the one with its number, and about the tile.
  struct segment {
    std::uint32_t start;  ///< where in the tile its requests begin
    std::uint32_t used;   ///< the requests of the tile that name a shader
  };

  /// Sorts a tile. All threads of the block must call it; a barrier must follow.
  template <class Ids>
  __device__ segment sort(Ids const& ids, tile_of_block tile) {
    if constexpr (detail::counts_in_registers(Shaders)) {
      return sort_by_threads(ids, tile);
    } else {
      return sort_by_lanes(ids, tile);
    }
  }

  /// The request at place `row * 256 + threadIdx.x` of the sorted tile: its shader in the upper 8
  /// bits, its position in the tile in the lower 24.
  __device__ std::uint32_t at_row(std::uint32_t row) const {
    return slots_[spread(row * bucket_threads) + spread(threadIdx.x)];
  }

 private:
  static constexpr bool by_threads = counts_in_registers(Shaders);

  // Words that neighbouring threads write together are 16 apart, the requests of a thread. One more
  // word after every 32 puts them into different banks.
  __device__ static constexpr std::uint32_t spread(std::uint32_t p) {
    return by_threads ? p + p / warp_size : p;
  }

  // Computes this lane's segment from the counts of all warps. Sets `begin` to the place of the
  // first request of the lane's shader in this warp.
  __device__ segment find_segment(std::uint32_t& begin) {
    std::uint32_t const lane = threadIdx.x % warp_size;
    std::uint32_t const warp = threadIdx.x / warp_size;
    std::uint32_t before = 0;
    std::uint32_t total = 0;
#pragma unroll
    for (std::uint32_t w = 0; w < bucket_warps; ++w) {
      if (w == warp) before = total;
      total += of_warp_[w][lane];
    }
    std::uint32_t const start = detail::exclusive_sum_of_warp(total);
    begin = start + before;
    return {start, __shfl_sync(all_lanes, start + total, static_cast<int>(Shaders - 1))};
  }

  // A thread takes 16 neighbours. It computes where its first request of each shader goes, and
  // counts up from there in its own column of shared memory.
  template <class Ids>
  __device__ segment sort_by_threads(Ids const& ids, tile_of_block tile) {
    using counts = thread_counts<Shaders>;
    std::uint32_t const lane = threadIdx.x % warp_size;
    std::uint32_t keys[bucket_items];
    tile.load_neighbours_of_thread<Shaders>(ids, keys);
    std::uint32_t sums[counts::words];
    counts::count(detail::to_four_bits(keys), sums);
    std::uint32_t of_lane = 0;
#pragma unroll
    for (std::uint32_t j = 0; j < counts::words; ++j) {
      std::uint32_t const mine = sums[j];
      sums[j] = detail::exclusive_sum_of_warp(mine);
      std::uint32_t const all = __shfl_sync(all_lanes, sums[j] + mine, warp_size - 1);
      if (counts::word_of(lane) == j) of_lane = counts::count_of(lane, all);
    }
    of_warp_[threadIdx.x / warp_size][lane] = of_lane;
    __syncthreads();
    std::uint32_t begin;
    segment const result = find_segment(begin);
    // Each thread reads only what it has written: no barrier is needed.
    std::uint32_t* const next = &next_[0][threadIdx.x];
#pragma unroll
    for (std::uint32_t k = 0; k < counts::columns; ++k) {
      next[k * bucket_threads] = __shfl_sync(all_lanes, begin, static_cast<int>(k)) +
                                 counts::count_of(k, sums[counts::word_of(k)]);
    }
    std::uint32_t const mine = threadIdx.x * bucket_items;
#pragma unroll
    for (std::uint32_t item = 0; item < bucket_items; ++item) {
      std::uint32_t const key = keys[item];
      // Atomic only because that is one instruction instead of three: no other thread adds to it.
      std::uint32_t const place = atomicAdd(&next[key * bucket_threads], 1U);
      slots_[spread(place)] = (key << 24) + mine + item;
    }
    return result;
  }

  // A warp owns neighbouring requests and takes them 32 at a time.
  template <class Ids>
  __device__ segment sort_by_lanes(Ids const& ids, tile_of_block tile) {
    std::uint32_t const lane = threadIdx.x % warp_size;
    std::uint32_t const warp = threadIdx.x / warp_size;
    std::uint32_t const mine = warp * warp_size * bucket_items + lane;
    std::uint32_t keys[bucket_items];
    detail::load_rows<Shaders>(ids, tile.first + mine, mine < tile.size ? tile.size - mine : 0,
                               keys);
    std::uint32_t ranks[bucket_items];
    of_warp_[warp][lane] = detail::rank_in_warp<Shaders>(keys, ranks);
    __syncthreads();
    std::uint32_t begin;
    segment const result = find_segment(begin);
#pragma unroll
    for (std::uint32_t row = 0; row < bucket_items; ++row) {
      std::uint32_t const key = keys[row];
      std::uint32_t const place = __shfl_sync(all_lanes, begin, static_cast<int>(key)) + ranks[row];
      // With 32 shaders, no lane has ranked the requests that name none.
      if (Shaders == warp_size && key == Shaders) continue;
      slots_[place] = key << 24 | (mine + row * warp_size);
    }
    return result;
  }

  std::uint32_t of_warp_[bucket_warps][warp_size];
  std::uint32_t next_[by_threads ? Shaders + 1 : 1][by_threads ? bucket_threads : 1];
  std::uint32_t slots_[spread(bucket_tile)];
};

}  // namespace DEFERRED_SHADE_ARCHITECTURES
}  // namespace deferred_shade::detail
