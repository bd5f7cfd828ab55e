// SPDX-License-Identifier: Apache-2.0
// A lambda for the device alone, whose result the host is not told.
// errors: 1
// error: lambdas of record shaders must be __host__ __device__, not __device__ alone
#include "cuda.hpp"

void f(std::uint8_t* ids, hit const* hits, color* out, device_workspace& scratch) {
#ifdef RIGHT
  auto const function = [=] __host__ __device__(hit const& h) { return color{h.a}; };
#else
  auto const function = [=] __device__(hit const& h) { return color{h.a}; };
#endif
  ds::shade(thrust::cuda::par, ds::implicit_serialization{}, 5, ids,
            ds::record_shaders(hits, out, function), scratch);
}
