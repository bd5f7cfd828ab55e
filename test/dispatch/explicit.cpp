// SPDX-License-Identifier: Apache-2.0
// Covers detail/cpu/explicit.hpp and detail/cuda/explicit.hpp.
#include <deferred_shade/dispatch.hpp>

#include "support/schedule_properties.hpp"

using schedule = test::ds::explicit_serialization;

TEMPLATE_LIST_TEST_CASE("explicit_serialization runs every request once", "[schedule]",
                        test::backends) {
  test::check_schedule<TestType, schedule>();
}

TEST_CASE("explicit_serialization keeps the order within a shader", "[schedule]") {
  test::check_stable<schedule>();
}

TEMPLATE_LIST_TEST_CASE("explicit_serialization runs a grouping, empty segments included",
                        "[dispatch]", test::backends) {
  test::check_dispatch<TestType, schedule>();
}
