// SPDX-License-Identifier: Apache-2.0
#include <deferred_shade/dispatch/implicit.hpp>
#include <utility>

#include "../support/schedule_properties.hpp"

using schedule = test::ds::implicit_serialization;

TEMPLATE_LIST_TEST_CASE("implicit_serialization runs every request once", "[schedule]",
                        test::backends) {
  test::check_schedule<TestType, schedule>();
}

TEST_CASE("implicit_serialization keeps the order within a shader", "[schedule]") {
  test::check_stable<schedule>();
}

TEMPLATE_LIST_TEST_CASE("implicit_serialization runs a grouping, empty segments included",
                        "[dispatch]", test::backends) {
  // Requests 4, 0 for shader 1; 3, 1 for shader 3; none for shaders 0, 2 and 4. Request 2 names no
  // shader, and stands behind the last segment.
  test::ds::request_index const permutation[] = {4, 0, 3, 1, 2};
  test::ds::request_index const offsets[] = {0, 0, 2, 2, 4, 4};
  int seen[5] = {-1, -1, -1, -1, -1};
  auto const note = [&seen](int id) {
    return [&seen, id](test::ds::request_index i) { seen[i] = id; };
  };
  schedule{}(TestType::policy(), test::ds::grouping{permutation, offsets},
             test::ds::shader_table{note(0), note(1), note(2), note(3), note(4)});
  int const expected[] = {1, 3, -1, 3, 1};
  for (int i = 0; i < 5; ++i) CHECK(seen[i] == expected[i]);
}
