// SPDX-License-Identifier: Apache-2.0
// scripts/test compiles this with nvcc for Thrust's cpp system: the library's headers, and those
// schedules that do not need Thrust's own sort, which nvcc takes for the CUDA system alone.
#include <thrust/execution_policy.h>
#include <vector>

#include "../test/odr/shade_sum.hpp"

int main() {
  namespace ds = deferred_shade;
  bool const right = shade_sum(thrust::device, ds::implicit_serialization{}) &&
                     shade_sum(thrust::device, ds::explicit_serialization{}) &&
                     shade_sum(thrust::device, ds::compact_then_dispatch<>{}) &&
                     shade_sum(thrust::device, ds::bucket_then_dispatch<>{}) &&
                     shade_sum(thrust::device, ds::local_sort_then_dispatch<>{});
  // Ids behind an iterator that is for the host alone.
  std::vector<std::uint8_t> const ids{0, 1, 0};
  int results[3] = {};
  ds::workspace scratch{thrust::cpp::par};
  ds::shade(thrust::cpp::par, ds::bucket_then_dispatch<>{}, ids.size(), ids.begin(),
            ds::shader_table{add{results, 1}, add{results, 10}}, scratch);
  return right && results[0] == 1 && results[1] == 10 && results[2] == 1 ? 0 : 1;
}
