// SPDX-License-Identifier: Apache-2.0
// A workspace that is const.
// error: scratch must be a workspace that is not const
#include "program.hpp"

#ifdef RIGHT
using scratch_type = ds::workspace<>;
#else
using scratch_type = ds::workspace<> const;
#endif
void f(std::uint8_t* ids, float* out, scratch_type& scratch) {
  ds::shader_table const table{mark{out}, mark{out}};
  ds::shade(thrust::cpp::par, ds::sort_then_dispatch<>{}, 5, ids, table, scratch);
}
