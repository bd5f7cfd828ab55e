// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <deferred_shade/detail/cuda/architectures.hpp>
#include <deferred_shade/detail/cuda/warp.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade::detail {
inline namespace DEFERRED_SHADE_ARCHITECTURES {

/// Sixteen ids of four bits, eight to a word.
struct four_bit_keys {
  std::uint32_t low;
  std::uint32_t high;
};

__device__ inline four_bit_keys to_four_bits(std::uint32_t const (&keys)[16]) {
  four_bit_keys packed{0, 0};
#pragma unroll
  for (std::uint32_t i = 0; i < 8; ++i) {
    packed.low += keys[i] << 4 * i;
    packed.high += keys[i + 8] << 4 * i;
  }
  return packed;
}

/// How many of one thread's 16 requests name each shader, for tables of at most 15 shaders.
///
/// Three counts share a word, with ten bits each: enough for the sums over the threads of a warp.
template <shader_id Shaders>
class thread_counts {
  static_assert(Shaders < 16, "deferred_shade: an id must fit in four bits");
  static constexpr std::uint32_t per_word = 3;
  static constexpr std::uint32_t bits = 10;
  static_assert(16 * warp_size < 1U << bits,
                "deferred_shade: a count must hold the requests of a warp");

 public:
  /// The id `Shaders` is counted as well; ids above it are not.
  static constexpr std::uint32_t columns = Shaders + 1;
  static constexpr std::uint32_t words = (columns + per_word - 1) / per_word;

  /// The word that has the count of shader k.
  __device__ static constexpr std::uint32_t word_of(shader_id k) { return k / per_word; }

  /// The count of shader k, from its word.
  __device__ static constexpr std::uint32_t count_of(shader_id k, std::uint32_t word) {
    return word >> k % per_word * bits & ((1U << bits) - 1);
  }

  __device__ static void count(four_bit_keys keys, std::uint32_t (&counts)[words]) {
    // Each plane has one bit of all 16 ids, in every other bit of a word.
    std::uint32_t const lower = (keys.low & 0x33333333) | (keys.high << 2 & 0xcccccccc);
    std::uint32_t const upper = (keys.low >> 2 & 0x33333333) | (keys.high & 0xcccccccc);
    std::uint32_t const planes[] = {lower, lower >> 1, upper, upper >> 1};
#pragma unroll
    for (std::uint32_t& word : counts) word = 0;
#pragma unroll
    for (shader_id k = 0; k < columns; ++k) {
      std::uint32_t named = 0x55555555;
#pragma unroll
      for (std::uint32_t bit = 4; bit-- > 0;) named &= k >> bit & 1 ? planes[bit] : ~planes[bit];
      counts[word_of(k)] += static_cast<std::uint32_t>(__popc(named)) << k % per_word * bits;
    }
  }
};

}  // namespace DEFERRED_SHADE_ARCHITECTURES
}  // namespace deferred_shade::detail
