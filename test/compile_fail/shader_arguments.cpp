// SPDX-License-Identifier: Apache-2.0
// A function of records in a table of index shaders.
// errors: 2
// error: a shader must be callable as shader\(request_index\), by an operator\(\) that is const;
// pass functions of records to record_shaders
#include "program.hpp"

void f(std::uint8_t* ids, hit const* hits, color* out, ds::workspace<>& scratch) {
#ifdef RIGHT
  auto const table = ds::record_shaders(hits, out, matte{}, matte{});
#else
  ds::shader_table const table{matte{}, matte{}};
#endif
  ds::shade(thrust::cpp::par, ds::sort_then_dispatch<>{}, 5, ids, table, scratch);
}
