// SPDX-License-Identifier: Apache-2.0
// A function that begins a request, and does not know of which item.
// error: begin must be callable as begin\(slot, item\), by an operator\(\) that is const, and
// return the id of the first stage
#include "program.hpp"

struct begin {
#ifdef RIGHT
  ds::shader_id operator()(ds::request_index, ds::item_index) const { return 0; }
#else
  ds::shader_id operator()(ds::request_index) const { return 0; }
#endif
};
struct last_stage {
  ds::shader_id operator()(ds::request_index) const { return 1; }
};

void f(ds::workspace<>& scratch) {
  ds::run(thrust::cpp::par, ds::wavefront{}, ds::items{5, 5}, begin{},
          ds::shader_table{last_stage{}}, scratch);
}
