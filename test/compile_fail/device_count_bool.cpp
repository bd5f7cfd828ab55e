// SPDX-License-Identifier: Apache-2.0
// A count of one bit.
// errors: 3
// error: device_count must point at an integer that is not bool
#include "program.hpp"

#ifdef RIGHT
using count = int;
#else
using count = bool;
#endif
void f(count const* n, std::uint8_t* ids, float* out, ds::workspace<>& scratch) {
  ds::shader_table const table{mark{out}, mark{out}};
  ds::shade(thrust::cpp::par, ds::sort_then_dispatch<>{}, (ds::device_count{n, 5}), ids, table,
            scratch);
}
