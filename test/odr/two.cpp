// SPDX-License-Identifier: Apache-2.0
// Both translation units instantiate every schedule, with the same types.
#include "shade_sum.hpp"

#include <thrust/execution_policy.h>

#include "../support/every_schedule.hpp"

bool first_unit();

int main() {
  bool right = first_unit();
  test::for_each_schedule([&](auto const& s) { right = shade_sum(thrust::device, s) && right; });
  return right ? 0 : 1;
}
