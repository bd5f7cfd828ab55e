// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace deferred_shade::detail {

inline constexpr unsigned all_lanes = 0xffffffffU;
inline constexpr std::uint32_t warp_size = 32;

/// The bits that hold the numbers 0 to `largest`.
__host__ __device__ constexpr int bits_for(std::uint32_t largest) {
  int bits = 0;
  for (; largest != 0; largest >>= 1) ++bits;
  return bits;
}

/// The sum of `value` over the lanes below this one. All lanes of the warp take part.
__device__ inline std::uint32_t exclusive_sum_of_warp(std::uint32_t value) {
  std::uint32_t sum = value;
#pragma unroll
  for (std::uint32_t distance = 1; distance < warp_size; distance *= 2) {
    // As __shfl_up_sync and a comparison, which the shuffle makes anyway.
    asm volatile(
        "{\n"
        "  .reg .pred exists;\n"
        "  .reg .u32 below;\n"
        "  shfl.sync.up.b32 below|exists, %0, %1, 0, 0xffffffff;\n"
        "  @exists add.u32 %0, %0, below;\n"
        "}"
        : "+r"(sum)
        : "r"(distance));
  }
  return sum - value;
}

}  // namespace deferred_shade::detail
