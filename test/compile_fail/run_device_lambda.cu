// SPDX-License-Identifier: Apache-2.0
// A lambda for the device alone, which is to be a stage on a CPU.
// errors: 1
// error: a stage must not be a lambda for __device__ alone; write
#include <thrust/system/cpp/execution_policy.h>

#include "cuda.hpp"

struct begin {
  ds::shader_id operator()(ds::request_index, ds::item_index) const { return 0; }
};

void f(ds::workspace<>& scratch) {
#ifdef RIGHT
  auto const stage = [] __host__ __device__(ds::request_index) { return 1; };
#else
  auto const stage = [] __device__(ds::request_index) { return 1; };
#endif
  ds::run(thrust::cpp::par, ds::wavefront{}, ds::items{5, 5}, begin{}, ds::shader_table{stage},
          scratch);
}
