// SPDX-License-Identifier: Apache-2.0
// 129 shaders do not have signed ids of 8 bits; 128 have.
// error: the type of ids must be wide enough for the id of the last shader
#include "program.hpp"

void f(std::int8_t const* ids, ds::workspace<>& scratch) {
  auto const table = table_of(std::make_integer_sequence<int,
#ifdef RIGHT
                                                         128
#else
                                                         129
#endif
                                                         >{});
  ds::shade(thrust::cpp::par, ds::implicit_serialization{}, 5, ids, table, scratch);
}
