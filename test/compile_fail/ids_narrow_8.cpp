// SPDX-License-Identifier: Apache-2.0
// 257 shaders do not have ids of 8 bits; 256 have.
// error: the type of ids must be wide enough for the id of the last shader
#include "program.hpp"

void f(std::uint8_t const* ids, ds::workspace<>& scratch) {
  auto const table = table_of(std::make_integer_sequence<int,
#ifdef RIGHT
                                                         256
#else
                                                         257
#endif
                                                         >{});
  ds::shade(thrust::cpp::par, ds::implicit_serialization{}, 5, ids, table, scratch);
}
