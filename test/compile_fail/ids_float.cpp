// SPDX-License-Identifier: Apache-2.0
// Ids that are no integers.
// error: a shader id must be an integer or an enumeration of at most 32 bits, and not volatile
#include "program.hpp"

#ifdef RIGHT
using id = std::uint8_t;
#else
using id = float;
#endif
void f(id const* ids, float* out, ds::workspace<>& scratch) {
  ds::shader_table const table{mark{out}, mark{out}};
  ds::shade(thrust::cpp::par, ds::sort_then_dispatch<>{}, 5, ids, table, scratch);
}
