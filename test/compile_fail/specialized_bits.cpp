// SPDX-License-Identifier: Apache-2.0
// Bits for a smaller table.
// error: occurring must have as many bits as the table has shaders
#include "program.hpp"

#include <deferred_shade/specialized.hpp>

#ifdef RIGHT
using bits = std::bitset<2>;
#else
using bits = std::bitset<3>;
#endif
void f(std::uint8_t* ids, float* out, ds::workspace<>& scratch) {
  ds::shader_table const table{mark{out}, mark{out}};
  ds::specialized const schedule{ds::local_sort_then_dispatch<>{}, ds::variants<ds::ids<0>>{},
                                 bits(1)};
  ds::shade(thrust::cpp::par, schedule, 5, ids, table, scratch);
}
