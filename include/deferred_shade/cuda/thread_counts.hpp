// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <type_traits>

#include <deferred_shade/cuda/warp.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade::detail {

/// How often each shader is named by one thread's requests, four bits for each in one register or
/// two: for tables of at most 15 shaders, since those that name none are counted as well.
template <shader_id Shaders>
class thread_counts {
  static_assert(Shaders < 16, "64 bits hold 16 counts");
  using word = std::conditional_t<(Shaders < 8), std::uint32_t, std::uint64_t>;

 public:
  /// Counts come in pairs, two halves of a word: those of shaders 2 j and 2 j + 1.
  static constexpr std::uint32_t pairs = (Shaders + 2) / 2;

  /// Computes ranks[i], the number of this thread's requests of the same shader before request i,
  /// and pair_counts, of all its requests.
  template <std::uint32_t Items>
  __device__ static void rank(std::uint32_t const (&keys)[Items], std::uint32_t (&ranks)[Items],
                              std::uint32_t (&pair_counts)[pairs]) {
    static_assert(Items <= 16, "four bits count to 15, which is what a last request may find");
    word counts = 0;
    word half = 0;
#pragma unroll
    for (std::uint32_t item = 0; item < Items; ++item) {
      if (item == Items / 2) half = counts;
      std::uint32_t const shift = keys[item] * 4;
      ranks[item] = static_cast<std::uint32_t>(counts >> shift) & 15;
      counts += word{1} << shift;
      asm("" : "+r"(ranks[item]));  // else the compiler computes it a second time where it is used
    }
    // 16 requests of one shader have overflown; those of the second half have not.
    word const other_half = counts - half;
    constexpr auto low = static_cast<word>(0x0f0f0f0f0f0f0f0fU);
    word const even = (half & low) + (other_half & low);
    word const odd = (half >> 4 & low) + (other_half >> 4 & low);
#pragma unroll
    for (std::uint32_t j = 0; j < pairs; ++j) {
      auto const evens = static_cast<std::uint32_t>(even >> j / 4 * 32);
      auto const odds = static_cast<std::uint32_t>(odd >> j / 4 * 32);
      pair_counts[j] = __byte_perm(evens, odds, 0x0400 + 0x0101 * (j % 4)) & 0x00ff00ff;
    }
  }
};

}  // namespace deferred_shade::detail
