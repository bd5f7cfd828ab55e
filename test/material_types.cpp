// SPDX-License-Identifier: Apache-2.0
// The table of materials by type that docs/integrating.md shows.
#include <cstdint>
#include <vector>

#include "catch.hpp"
#include "examples/05_renderer/kernel_by_type.hpp"
#include "support/backends.hpp"
#include "support/random_ids.hpp"

namespace {

namespace ds = deferred_shade;

struct arrays {
  std::uint32_t* out;
};
template <int Number>
struct material {
  DEFERRED_SHADE_HOST_DEVICE void operator()(arrays const& a, ds::request_index i) const {
    a.out[i] = 1000000 * Number + i;
  }
};

}  // namespace

TEMPLATE_LIST_TEST_CASE("the position of a material's type is its id", "[examples]",
                        test::backends) {
  std::uint32_t const n = TestType::many_blocks, shaders = 3, seed = test::run_seed();
  CAPTURE(seed);
  auto const data = test::make_ids<std::uint8_t>(test::layout::random, n, shaders, seed);
  auto const ids = test::on<TestType>(data);
  auto out = test::on<TestType>(std::vector<std::uint32_t>(n));
  auto const exec = TestType::policy();
  ds::workspace scratch{exec};
  auto const table = table_of<material<7>, material<5>, material<9>>(arrays{out.data()});
  ds::shade(exec, ds::bucket_then_dispatch<>{}, n, ids.data(), table, scratch);
  TestType::wait();
  std::uint32_t const numbers[] = {7, 5, 9};
  std::vector<std::uint32_t> expected(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    if (data[i] < shaders) expected[i] = 1000000 * numbers[data[i]] + i;
  }
  CHECK(expected == std::vector<std::uint32_t>(out.begin(), out.end()));
}
