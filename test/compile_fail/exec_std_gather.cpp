// SPDX-License-Identifier: Apache-2.0
// A policy of the standard library, for `gather`.
// error: exec must be an execution policy of Thrust's system cpp, omp, tbb or, in code for nvcc,
// cuda; pass thrust::omp::par
#include "program.hpp"

#ifndef RIGHT
struct standard_policy {};
#endif
void f(ds::request_order order, float const* from, float* to) {
#ifdef RIGHT
  ds::gather(thrust::cpp::par, order, ds::moved{from, to});
#else
  ds::gather(standard_policy{}, order, ds::moved{from, to});
#endif
}
