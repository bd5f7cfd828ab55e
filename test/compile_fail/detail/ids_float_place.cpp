// SPDX-License-Identifier: Apache-2.0
// Ids that are no integers, in the place of a table with gaps.
// error: place_among must be called with an integer or an enumeration of at most 32 bits
#include "../program.hpp"

auto f() {
#ifdef RIGHT
  return ds::detail::place_among<5>{}(2);
#else
  return ds::detail::place_among<5>{}(2.0);
#endif
}
