// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <type_traits>

namespace test {

/// The first position at which two arrays of one size differ in any bit, or their size.
template <class A, class B>
std::size_t first_difference(A const& a, B const& b) {
  using value_type = typename A::value_type;
  static_assert(std::is_same_v<value_type, typename B::value_type>);
  static_assert(std::has_unique_object_representations_v<value_type> ||
                std::is_floating_point_v<value_type>);
  if (a.size() != b.size()) throw std::invalid_argument("arrays of two sizes");
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::memcmp(&a[i], &b[i], sizeof(value_type)) != 0) return i;
  }
  return a.size();
}

}  // namespace test
