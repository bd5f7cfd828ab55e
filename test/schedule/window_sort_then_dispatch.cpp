// SPDX-License-Identifier: Apache-2.0
#include <deferred_shade/schedule.hpp>

#include "support/schedule_properties.hpp"

using schedule = test::ds::window_sort_then_dispatch;

TEMPLATE_LIST_TEST_CASE("window_sort_then_dispatch runs every request once", "[schedule]",
                        test::backends) {
  test::check_schedule<TestType, schedule>();
}

TEMPLATE_LIST_TEST_CASE("window_sort_then_dispatch takes batches of several windows", "[schedule]",
                        test::backends) {
  // Windows of 2^15 requests on a CPU and 2^17 on a GPU: around the end of one, and of two.
  test::ds::workspace scratch{TestType::policy()};
  test::check_id_type<TestType, std::uint8_t, 7>(schedule{}, scratch,
                                                 {32767, 32769, 65537, 131071, 131073, 262145});
}

TEST_CASE("window_sort_then_dispatch keeps the order within a shader", "[schedule]") {
  test::check_stable<schedule>();
}

TEST_CASE("window_sort_then_dispatch finishes a window before it begins the next", "[schedule]") {
  // On one worker: window by window, and inside a window shader by shader.
  constexpr std::uint32_t window = test::ds::cpu_tuning::tile;
  std::uint32_t const n = 2 * window + 100;
  auto const ids = test::make_ids<std::uint8_t>(test::layout::random, n, 2, test::run_seed());
  std::vector<std::uint32_t> order;
  auto const append = [&order](test::ds::request_index i) { order.push_back(i); };
  test::ds::workspace scratch{thrust::cpp::par};
  test::ds::shade(thrust::cpp::par, schedule{}, n, ids.data(),
                  test::ds::shader_table{append, append}, scratch);
  std::vector<std::uint32_t> expected;
  for (std::uint32_t first = 0; first < n; first += window) {
    for (std::uint32_t id = 0; id < 2; ++id) {
      for (std::uint32_t i = first; i < std::min(n, first + window); ++i) {
        if (ids[i] == id) expected.push_back(i);
      }
    }
  }
  CHECK(order == expected);
}
