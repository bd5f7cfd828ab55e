// SPDX-License-Identifier: Apache-2.0
// Covers dispatch.hpp, detail/cpu/implicit.hpp and detail/cuda/implicit.hpp.
#include <deferred_shade/dispatch.hpp>

#include <numeric>

#include "support/schedule_properties.hpp"

using schedule = test::ds::implicit_serialization;

namespace {

/// Adds 1 + 100 * id to the cell of a request.
struct adding_shader {
  int id;
  int* cells;
  DEFERRED_SHADE_HOST_DEVICE void operator()(test::ds::request_index i) const {
    cells[i] += 1 + 100 * id;
  }
};

}  // namespace

TEMPLATE_LIST_TEST_CASE("implicit_serialization runs every request once", "[schedule]",
                        test::backends) {
  test::check_schedule<TestType, schedule>();
}

TEST_CASE("implicit_serialization keeps the order within a shader", "[schedule]") {
  test::check_stable<schedule>();
}

TEMPLATE_LIST_TEST_CASE("implicit_serialization runs a grouping, empty segments included",
                        "[dispatch]", test::backends) {
  test::check_dispatch<TestType, schedule>();
}

TEMPLATE_LIST_TEST_CASE("implicit_serialization runs a grouping of many blocks once", "[dispatch]",
                        test::backends) {
  // A block has 16384 requests, and its share of each segment.
  for (std::uint32_t const n : {16383U, 16384U, 16385U, 32768U, 49153U, 131071U, 344064U}) {
    CAPTURE(n);
    std::vector<test::ds::request_index> backwards(n);
    std::iota(backwards.rbegin(), backwards.rend(), 0U);
    auto const permutation = test::on<TestType>(backwards);
    std::uint32_t const first_of_2 = n / 3;
    auto const offsets =
        test::on<TestType>(std::vector<test::ds::request_index>{0, 0, first_of_2, n});
    auto cells = test::on<TestType>(std::vector<int>(n, 0));
    auto const add = [&cells](int id) { return adding_shader{id, cells.data()}; };
    schedule{}(TestType::policy(), test::ds::grouping{permutation.data(), offsets.data(), n},
               test::ds::shader_table{add(0), add(1), add(2)});
    TestType::wait();
    std::uint32_t wrong = 0;
    for (std::uint32_t i = 0; i < n; ++i) wrong += cells[i] != (n - 1 - i < first_of_2 ? 101 : 201);
    CHECK(wrong == 0);
  }
}
