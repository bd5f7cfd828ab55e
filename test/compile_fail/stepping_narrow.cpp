// SPDX-License-Identifier: Apache-2.0
// A type that has no number for a request that has ended.
// error: the type of next must be wide enough for the size of the table
#include "program.hpp"

#ifdef RIGHT
using number = std::uint16_t;
#else
using number = std::uint8_t;
#endif
struct any {
  ds::shader_id operator()(ds::shader_id, ds::request_index) const { return 256; }
};
auto f(number* next) { return ds::stepping(ds::shared_shaders<256>(any{}), next); }
