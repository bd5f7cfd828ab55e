// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "random_ids.hpp"

namespace test {

/// How far `got` is from `exact` in units in the last place: 0.5, the most that it can be, if
/// `exact` rounds to `got`, the same infinity included; 0 if both are NaN.
inline double error_in_ulp(float got, long double exact) {
  double const infinity = std::numeric_limits<double>::infinity();
  auto const rounded = static_cast<float>(exact);
  if (std::isnan(got) || std::isnan(rounded)) {
    return std::isnan(got) && std::isnan(rounded) ? 0 : infinity;
  }
  if (got == rounded) return 0.5;
  if (std::isinf(got) || std::isinf(rounded)) return infinity;
  int exponent = -200;
  if (rounded != 0) std::frexp(rounded, &exponent);
  long double const ulp = std::ldexp(1.0L, std::max(exponent - 24, -149));
  return static_cast<double>(std::fabs(got - exact) / ulp);
}

/// The float with these bits.
inline float float_of(std::uint32_t bits) {
  float result;
  std::memcpy(&result, &bits, sizeof result);
  return result;
}

/// About a hundred thousand floats, of all signs and exponents, NaN and denormal numbers among
/// them; other ones for other seeds.
inline std::vector<float> floats_of_all_kinds() {
  std::uint32_t const stride = 40009;
  std::vector<float> result;
  for (std::uint64_t bits = run_seed() % stride; bits <= 0xffffffffU; bits += stride) {
    result.push_back(float_of(static_cast<std::uint32_t>(bits)));
  }
  return result;
}

}  // namespace test
