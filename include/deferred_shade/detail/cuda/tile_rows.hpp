// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <deferred_shade/detail/cuda/architectures.hpp>
#include <deferred_shade/detail/cuda/warp.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade::detail {
inline namespace DEFERRED_SHADE_ARCHITECTURES {

/// A sorted tile cut into rows of at most 32 requests of one shader, in shared memory.
template <class Sort>
class tile_rows {
 public:
  /// Cuts the tile whose segments begin at `starts`. All threads must call it; a barrier must
  /// follow.
  __device__ void find(std::uint32_t const* starts) {
    if (threadIdx.x / warp_size != 0) return;
    std::uint32_t const lane = threadIdx.x % warp_size;
    std::uint32_t total = 0;
    for (std::uint32_t begin = 0; begin < shaders; begin += warp_size) {
      std::uint32_t const k = begin + lane;
      std::uint32_t const count =
          k < shaders ? (starts[k + 1] - starts[k] + warp_size - 1) / warp_size : 0;
      std::uint32_t const row = total + detail::exclusive_sum_of_warp(count);
      if (k < shaders) first_row_[k] = static_cast<std::uint16_t>(row);
      total = __shfl_sync(all_lanes, row + count, warp_size - 1);
    }
    if (lane == 0) {
      count_ = total;
      next_ = 0;
    }
  }

  /// Calls `f(id, place)` for every place of the tile that has a shader. A warp takes one row after
  /// the other: its lanes have one id at a time.
  template <class Function>
  __device__ void for_each(std::uint32_t const* starts, Function const& f) {
    std::uint32_t const lane = threadIdx.x % warp_size;
    for (;;) {
      std::uint32_t row = 0;
      if (lane == 0) row = atomicAdd(&next_, 1U);
      row = __shfl_sync(all_lanes, row, 0);
      if (row >= count_) return;
      shader_id const id = shader_of_row(row, lane);
      std::uint32_t const place = starts[id] + (row - first_row_[id]) * warp_size + lane;
      if (place < starts[id + 1]) f(id, place);
      __syncwarp();
    }
  }

 private:
  static constexpr shader_id shaders = Sort::columns - 1;

  // The shader of a row: the last one whose rows begin at `row` or before.
  __device__ shader_id shader_of_row(std::uint32_t row, std::uint32_t lane) const {
    shader_id count = 0;
#pragma unroll
    for (std::uint32_t begin = 0; begin < shaders; begin += warp_size) {
      bool const before = begin + lane < shaders && first_row_[begin + lane] <= row;
      count += static_cast<shader_id>(__popc(__ballot_sync(all_lanes, before)));
    }
    return count - 1;
  }

  std::uint32_t count_;
  std::uint32_t next_;
  std::uint16_t first_row_[shaders];
};

}  // namespace DEFERRED_SHADE_ARCHITECTURES
}  // namespace deferred_shade::detail
