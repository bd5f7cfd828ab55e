// SPDX-License-Identifier: Apache-2.0
// A lambda for the device alone, of which the host is told nothing.
// errors: 1
// error: a shader must be a lambda for __host__ __device__, not for __device__ alone; write
#include "cuda.hpp"

void f(std::uint8_t* ids, float* out, device_workspace& scratch) {
#ifdef RIGHT
  auto const function = [=] __host__ __device__(ds::request_index i) { out[i] = 1; };
#else
  auto const function = [=] __device__(ds::request_index i) { out[i] = 1; };
#endif
  ds::shade(thrust::cuda::par, ds::implicit_serialization{}, 5, ids, ds::shader_table{function},
            scratch);
}
