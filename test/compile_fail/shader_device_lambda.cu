// SPDX-License-Identifier: Apache-2.0
// A lambda for the device alone, which is to run on a CPU.
// errors: 1
// error: a shader that is a lambda for __device__ alone must have an exec for CUDA; write
#include <thrust/system/cpp/execution_policy.h>

#include "cuda.hpp"

void f(std::uint8_t* ids, float* out, ds::workspace<>& scratch) {
#ifdef RIGHT
  auto const function = [=] __host__ __device__(ds::request_index i) { out[i] = 1; };
#else
  auto const function = [=] __device__(ds::request_index i) { out[i] = 1; };
#endif
  ds::shade(thrust::cpp::par, ds::implicit_serialization{}, 5, ids, ds::shader_table{function},
            scratch);
}
