// SPDX-License-Identifier: Apache-2.0
// A schedule is a function object. This one, from largest_first_then_dispatch.hpp, is not the
// library's, and is passed like any other.
#include <thrust/system/cpp/execution_policy.h>
#include <cstdint>
#include <cstdio>
#include <deferred_shade/deferred_shade.hpp>
#include <vector>

#include "largest_first_then_dispatch.hpp"

namespace ds = deferred_shade;

int main() {
  std::vector<int> const ids{0, 2, 1, 2, 2, 1, -1};
  std::vector<int> order;
  auto const shader = [&order](ds::request_index i) { order.push_back(static_cast<int>(i)); };

  ds::workspace scratch{thrust::cpp::par};
  ds::shade(thrust::cpp::par, largest_first_then_dispatch{}, ids.size(), ids.data(),
            ds::shader_table{shader, shader, shader}, scratch);

  for (int const i : order) std::printf("%d ", i);  // 1 3 4 2 5 0: shader 2, then 1, then 0
  std::printf("\n");
  return order == std::vector<int>{1, 3, 4, 2, 5, 0} ? 0 : 1;
}
