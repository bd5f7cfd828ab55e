// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "scene/math.hpp"

namespace path_tracer {

/// The finaliser of SplitMix64 (Steele, Lea and Flood 2014): a bijection that mixes all 64 bits.
PT_HD inline std::uint64_t mix_bits(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// The random numbers of one sample of one pixel: a function of (seed, pixel, sample, index) alone.
/// A path draws the same numbers whatever runs before or beside it.
class random_stream {
 public:
  PT_HD random_stream(std::uint64_t seed, std::uint32_t pixel, std::uint32_t sample)
      : key_(mix_bits(mix_bits(seed + step) + ((std::uint64_t{sample} << 32) | pixel))) {}

  /// The pair number `index`: two independent numbers, uniform in [0, 1), multiples of 2^-24.
  PT_HD vec2 pair(std::uint32_t index) const {
    std::uint64_t const bits = mix_bits(key_ + (std::uint64_t{index} + 1) * step);
    return {static_cast<real>(bits >> 40) * real(0x1p-24),
            static_cast<real>((bits >> 16) & 0xffffffu) * real(0x1p-24)};
  }

 private:
  static constexpr std::uint64_t step = 0x9e3779b97f4a7c15u;  // 2^64 / golden ratio, odd
  std::uint64_t key_;
};

}  // namespace path_tracer
