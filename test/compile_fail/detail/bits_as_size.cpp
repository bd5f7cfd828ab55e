// SPDX-License-Identifier: Apache-2.0
// Bits of another size.
// errors: 2
// error: bits must be taken as a type of the same size
#include "../program.hpp"

#include <deferred_shade/detail/bits.hpp>

#ifdef RIGHT
auto f() { return ds::detail::bits_as<int>(1.0F); }
#else
auto f() { return ds::detail::bits_as<int>(1.0); }
#endif
