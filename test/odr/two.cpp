// SPDX-License-Identifier: Apache-2.0
#include "shade_sum.hpp"

#include <thrust/execution_policy.h>
#include <cstdio>

int first_unit();

int main() {
  int const first = first_unit();
  int const second = shade_sum(thrust::device, deferred_shade::bucket_then_dispatch<>{});
  std::printf("%d and %d, expected 22 twice\n", first, second);
  return first == 22 && second == 22 ? 0 : 1;
}
