// SPDX-License-Identifier: Apache-2.0
// A source that cannot be read.
// error: the source of record shaders must be readable as source\[i\] or source\(i\)
#include "program.hpp"

struct source {};

void f(std::uint8_t* ids, hit const* hits, color* out, ds::workspace<>& scratch) {
  static_cast<void>(out);
  static_cast<void>(hits);
#ifdef RIGHT
  auto const table = ds::record_shaders(hits, out, matte{});
#else
  auto const table = ds::record_shaders(source{}, out, matte{});
#endif
  ds::shade(thrust::cpp::par, ds::sort_then_dispatch<>{}, 5, ids, table, scratch);
}
