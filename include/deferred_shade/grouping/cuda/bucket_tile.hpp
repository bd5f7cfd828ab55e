// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <deferred_shade/cuda/load_keys.hpp>
#include <deferred_shade/cuda/rank_in_warp.hpp>
#include <deferred_shade/cuda/thread_counts.hpp>
#include <deferred_shade/cuda/warp.hpp>
#include <deferred_shade/types.hpp>

// The tiles that buckets are made of: how a thread block counts and sorts the requests of one, for
// tables of up to 32 shaders.

namespace deferred_shade::detail {

inline constexpr std::uint32_t bucket_threads = 256;
inline constexpr std::uint32_t bucket_items = 16;
inline constexpr std::uint32_t bucket_warps = bucket_threads / warp_size;
inline constexpr std::uint32_t bucket_tile = bucket_threads * bucket_items;

/// The requests that a thread block owns: all but the last block have `bucket_tile` of them.
struct tile_of_block {
  request_index first;
  std::uint32_t size;

  __device__ explicit tile_of_block(request_index n) {
    std::uint64_t const begin = min(std::uint64_t{n}, std::uint64_t{blockIdx.x} * bucket_tile);
    first = static_cast<request_index>(begin);
    size = min(bucket_tile, n - first);
  }

  /// The shaders of this thread's requests, 16 neighbours.
  template <shader_id Shaders, class Ids>
  __device__ void load_neighbours_of_thread(Ids const& ids,
                                            std::uint32_t (&keys)[bucket_items]) const {
    std::uint32_t const mine = threadIdx.x * bucket_items;
    load_neighbours<Shaders>(ids, first + mine, mine < size ? size - mine : 0, keys);
  }
};

/// The counts of a tile's shaders.
///
/// Every thread has a byte per shader to itself, in a column of shared memory that is one bank
/// wide: no two lanes ever meet, whatever the ids. Up to 15 shaders, it has them in registers.
template <shader_id Shaders>
class tile_counts {
  static constexpr bool in_registers = Shaders < 16;
  static constexpr std::uint32_t words = Shaders / 4 + 1;
  static_assert(bucket_items * bucket_warps <= 255, "the counts of all warps fit in a byte");

 public:
  /// Calls `write(k, count)` for every shader by some thread of the block.
  template <class Write>
  __device__ void count(std::uint32_t const (&keys)[bucket_items], Write const& write) {
    std::uint32_t const lane = threadIdx.x % warp_size;
    std::uint32_t const warp = threadIdx.x / warp_size;
    if constexpr (in_registers) {
      using counts = thread_counts<Shaders>;
      std::uint32_t ranks[bucket_items];
      std::uint32_t pairs[counts::pairs];
      counts::rank(keys, ranks, pairs);
#pragma unroll
      for (std::uint32_t j = 0; j < counts::pairs; ++j) {
        std::uint32_t const sum = __reduce_add_sync(all_lanes, pairs[j]);
        if (lane == 0) memory_[warp][j] = sum;
      }
      __syncthreads();
      std::uint32_t const k = threadIdx.x;
      if (k >= Shaders) return;
      std::uint32_t sum = 0;
#pragma unroll
      for (std::uint32_t w = 0; w < bucket_warps; ++w) {
        sum += memory_[w][k / 2] >> k % 2 * 16 & 0xffff;
      }
      write(k, sum);
    } else {
#pragma unroll
      for (std::uint32_t word = 0; word < words; ++word) memory_[word][threadIdx.x] = 0;
#pragma unroll
      for (std::uint32_t const key : keys) {
        ++reinterpret_cast<std::uint8_t*>(&memory_[key / 4][threadIdx.x])[key % 4];
      }
      __syncthreads();
      // A warp takes one word of four bytes: sums of all warps fit in bytes, of all lanes in
      // halves.
      for (std::uint32_t word = warp; word < words; word += bucket_warps) {
        std::uint32_t sum = 0;
#pragma unroll
        for (std::uint32_t w = 0; w < bucket_warps; ++w) sum += memory_[word][w * warp_size + lane];
        std::uint32_t const even = __reduce_add_sync(all_lanes, sum & 0x00ff00ffU);
        std::uint32_t const odd = __reduce_add_sync(all_lanes, sum >> 8 & 0x00ff00ffU);
        std::uint32_t const k = word * 4 + lane;
        if (lane < 4 && k < Shaders) {
          write(k, (lane % 2 == 0 ? even : odd) >> lane / 2 * 16 & 0xffff);
        }
      }
    }
  }

