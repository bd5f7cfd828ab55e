// SPDX-License-Identifier: Apache-2.0
// A container for a sink: it would be copied with every shader.
// error: the sink of record shaders must be writable .* and no container
#include "program.hpp"

void f(std::uint8_t* ids, hit const* hits, color* out, ds::workspace<>& scratch) {
  static_cast<void>(out);
  static_cast<void>(hits);
#ifdef RIGHT
  auto const table = ds::record_shaders(hits, out, matte{});
#else
  auto const table = ds::record_shaders(hits, std::vector<color>(5), matte{});
#endif
  ds::shade(thrust::cpp::par, ds::sort_then_dispatch<>{}, 5, ids, table, scratch);
}
