// SPDX-License-Identifier: Apache-2.0
// Every header of the library in a program that has the macros of <windows.h>. Those of the
// standard library and of Thrust come first: they are not the library's to mend.
#include <thrust/binary_search.h>
#include <thrust/copy.h>
#include <thrust/count.h>
#include <thrust/execution_policy.h>
#include <thrust/for_each.h>
#include <thrust/iterator/counting_iterator.h>
#include <thrust/iterator/permutation_iterator.h>
#include <thrust/iterator/transform_iterator.h>
#include <thrust/iterator/transform_output_iterator.h>
#include <thrust/memory.h>
#include <thrust/scan.h>
#include <thrust/sort.h>
#include <thrust/system/cpp/execution_policy.h>
#include <thrust/type_traits/is_execution_policy.h>

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#define min(a, b) (((a) < (b)) ? (a) : (b))
#define max(a, b) (((a) > (b)) ? (a) : (b))
#define small char
#define near
#define far

#include <deferred_shade/deferred_shade.hpp>
#include <deferred_shade/math.hpp>
#include <deferred_shade/specialized.hpp>

#include "support/every_schedule.hpp"

namespace ds = deferred_shade;

int main() {
  std::vector<std::uint8_t> const ids{0, 1, 2, 1};
  std::vector<float> in{1, 2, 3, 4};
  std::vector<float> out(ids.size());
  auto const table = ds::record_shaders(
      in.data(), out.data(), [](float x) { return ds::math::exp(x); }, [](float x) { return -x; });
  ds::workspace scratch{thrust::cpp::par};
  int wrong = 0;
  test::for_each_schedule([&](auto const& schedule) {
    out.assign(out.size(), 0.0F);
    ds::shade(thrust::cpp::par, schedule, ids.size(), ids.data(), table, scratch);
    wrong += out != std::vector<float>{ds::math::exp(1.0F), -2, 0, -4};
  });
  return wrong;
}
