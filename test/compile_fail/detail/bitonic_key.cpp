// SPDX-License-Identifier: Apache-2.0
// A table that the bitonic network has no keys for.
// error: a shader and a position in a tile must fit in 32 bits; take fewer shaders
#include "../program.hpp"

#ifdef RIGHT
auto f() { return ds::detail::bitonic_key<1000>(1, 1); }
#else
auto f() { return ds::detail::bitonic_key<16777216>(1, 1); }
#endif
