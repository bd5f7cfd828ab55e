// SPDX-License-Identifier: Apache-2.0
// A function that returns nothing.
// error: the function of a record shader must return its result; put a shader that stores by itself
// into a shader_table
#include "program.hpp"

void f(std::uint8_t* ids, hit const* hits, color* out, ds::workspace<>& scratch) {
  static_cast<void>(out);
  static_cast<void>(hits);
#ifdef RIGHT
  auto const table = ds::record_shaders(hits, out, matte{});
#else
  auto const table = ds::record_shaders(hits, out, [](hit const&) {});
#endif
  ds::shade(thrust::cpp::par, ds::sort_then_dispatch<>{}, 5, ids, table, scratch);
}
