// SPDX-License-Identifier: Apache-2.0
// Numbers of stages in an array of floats.
// error: next must point at integers or enumerators of at most 32 bits
#include "program.hpp"

struct last_stage {
  ds::shader_id operator()(ds::request_index) const { return 1; }
};
#ifdef RIGHT
using number = int;
#else
using number = float;
#endif
auto f(number* next) { return ds::stepping(ds::shader_table{last_stage{}}, next); }
