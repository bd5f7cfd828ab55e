// SPDX-License-Identifier: Apache-2.0
// Covers detail/cuda/architectures.hpp.
#include <thrust/execution_policy.h>

#include "../support/every_schedule.hpp"
#include "shade_sum.hpp"

bool first_unit() {
  bool right = true;
  test::for_each_schedule([&](auto const& s) { right = shade_sum(thrust::device, s) && right; });
  return right;
}
