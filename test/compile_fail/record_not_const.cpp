// SPDX-License-Identifier: Apache-2.0
// A function that changes itself.
// error: the function of a record shader must be callable with what the source gives, by an
// operator\(\) that is const
#include "program.hpp"

struct counting_matte {
  int calls = 0;
  color operator()(hit const& h) { return {h.a + static_cast<float>(calls++)}; }
};

void f(std::uint8_t* ids, hit const* hits, color* out, ds::workspace<>& scratch) {
  static_cast<void>(out);
  static_cast<void>(hits);
#ifdef RIGHT
  auto const table = ds::record_shaders(hits, out, matte{});
#else
  auto const table = ds::record_shaders(hits, out, counting_matte{});
#endif
  ds::shade(thrust::cpp::par, ds::sort_then_dispatch<>{}, 5, ids, table, scratch);
}
