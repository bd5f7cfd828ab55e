// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cub/config.cuh>

#include <deferred_shade/detail/cuda/architectures.hpp>
#include <deferred_shade/detail/cuda/tuning.hpp>

namespace deferred_shade::detail {
inline namespace DEFERRED_SHADE_ARCHITECTURES {

namespace cub = CUB_NS_QUALIFIER;  // as thrust: see detail/system.hpp

inline constexpr unsigned all_lanes = 0xffffffffU;

/// The number of bits that hold the numbers 0 to `largest`.
__host__ __device__ constexpr int bits_for(std::uint32_t largest) {
  int bits = 0;
  for (; largest != 0; largest >>= 1) ++bits;
  return bits;
}

/// The sum of `value` over all lanes of the warp. All lanes must call it.
__device__ inline std::uint32_t sum_of_warp(std::uint32_t value) {
#if __CUDA_ARCH__ >= 800
  return __reduce_add_sync(all_lanes, value);
#else
#pragma unroll
  for (int distance = static_cast<int>(warp_size) / 2; distance > 0; distance /= 2) {
    value += __shfl_xor_sync(all_lanes, value, distance);
  }
  return value;
#endif
}

/// The threads that a multiprocessor holds at a time, for the architecture being compiled.
__host__ __device__ constexpr std::uint32_t resident_threads() {
#ifndef __CUDA_ARCH__
  return 1024;  // only kernels ask
#elif __CUDA_ARCH__ == 800 || __CUDA_ARCH__ == 900 || __CUDA_ARCH__ == 1000 || __CUDA_ARCH__ == 1030
  return 2048;
#elif __CUDA_ARCH__ == 860 || __CUDA_ARCH__ == 870 || __CUDA_ARCH__ == 890 || \
    __CUDA_ARCH__ == 1100 || __CUDA_ARCH__ == 1200 || __CUDA_ARCH__ == 1210
  return 1536;
#else
  return 1024;  // 7.5, and unknown ones: all hold at least as many
#endif
}

/// For a launch bound: `wanted` blocks per multiprocessor, or as many as it holds.
__host__ __device__ constexpr unsigned blocks_that_fit(std::uint32_t wanted,
                                                       std::uint32_t threads) {
  std::uint32_t const held = detail::resident_threads() / threads;
  return wanted < held ? wanted : held;
}

/// The sum of `value` over the lanes below this one. All lanes of the warp must call it.
__device__ inline std::uint32_t exclusive_sum_of_warp(std::uint32_t value) {
  std::uint32_t sum = value;
#pragma unroll
  for (std::uint32_t distance = 1; distance < warp_size; distance *= 2) {
    // Does what __shfl_up_sync and a comparison do: the shuffle makes the comparison anyway.
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

}  // namespace DEFERRED_SHADE_ARCHITECTURES
}  // namespace deferred_shade::detail
