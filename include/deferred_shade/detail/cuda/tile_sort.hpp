// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cub/block/block_radix_rank.cuh>
#include <type_traits>

#include <deferred_shade/detail/cuda/architectures.hpp>
#include <deferred_shade/detail/cuda/load_keys.hpp>
#include <deferred_shade/detail/cuda/rank_in_warp.hpp>
#include <deferred_shade/detail/cuda/warp.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade::detail {
inline namespace DEFERRED_SHADE_ARCHITECTURES {

/// A stable counting sort by shader of a tile of `Threads * Items` requests, by one thread block.
/// Requests that name no shader go to the end. A warp owns neighbouring requests and takes them 32
/// at a time.
///
/// Up to 32 shaders, each shader has a lane of every warp. For more, CUB ranks the ids.
template <shader_id Shaders, std::uint32_t Threads, std::uint32_t Items>
class tile_sort {
  static constexpr bool has_lanes = Shaders <= warp_size;
  static constexpr std::uint32_t warps = Threads / warp_size;
  using ranker = cub::BlockRadixRankMatch<static_cast<int>(Threads), bits_for(Shaders), false>;
  struct counts {
    std::uint32_t of_warp[warps][warp_size];
  };

 public:
  static constexpr std::uint32_t size = Threads * Items;
  static constexpr shader_id columns = Shaders + 1;
  static_assert(size <= 0xffff, "deferred_shade: a position in a tile must fit in 16 bits");

  /// Shared memory that may be reused once the places are known and a barrier has passed.
  using temporary_storage = std::conditional_t<has_lanes, counts, typename ranker::TempStorage>;

  /// The position in the tile of this thread's request number `item`.
  __device__ static std::uint32_t position(std::uint32_t item) {
    std::uint32_t const warp = threadIdx.x / warp_size;
    return (warp * Items + item) * warp_size + threadIdx.x % warp_size;
  }

  /// Loads the shaders of this thread's requests. The tile is `count` requests from `first` on.
  template <class Ids>
  __device__ static void load(Ids const& ids, request_index first, std::uint32_t count,
                              std::uint32_t (&keys)[Items]) {
    std::uint32_t const mine = position(0);
    detail::load_rows<Shaders>(ids, first + mine, mine < count ? count - mine : 0, keys);
  }

  /// Whether a request with this key has a place. With 32 shaders, no lane ranks those that name
  /// none.
  __device__ static bool has_place(std::uint32_t key) {
    return Shaders != warp_size || key != Shaders;
  }

  /// Computes the places of this thread's requests in the sorted tile, and in shared memory
  /// `starts[k]`, the place of the first request of shader k. All threads of the block must call
  /// it; a barrier must follow.
  __device__ static void find_places(temporary_storage& temporary, std::uint32_t (&keys)[Items],
                                     std::uint32_t (&places)[Items], std::uint32_t* starts) {
    if constexpr (has_lanes) {
      std::uint32_t const lane = threadIdx.x % warp_size;
      std::uint32_t const warp = threadIdx.x / warp_size;
      temporary.of_warp[warp][lane] = detail::rank_in_warp<Shaders>(keys, places);
      __syncthreads();
      std::uint32_t before = 0;
      std::uint32_t total = 0;
#pragma unroll
      for (std::uint32_t w = 0; w < warps; ++w) {
        if (w == warp) before = total;
        total += temporary.of_warp[w][lane];
      }
      std::uint32_t const start = detail::exclusive_sum_of_warp(total);
      if (warp == 0 && lane < Shaders) {
        starts[lane] = start;
        if (lane == Shaders - 1) starts[Shaders] = start + total;
      }
      std::uint32_t const begin = start + before;
#pragma unroll
      for (std::uint32_t item = 0; item < Items; ++item) {
        places[item] += __shfl_sync(all_lanes, begin, static_cast<int>(keys[item]));
      }
    } else {
      constexpr std::uint32_t bins = ranker::BINS_TRACKED_PER_THREAD;
      int ranks[Items];
      int first_places[bins];
      ranker(temporary).RankKeys(keys, ranks, digit(), first_places);
#pragma unroll
      for (std::uint32_t item = 0; item < Items; ++item) {
        places[item] = static_cast<std::uint32_t>(ranks[item]);
      }
#pragma unroll
      for (std::uint32_t bin = 0; bin < bins; ++bin) {
        std::uint32_t const k = threadIdx.x * bins + bin;
        if (k < columns) starts[k] = static_cast<std::uint32_t>(first_places[bin]);
      }
    }
  }

 private:
  struct digit {
    __device__ std::uint32_t Digit(std::uint32_t key) const { return key; }
  };
};

}  // namespace DEFERRED_SHADE_ARCHITECTURES
}  // namespace deferred_shade::detail
