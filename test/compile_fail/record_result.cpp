// SPDX-License-Identifier: Apache-2.0
// A result that the sink cannot store.
// error: the sink of record shaders must be writable as sink\[i\] = result or sink\(i, result\)
// with what the function returns
#include "program.hpp"

void f(std::uint8_t* ids, hit const* hits, color* out, ds::workspace<>& scratch) {
  static_cast<void>(out);
  static_cast<void>(hits);
#ifdef RIGHT
  auto const table = ds::record_shaders(hits, out, matte{});
#else
  auto const table = ds::record_shaders(hits, out, [](hit const&) { return "red"; });
#endif
  ds::shade(thrust::cpp::par, ds::sort_then_dispatch<>{}, 5, ids, table, scratch);
}
