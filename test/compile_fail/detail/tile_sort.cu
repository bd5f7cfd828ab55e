// SPDX-License-Identifier: Apache-2.0
// A tile with more positions than 16 bits have.
// errors: 1
// error: a position in a tile must fit in 16 bits
#include "../cuda.hpp"

#ifdef RIGHT
using sort = ds::detail::tile_sort<3, 512, 8>;
#else
using sort = ds::detail::tile_sort<3, 512, 128>;
#endif
auto f() { return sort::size; }
