// SPDX-License-Identifier: Apache-2.0
// Ids of no type.
// error: ids must be a random-access iterator over shader ids
#include "program.hpp"

void f(void const* ids, float* out, ds::workspace<>& scratch) {
  ds::shader_table const table{mark{out}, mark{out}};
#ifdef RIGHT
  ds::shade(thrust::cpp::par, ds::sort_then_dispatch<>{}, 5, static_cast<std::uint8_t const*>(ids),
            table, scratch);
#else
  ds::shade(thrust::cpp::par, ds::sort_then_dispatch<>{}, 5, ids, table, scratch);
#endif
}
