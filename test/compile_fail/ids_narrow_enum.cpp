// SPDX-License-Identifier: Apache-2.0
// An enumeration has as many ids as its underlying type.
// error: the type of ids must be wide enough for the id of the last shader
#include "program.hpp"

enum class material : std::uint8_t { matte, glass };
void f(material const* ids, ds::workspace<>& scratch) {
  auto const table = table_of(std::make_integer_sequence<int,
#ifdef RIGHT
                                                         256
#else
                                                         257
#endif
                                                         >{});
  ds::shade(thrust::cpp::par, ds::implicit_serialization{}, 5, ids, table, scratch);
}
