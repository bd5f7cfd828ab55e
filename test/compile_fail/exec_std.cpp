// SPDX-License-Identifier: Apache-2.0
// A policy of the standard library.
// error: exec must be an execution policy of Thrust's system cpp, omp, tbb or, in code for nvcc,
// cuda; pass thrust::omp::par
#include "program.hpp"

#include <execution>

void f(std::uint8_t* ids, float* out, ds::workspace<>& scratch) {
  ds::shader_table const table{mark{out}, mark{out}};
#ifdef RIGHT
  ds::shade(thrust::cpp::par, ds::sort_then_dispatch<>{}, 5, ids, table, scratch);
#else
  ds::shade(std::execution::par, ds::sort_then_dispatch<>{}, 5, ids, table, scratch);
#endif
}
