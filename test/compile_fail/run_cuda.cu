// SPDX-License-Identifier: Apache-2.0
// A loop on a GPU, where `run` has none.
// errors: 1
// error: run must have an exec for a CPU; for CUDA, call shade in a loop
#include <thrust/system/cpp/execution_policy.h>

#include "cuda.hpp"

struct begin {
  ds::shader_id operator()(ds::request_index, ds::item_index) const { return 0; }
};
struct last_stage {
  DEFERRED_SHADE_HOST_DEVICE ds::shader_id operator()(ds::request_index) const { return 1; }
};

void f() {
#ifdef RIGHT
  auto const exec = thrust::cpp::par;
#else
  auto const exec = thrust::cuda::par;
#endif
  ds::workspace scratch{exec};
  ds::run(exec, ds::wavefront{}, ds::items{5, 5}, begin{}, ds::shader_table{last_stage{}}, scratch);
}
