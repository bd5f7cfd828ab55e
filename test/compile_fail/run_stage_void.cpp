// SPDX-License-Identifier: Apache-2.0
// A shader that returns nothing as a stage.
// error: a stage must return the id of the next stage, an integer or an enumerator of at most 32
// bits; the sink of a record stage returns it from sink\(slot, result\)
#include "program.hpp"

struct begin {
  ds::shader_id operator()(ds::request_index, ds::item_index) const { return 0; }
};
struct last_stage {
  float* out;
#ifdef RIGHT
  ds::shader_id operator()(ds::request_index i) const {
    out[i] = 1;
    return 1;
  }
#else
  void operator()(ds::request_index i) const { out[i] = 1; }
#endif
};

void f(float* out, ds::workspace<>& scratch) {
  ds::run(thrust::cpp::par, ds::wavefront{}, ds::items{5, 5}, begin{},
          ds::shader_table{last_stage{out}}, scratch);
}
