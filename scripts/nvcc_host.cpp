// SPDX-License-Identifier: Apache-2.0
// scripts/test compiles this with nvcc for Thrust's cpp system: the library's headers, and those
// schedules that do not need Thrust's own sort, which nvcc takes for the CUDA system alone.
#include <thrust/execution_policy.h>

#include "../test/odr/shade_sum.hpp"

int main() {
  namespace ds = deferred_shade;
  bool const right = shade_sum(thrust::device, ds::implicit_serialization{}) &&
                     shade_sum(thrust::device, ds::explicit_serialization{}) &&
                     shade_sum(thrust::device, ds::compact_then_dispatch<>{}) &&
                     shade_sum(thrust::device, ds::bucket_then_dispatch<>{}) &&
                     shade_sum(thrust::device, ds::local_sort_then_dispatch<>{});
  return right ? 0 : 1;
}
