// SPDX-License-Identifier: Apache-2.0
// A table whose ids have more than four bits.
// errors: 1
// error: an id must fit in four bits
#include "../cuda.hpp"

#ifdef RIGHT
using counts = ds::detail::thread_counts<15>;
#else
using counts = ds::detail::thread_counts<16>;
#endif
auto f() { return sizeof(counts); }
