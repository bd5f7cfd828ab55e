// SPDX-License-Identifier: Apache-2.0
// A number of requests that is none.
// error: n must be an integer or a device_count
#include "program.hpp"

void f(std::uint8_t* ids, float* out, ds::workspace<>& scratch) {
  ds::shader_table const table{mark{out}, mark{out}};
#ifdef RIGHT
  ds::shade(thrust::cpp::par, ds::sort_then_dispatch<>{}, 5, ids, table, scratch);
#else
  ds::shade(thrust::cpp::par, ds::sort_then_dispatch<>{}, 5.0, ids, table, scratch);
#endif
}
