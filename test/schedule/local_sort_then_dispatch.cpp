// SPDX-License-Identifier: Apache-2.0
// Covers schedule.hpp and detail/tile_sorts.hpp.
#include <deferred_shade/schedule.hpp>

#include "support/schedule_properties.hpp"

namespace {

using with_counting = test::ds::local_sort_then_dispatch<>;
using with_bitonic = test::ds::local_sort_then_dispatch<test::ds::bitonic>;

}  // namespace

TEMPLATE_LIST_TEST_CASE("local_sort_then_dispatch, counting, runs every request once", "[schedule]",
                        test::backends) {
  test::check_schedule<TestType, with_counting>();
}

TEMPLATE_LIST_TEST_CASE("local_sort_then_dispatch, bitonic, runs every request once", "[schedule]",
                        test::backends) {
  test::check_schedule<TestType, with_bitonic>();
}

TEST_CASE("local_sort_then_dispatch keeps the order within a shader", "[schedule]") {
  test::check_stable<with_counting>();
  test::check_stable<with_bitonic>();
}

TEST_CASE("local_sort_then_dispatch finishes a tile before it begins the next", "[schedule]") {
  // On one worker, the order of execution is: tile by tile, and inside a tile shader by shader.
  constexpr test::ds::request_index tile = test::ds::cpu_tuning::tile;
  std::uint32_t const n = 2 * tile + 100;
  auto const ids = test::make_ids<std::uint8_t>(test::layout::random, n, 2, test::run_seed());
  std::vector<std::uint32_t> order;
  auto const append = [&order](test::ds::request_index i) { order.push_back(i); };
  test::ds::workspace scratch{thrust::cpp::par};
  test::ds::shade(thrust::cpp::par, with_counting{}, n, ids.data(),
                  test::ds::shader_table{append, append}, scratch);
  std::vector<std::uint32_t> expected;
  for (std::uint32_t first = 0; first < n; first += tile) {
    for (std::uint32_t id = 0; id < 2; ++id) {
      for (std::uint32_t i = first; i < std::min(n, first + tile); ++i) {
        if (ids[i] == id) expected.push_back(i);
      }
    }
  }
  CHECK(order == expected);
}
