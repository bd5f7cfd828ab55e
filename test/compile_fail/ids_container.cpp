// SPDX-License-Identifier: Apache-2.0
// A container where an iterator belongs.
// error: ids must be a random-access iterator over shader ids; pass ids.data\(\)
#include "program.hpp"

void f(std::vector<std::uint8_t> const& ids, float* out, ds::workspace<>& scratch) {
  ds::shader_table const table{mark{out}, mark{out}};
#ifdef RIGHT
  ds::shade(thrust::cpp::par, ds::sort_then_dispatch<>{}, 5, ids.begin(), table, scratch);
#else
  ds::shade(thrust::cpp::par, ds::sort_then_dispatch<>{}, 5, ids, table, scratch);
#endif
}
