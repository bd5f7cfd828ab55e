// SPDX-License-Identifier: Apache-2.0
// A tile with more positions than 16 bits have.
// error: a position in a tile must fit in 16 bits
#include "../program.hpp"

#ifdef RIGHT
auto f() { return sizeof(ds::detail::sorted_tile<3, 65536>); }
#else
auto f() { return sizeof(ds::detail::sorted_tile<3, 65537>); }
#endif
