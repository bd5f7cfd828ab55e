// SPDX-License-Identifier: Apache-2.0
// A schedule that is written outside the library has the properties of those inside. This one reads
// the offsets of a grouping on the host, and so runs there alone.
#include <examples/largest_first_then_dispatch.hpp>

#include "support/schedule_properties.hpp"

TEMPLATE_LIST_TEST_CASE("a user's schedule runs every request once", "[schedule]",
                        test::host_backends) {
  test::check_schedule<TestType, largest_first_then_dispatch>();
}

TEST_CASE("a user's schedule keeps the order within a shader", "[schedule]") {
  test::check_stable<largest_first_then_dispatch>();
}
