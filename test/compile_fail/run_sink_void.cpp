// SPDX-License-Identifier: Apache-2.0
// A record stage whose sink does not name the next stage.
// error: a stage must return the id of the next stage, an integer or an enumerator of at most 32
// bits; the sink of a record stage returns it from sink\(slot, result\)
#include "program.hpp"

struct begin {
  ds::shader_id operator()(ds::request_index, ds::item_index) const { return 0; }
};
struct store {
  color* out;
  ds::shader_id operator()(ds::request_index i, color const& c) const {
    out[i] = c;
    return 1;
  }
};

void f(hit const* hits, color* out, ds::workspace<>& scratch) {
#ifdef RIGHT
  auto const stages = ds::record_shaders(hits, store{out}, matte{});
#else
  auto const stages = ds::record_shaders(hits, out, matte{});
#endif
  ds::run(thrust::cpp::par, ds::wavefront{}, ds::items{5, 5}, begin{}, stages, scratch);
}
