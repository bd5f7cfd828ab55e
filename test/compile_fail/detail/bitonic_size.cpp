// SPDX-License-Identifier: Apache-2.0
// A network that is none.
// error: a bitonic network must have a power of two of keys
#include "../program.hpp"

#ifdef RIGHT
constexpr int size = 4;
#else
constexpr int size = 6;
#endif
void f() {
  std::uint32_t keys[size] = {};
  ds::detail::bitonic_sort(keys);
}
