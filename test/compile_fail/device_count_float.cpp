// SPDX-License-Identifier: Apache-2.0
// A count that is none.
// errors: 3
// error: device_count must point at an integer that is not bool
#include "program.hpp"

#ifdef RIGHT
using count = int;
#else
using count = float;
#endif
ds::device_count<count> f(count const* n) { return {n, 5}; }
