// SPDX-License-Identifier: Apache-2.0
// A table that keeps no shader.
// error: only must be given an id
#include "program.hpp"

auto f(float* out) {
#ifdef RIGHT
  return ds::shader_table{mark{out}, mark{out}}.only<1>();
#else
  return ds::shader_table{mark{out}, mark{out}}.only<>();
#endif
}
