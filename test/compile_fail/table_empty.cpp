// SPDX-License-Identifier: Apache-2.0
// A table of no shader.
// errors: 3
// error: a shader table must have a shader
#include "program.hpp"

void f(std::uint8_t* ids, float* out, ds::workspace<>& scratch) {
#ifdef RIGHT
  ds::shader_table const table{mark{out}};
#else
  ds::shader_table const table{};
  static_cast<void>(out);
#endif
  ds::shade(thrust::cpp::par, ds::sort_then_dispatch<>{}, 5, ids, table, scratch);
}
