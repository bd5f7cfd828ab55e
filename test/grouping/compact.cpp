// SPDX-License-Identifier: Apache-2.0
#include <deferred_shade/grouping/compact.hpp>

#include "../support/grouping_properties.hpp"

namespace {

template <class Id, test::ds::shader_id Shaders, class Policy>
void check(Policy const& exec) {
  test::check_grouping_of<Id, Shaders>(
      exec, [](auto const& policy, test::ds::request_index n, auto ids, auto& scratch) {
        return test::ds::group_by_compaction<Shaders>(policy, n, ids, scratch);
      });
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("group_by_compaction is a stable sort by shader", "[grouping]",
                        test::backends) {
  auto const exec = TestType::policy();
  check<std::uint8_t, 1>(exec);
  check<std::uint8_t, 5>(exec);
  check<std::int16_t, 40>(exec);
  check<std::uint32_t, 300>(exec);
}
