// SPDX-License-Identifier: Apache-2.0
// Three shaders do not have ids that are true or false.
// error: the type of ids must be wide enough for the id of the last shader
#include "program.hpp"

void f(bool const* ids, ds::workspace<>& scratch) {
  auto const table = table_of(std::make_integer_sequence<int,
#ifdef RIGHT
                                                         2
#else
                                                         3
#endif
                                                         >{});
  ds::shade(thrust::cpp::par, ds::implicit_serialization{}, 5, ids, table, scratch);
}
