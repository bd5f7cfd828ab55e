// SPDX-License-Identifier: Apache-2.0
// Elements that need a constructor.
// error: elements of a workspace must be of a trivial type
#include "program.hpp"

auto f() {
#ifdef RIGHT
  return ds::elements<float>(5).count;
#else
  return ds::elements<std::vector<float> >(5).count;
#endif
}
