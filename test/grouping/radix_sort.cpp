// SPDX-License-Identifier: Apache-2.0
#include <deferred_shade/grouping/radix_sort.hpp>

#include "../support/grouping_properties.hpp"

namespace {

template <class Id, test::ds::shader_id Shaders, class Policy>
void check(Policy const& exec) {
  test::check_grouping_of<Id, Shaders>(
      exec, [](auto const& policy, test::ds::request_index n, auto ids, auto& scratch) {
        return test::ds::group_by_radix_sort<Shaders>(policy, n, ids, scratch);
      });
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("group_by_radix_sort is a stable sort by shader", "[grouping]",
                        test::backends) {
  auto const exec = TestType::policy();
  check<std::uint8_t, 1>(exec);
  check<std::uint8_t, 5>(exec);
  check<std::int16_t, 40>(exec);
  check<std::uint32_t, 300>(exec);  // two-byte keys
}

TEST_CASE("a sort key is as narrow as the table allows", "[grouping]") {
  // One more value than the table has shaders: for requests that name none.
  STATIC_REQUIRE(sizeof(test::ds::detail::sort_key<1>) == 1);
  STATIC_REQUIRE(sizeof(test::ds::detail::sort_key<255>) == 1);
  STATIC_REQUIRE(sizeof(test::ds::detail::sort_key<256>) == 2);
  STATIC_REQUIRE(sizeof(test::ds::detail::sort_key<65535>) == 2);
  STATIC_REQUIRE(sizeof(test::ds::detail::sort_key<65536>) == 4);
}
