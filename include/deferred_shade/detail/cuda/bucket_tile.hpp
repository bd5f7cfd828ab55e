// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <type_traits>

#include <deferred_shade/detail/cuda/architectures.hpp>
#include <deferred_shade/detail/cuda/copied_ids.hpp>
#include <deferred_shade/detail/cuda/thread_counts.hpp>
#include <deferred_shade/detail/cuda/tuning.hpp>
#include <deferred_shade/detail/cuda/warp.hpp>
#include <deferred_shade/types.hpp>

// The tiles of the bucket sort, and how a thread block counts the requests of one.

namespace deferred_shade::detail {
inline namespace DEFERRED_SHADE_ARCHITECTURES {

/// The requests that a thread block owns: `bucket_tile` of them, except in the last block.
struct tile_of_block {
  request_index first;
  std::uint32_t size;

  __device__ explicit tile_of_block(request_index n) {
    std::uint64_t const begin = (min)(std::uint64_t{n}, std::uint64_t{blockIdx.x} * bucket_tile);
    first = static_cast<request_index>(begin);
    size = (min)(bucket_tile, n - first);
  }

  /// The shaders of this thread's requests, 16 neighbours.
  template <shader_id Shaders, class Ids>
  __device__ void load_neighbours_of_thread(Ids const& ids,
                                            std::uint32_t (&keys)[bucket_items]) const {
    std::uint32_t const mine = threadIdx.x * bucket_items;
    detail::load_neighbours<Shaders>(ids, first + mine, mine < size ? size - mine : 0, keys);
  }

  /// The same in four bits each and in any order, for tables of at most 15 shaders. Requests
  /// without a shader get an arbitrary id outside of the table.
  template <shader_id Shaders, class Ids>
  __device__ four_bit_keys load_four_bit_neighbours_of_thread(Ids const& ids) const {
    if constexpr (std::is_pointer_v<Ids> && std::is_convertible_v<Ids, std::uint8_t const*>) {
      std::uint32_t const mine = threadIdx.x * bucket_items;
      auto const* const vector = reinterpret_cast<uint4 const*>(ids + first + mine);
      if (mine + bucket_items <= size &&
          reinterpret_cast<std::uintptr_t>(vector) % sizeof(uint4) == 0) {
        uint4 const bytes = *vector;
        bool const fit = ((bytes.x | bytes.y | bytes.z | bytes.w) & 0xf0f0f0f0) == 0;
        if (fit) return {bytes.x | bytes.y << 4, bytes.z | bytes.w << 4};
      }
    }
    std::uint32_t keys[bucket_items];
    load_neighbours_of_thread<Shaders>(ids, keys);
    return detail::to_four_bits(keys);
  }
};

/// The counts of a tile's shaders.
///
/// Every thread has its own byte for each shader, in a column of shared memory that is one bank
/// wide: lanes never conflict, whatever the ids. Up to 15 shaders, the counts are in registers.
template <shader_id Shaders>
class tile_counts {
  static constexpr std::uint32_t words = Shaders / 4 + 1;
  static_assert(bucket_items * bucket_warps <= 255,
                "deferred_shade: the counts of all warps must fit in a byte");

 public:
  /// Counts a tile. Some thread of the block calls `write(k, count)` for every shader.
  template <class Ids, class Write>
  __device__ void count(Ids const& ids, tile_of_block tile, Write const& write) {
    std::uint32_t const lane = threadIdx.x % warp_size;
    std::uint32_t const warp = threadIdx.x / warp_size;
    if constexpr (detail::counts_in_registers(Shaders)) {
      using counts = thread_counts<Shaders>;
      std::uint32_t mine[counts::words];
      counts::count(tile.load_four_bit_neighbours_of_thread<Shaders>(ids), mine);
#pragma unroll
      for (std::uint32_t j = 0; j < counts::words; ++j) {
        std::uint32_t const sum = detail::sum_of_warp(mine[j]);
        if (lane == 0) memory_[warp][j] = sum;
      }
      __syncthreads();
      std::uint32_t const k = threadIdx.x;
      if (k >= Shaders) return;
      std::uint32_t sum = 0;
#pragma unroll
      for (std::uint32_t w = 0; w < bucket_warps; ++w) {
        sum += counts::count_of(k, memory_[w][counts::word_of(k)]);
      }
      write(k, sum);
    } else {
      std::uint32_t keys[bucket_items];
      tile.load_neighbours_of_thread<Shaders>(ids, keys);
#pragma unroll
      for (std::uint32_t word = 0; word < words; ++word) memory_[word][threadIdx.x] = 0;
#pragma unroll
      for (std::uint32_t const key : keys) {
        ++reinterpret_cast<std::uint8_t*>(&memory_[key / 4][threadIdx.x])[key % 4];
      }
      __syncthreads();
      // A warp takes one word of four bytes. Sums over all warps fit in bytes, sums over all lanes
      // in 16 bits.
      for (std::uint32_t word = warp; word < words; word += bucket_warps) {
        std::uint32_t sum = 0;
#pragma unroll
        for (std::uint32_t w = 0; w < bucket_warps; ++w) sum += memory_[word][w * warp_size + lane];
        std::uint32_t const even = detail::sum_of_warp(sum & 0x00ff00ffU);
        std::uint32_t const odd = detail::sum_of_warp(sum >> 8 & 0x00ff00ffU);
        std::uint32_t const k = word * 4 + lane;
        if (lane < 4 && k < Shaders) {
          write(k, (lane % 2 == 0 ? even : odd) >> lane / 2 * 16 & 0xffff);
        }
      }
    }
  }

 private:
  static constexpr bool in_registers = counts_in_registers(Shaders);
  std::uint32_t memory_[in_registers ? bucket_warps : words][in_registers ? 8 : bucket_threads];
};

}  // namespace DEFERRED_SHADE_ARCHITECTURES
}  // namespace deferred_shade::detail
