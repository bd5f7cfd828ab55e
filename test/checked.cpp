// SPDX-License-Identifier: Apache-2.0
// The shaders here are of types that no other file has: there, shade() is compiled without checks.
// Covers detail/expected_ids.hpp and detail/cuda/expected_ids.hpp.
#define DEFERRED_SHADE_CHECKED
#include <deferred_shade/shade.hpp>

#include <bitset>
#include <cstdint>
#include <vector>

#include "catch.hpp"
#include "support/backends.hpp"

namespace {

namespace ds = deferred_shade;

template <int>
struct count_for_check {
  std::uint32_t* runs;
  DEFERRED_SHADE_HOST_DEVICE void operator()(ds::request_index i) const { ++runs[i]; }
};

}  // namespace

TEMPLATE_LIST_TEST_CASE("with DEFERRED_SHADE_CHECKED, shade finds ids that are not expected",
                        "[shade]", test::backends) {
  auto const exec = TestType::policy();
  ds::workspace scratch{exec};
  auto const ids = test::on<TestType>(std::vector<std::uint8_t>{0, 1, 9, 0, 2, 1});
  auto runs = test::on<TestType>(std::vector<std::uint32_t>(ids.size()));
  std::uint32_t* const out = runs.data();
  ds::shader_table const all{count_for_check<0>{out}, count_for_check<1>{out},
                             count_for_check<2>{out}};
  auto const shade = [&](auto const& table) {
    ds::shade(exec, ds::bucket_then_dispatch<>{}, ids.size(), ids.data(), table, scratch);
    TestType::wait();
  };
  CHECK_THROWS_WITH(shade(all.expecting(std::bitset<3>("011"))),
                    "deferred_shade::shade: request 4 names shader 2, which expecting() was told "
                    "not to occur");
  CHECK_THROWS_WITH(shade(all.expecting({})),
                    "deferred_shade::shade: request 0 names shader 0, which expecting() was told "
                    "not to occur");
  CHECK(std::vector<std::uint32_t>(runs.begin(), runs.end()) == std::vector<std::uint32_t>(6));
  CHECK_NOTHROW(shade(all));
  CHECK_NOTHROW(shade(all.expecting(std::bitset<3>("111"))));
  // Without shader 2, its request is left alone, expected or not.
  CHECK_NOTHROW(shade(all.template only<0, 1>().expecting(std::bitset<3>("011"))));
  CHECK(std::vector<std::uint32_t>(runs.begin(), runs.end()) ==
        std::vector<std::uint32_t>{3, 3, 0, 3, 2, 3});
}