 private:
  std::uint32_t memory_[in_registers ? bucket_warps : words][in_registers ? 8 : bucket_threads];
};

/// A tile sorted by the shaders that its requests name, in shared memory. A lane of every warp
/// looks after each shader.
template <shader_id Shaders>
class sorted_bucket_tile {
 public:
  /// What a lane knows of the shader with its number, and of the tile.
  struct segment {
    std::uint32_t start;  ///< where in the tile its requests begin
    std::uint32_t used;   ///< the requests of the tile that name a shader
  };

  /// Sorts a tile. Called by all threads of the block; a barrier must follow.
  template <class Ids>
  __device__ segment sort(Ids const& ids, tile_of_block tile) {
    if constexpr (in_registers) {
      return sort_by_threads(ids, tile);
    } else {
      return sort_by_lanes(ids, tile);
    }
  }

  /// The request at place `row * 256 + threadIdx.x` of the sorted tile: its shader in the upper 8
  /// bits, its position in the tile in the lower ones.
  __device__ std::uint32_t at_row(std::uint32_t row) const {
    return slots_[spread(row * bucket_threads) + spread(threadIdx.x)];
  }

 private:
  static constexpr bool in_registers = Shaders < 16;
  static constexpr std::uint32_t columns = Shaders + 1;

  // What neighbouring threads write together is as far apart as a thread has requests: one word
  // more for every 32 keeps it in different banks.
  __device__ static constexpr std::uint32_t spread(std::uint32_t p) {
    return in_registers ? p + p / warp_size : p;
  }

  // From the counts of every warp in one column of of_warp_, those of one shader or two: `half` is
  // where in a word. `begin` becomes the place of the first request of this warp.
  __device__ segment find_segment(std::uint32_t column, std::uint32_t half, std::uint32_t& begin) {
    constexpr std::uint32_t mask = in_registers ? 0xffff : 0xffffffff;
    std::uint32_t const warp = threadIdx.x / warp_size;
    std::uint32_t before = 0;
    std::uint32_t total = 0;
#pragma unroll
    for (std::uint32_t w = 0; w < bucket_warps; ++w) {
      if (w == warp) before = total;
      total += of_warp_[w][column];
    }
    total = total >> half & mask;
    std::uint32_t const start = exclusive_sum_of_warp(total);
    begin = start + (before >> half & mask);
    return {start, __shfl_sync(all_lanes, start + total, static_cast<int>(Shaders - 1))};
  }

  // A thread takes 16 neighbours, and counts them in registers.
  template <class Ids>
  __device__ segment sort_by_threads(Ids const& ids, tile_of_block tile) {
    using counts = thread_counts<Shaders>;
    std::uint32_t const lane = threadIdx.x % warp_size;
    std::uint32_t const warp = threadIdx.x / warp_size;
    std::uint32_t keys[bucket_items];
    tile.load_neighbours_of_thread<Shaders>(ids, keys);
    std::uint32_t ranks[bucket_items];
    std::uint32_t pairs[counts::pairs];
    counts::rank(keys, ranks, pairs);
    std::uint32_t sums[counts::pairs];
#pragma unroll
    for (std::uint32_t j = 0; j < counts::pairs; ++j) {
      sums[j] = exclusive_sum_of_warp(pairs[j]);
      if (lane == warp_size - 1) of_warp_[warp][j] = sums[j] + pairs[j];
    }
    __syncthreads();
    std::uint32_t begin;
    segment const result = find_segment(min(lane, Shaders) / 2, lane % 2 * 16, begin);
    // Each thread reads what it has written: no barrier.
    std::uint32_t* const begins = &begins_[0][threadIdx.x];
#pragma unroll
    for (std::uint32_t k = 0; k < columns; ++k) {
      begins[k * bucket_threads] =
          __shfl_sync(all_lanes, begin, static_cast<int>(k)) + (sums[k / 2] >> k % 2 * 16 & 0xffff);
    }
    std::uint32_t const mine = threadIdx.x * bucket_items;
#pragma unroll
    for (std::uint32_t item = 0; item < bucket_items; ++item) {
      std::uint32_t const key = keys[item];
      slots_[spread(begins[key * bucket_threads] + ranks[item])] = (key << 24) + mine + item;
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
    load_rows<Shaders>(ids, tile.first + mine, mine < tile.size ? tile.size - mine : 0, keys);
    std::uint32_t ranks[bucket_items];
    of_warp_[warp][lane] = rank_in_warp<Shaders>(keys, ranks);
    __syncthreads();
    std::uint32_t begin;
    segment const result = find_segment(lane, 0, begin);
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

  std::uint32_t of_warp_[bucket_warps][in_registers ? 8 : warp_size];
  std::uint32_t begins_[in_registers ? columns : 1][in_registers ? bucket_threads : 1];
  std::uint32_t slots_[spread(bucket_tile)];
};

}  // namespace deferred_shade::detail
