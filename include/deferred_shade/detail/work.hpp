// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>

#include <deferred_shade/detail/fail.hpp>
#include <deferred_shade/types.hpp>

// The checks and sums of statistics.hpp.

namespace deferred_shade::detail {

/// Throws std::invalid_argument if `array` is a null pointer while `n` is not 0.
template <class Array>
void check_array([[maybe_unused]] std::string const& caller, [[maybe_unused]] char const* name,
                 [[maybe_unused]] Array const& array, [[maybe_unused]] request_index n) {
  if constexpr (std::is_pointer_v<Array>) {
    if (array == nullptr && n != 0) {
      detail::fail<std::invalid_argument>("deferred_shade::" + caller + ": " + name +
                                          " is null, and n is not 0");
    }
  }
}

/// Two sums of costs: the work that shaders ask for, and the work for which one lane is held.
struct work {
  double useful = 0, held = 0;

  /// useful / (width * held), or `otherwise` if nothing is held.
  double efficiency(std::uint32_t width, double otherwise) const {
    return held > 0 ? useful / (width * held) : otherwise;
  }
  bool is_finite(std::uint32_t width) const {
    double const largest = (std::numeric_limits<double>::max)();
    return useful <= largest && width * held <= largest;
  }
};

/// The sums `sum(scale)` of costs that are multiplied by `scale`: 1, or 2^-128 if the sums are too
/// large for a double. The efficiency is the same.
template <class Sum>
work finite_work(std::uint32_t width, Sum const& sum) {
  work const plain = sum(1.0);
  return plain.is_finite(width) ? plain : sum(0x1p-128);
}

}  // namespace deferred_shade::detail
