// SPDX-License-Identifier: Apache-2.0
// Covers detail/cpu/radix_sort.hpp and detail/cuda/radix_sort.hpp.
#include <deferred_shade/grouping.hpp>

#include "support/grouping_properties.hpp"

namespace {

template <class Backend, class Id, test::ds::shader_id Shaders>
void check() {
  test::check_grouping_of<Backend, Id, Shaders>(
      [](auto const& policy, test::ds::request_index n, auto ids, auto& scratch) {
        return test::ds::group_by_radix_sort<Shaders>(policy, n, ids, scratch);
      });
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("group_by_radix_sort is a stable sort by shader", "[grouping]",
                        test::backends) {
  check<TestType, std::uint8_t, 1>();
  check<TestType, std::uint8_t, 5>();
  check<TestType, std::int8_t, 11>();
  check<TestType, std::int16_t, 33>();
  check<TestType, std::uint8_t, 255>();
  check<TestType, std::uint16_t, 256>();  // two-byte keys from here on
  if (test::quick()) return;              // under racecheck, minutes
  check<TestType, std::uint32_t, 1000>();
  check<TestType, std::int32_t, 3000>();
}
