// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <deferred_shade/detail/cuda/architectures.hpp>
#include <deferred_shade/detail/cuda/warp.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade::detail {
inline namespace DEFERRED_SHADE_ARCHITECTURES {

/// The lanes whose `key` has a bit of `mask` set. (In C++, the compiler takes two more
/// instructions.)
__device__ inline std::uint32_t lanes_with_bit(std::uint32_t key, std::uint32_t mask) {
  std::uint32_t lanes;
  asm volatile(
      "{\n"
      "  .reg .pred set;\n"
      "  .reg .b32 bit;\n"
      "  and.b32 bit, %1, %2;\n"
      "  setp.ne.u32 set, bit, 0;\n"
      "  vote.sync.ballot.b32 %0, set, 0xffffffff;\n"
      "}"
      : "=r"(lanes)
      : "r"(key), "r"(mask));
  return lanes;
}

/// The lanes whose key equals the number of this lane.
template <shader_id Shaders>
__device__ std::uint32_t lanes_with_my_key(std::uint32_t key) {
  std::uint32_t const lane = threadIdx.x % warp_size;
  std::uint32_t lanes = all_lanes;
#pragma unroll
  for (int bit = 0; bit < detail::bits_for(Shaders); ++bit) {
    std::uint32_t const mine = (lane & 1U << bit) != 0 ? 0 : all_lanes;
    lanes &= detail::lanes_with_bit(key, 1U << bit) ^ mine;
  }
  return lanes;
}

/// Ranks the requests of a warp, in `Items` rows of 32, by the shader that they name. ranks[i] is
/// the number of requests of the same shader before this lane's request in row i. Returns how many
/// name the shader of this lane, the one with its number. (Those that name none belong to lane
/// `Shaders`, if there is one.)
template <shader_id Shaders, std::uint32_t Items>
__device__ std::uint32_t rank_in_warp(std::uint32_t const (&keys)[Items],
                                      std::uint32_t (&ranks)[Items]) {
  static_assert(Shaders <= warp_size,
                "deferred_shade: each shader must have a lane of a warp to look after it");
  std::uint32_t const below = (1U << threadIdx.x % warp_size) - 1;
  std::uint32_t count = 0;
#pragma unroll
  for (std::uint32_t row = 0; row < Items; ++row) {
    // Each lane finds the lanes that name its own shader. Then it asks the lane of its request's
    // shader, the keeper, for the requests before its own.
    int const keeper = static_cast<int>(keys[row]);
    std::uint32_t const lanes = detail::lanes_with_my_key<Shaders>(keys[row]);
    std::uint32_t const peers = __shfl_sync(all_lanes, lanes, keeper);
    std::uint32_t const before = __shfl_sync(all_lanes, count, keeper);
    ranks[row] = before + static_cast<unsigned>(__popc(peers & below));
    count += static_cast<unsigned>(__popc(lanes));
  }
  return count;
}

}  // namespace DEFERRED_SHADE_ARCHITECTURES
}  // namespace deferred_shade::detail
