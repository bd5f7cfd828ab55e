// SPDX-License-Identifier: Apache-2.0
// A shader that changes itself.
// error: a shader must be callable as shader\(request_index\), by an operator\(\) that is const
#include "program.hpp"

struct shader {
#ifdef RIGHT
  void operator()(ds::request_index) const {}
#else
  void operator()(ds::request_index) {}
#endif
};
void f(std::uint8_t* ids, ds::workspace<>& scratch) {
  ds::shader_table const table{shader{}};
  ds::shade(thrust::cpp::par, ds::sort_then_dispatch<>{}, 5, ids, table, scratch);
}
