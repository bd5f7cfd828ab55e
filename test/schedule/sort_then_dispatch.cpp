// SPDX-License-Identifier: Apache-2.0
#include <deferred_shade/schedule.hpp>

#include <deferred_shade/dispatch.hpp>

#include "support/schedule_properties.hpp"

namespace {

using with_explicit = test::ds::sort_then_dispatch<>;
using with_implicit = test::ds::sort_then_dispatch<test::ds::implicit_serialization>;

}  // namespace

TEMPLATE_LIST_TEST_CASE("sort_then_dispatch, explicit, runs every request once", "[schedule]",
                        test::backends) {
  test::check_schedule<TestType, with_explicit>();
}

TEMPLATE_LIST_TEST_CASE("sort_then_dispatch, implicit, runs every request once", "[schedule]",
                        test::backends) {
  test::check_schedule<TestType, with_implicit>();
}

TEST_CASE("sort_then_dispatch keeps the order within a shader", "[schedule]") {
  test::check_stable<with_explicit>();
  test::check_stable<with_implicit>();
}
