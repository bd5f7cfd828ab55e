// SPDX-License-Identifier: Apache-2.0
// A function of other records than the source has.
// error: the function of a record shader must be callable with what the source gives, by an
// operator\(\) that is const; give it a parameter Request const&
#include "program.hpp"

void f(std::uint8_t* ids, hit const* hits, color* out, ds::workspace<>& scratch) {
  static_cast<void>(out);
  static_cast<void>(hits);
#ifdef RIGHT
  auto const table = ds::record_shaders(hits, out, matte{});
#else
  auto const table = ds::record_shaders(hits, out, [](int*) { return color{1}; });
#endif
  ds::shade(thrust::cpp::par, ds::sort_then_dispatch<>{}, 5, ids, table, scratch);
}
