// SPDX-License-Identifier: Apache-2.0
// A shader that the table does not have.
// error: only must be given ids of the table
#include "program.hpp"

auto f(float* out) {
#ifdef RIGHT
  return ds::shader_table{mark{out}, mark{out}}.only<1>();
#else
  return ds::shader_table{mark{out}, mark{out}}.only<2>();
#endif
}
