// SPDX-License-Identifier: Apache-2.0
#include <deferred_shade/detail/cpu/tile.hpp>

#include <algorithm>
#include <memory>

#include "support/grouping_properties.hpp"

TEST_CASE("a tile is sorted stably, whatever its size", "[grouping]") {
  // One tile at a time has the contract of a grouping, over 16-bit indices.
  constexpr test::ds::request_index tile = 512;
  auto const result = std::make_unique<test::ds::detail::sorted_tile<7, tile>>();
  for (std::uint32_t size : {0U, 1U, 31U, 32U, 33U, 511U, 512U}) {
    for (test::layout const how : test::layouts) {
      std::uint32_t const seed = test::run_seed() + size;
      CAPTURE(size, static_cast<int>(how), seed);
      std::uint32_t const first = 1000;
      auto const ids = test::make_ids<std::uint8_t>(how, first + size, 7, seed);
      test::ds::detail::counting_sort<test::ds::cpu_tuning>(ids.data(), first, size, *result);
      std::vector<std::uint32_t> expected;
      for (std::uint32_t id = 0; id < 7; ++id) {
        REQUIRE(result->offsets[id] == expected.size());
        for (std::uint32_t i = 0; i < size; ++i) {
          if (ids[first + i] == id) expected.push_back(i);
        }
      }
      REQUIRE(result->offsets[7] == expected.size());
      bool const same = std::equal(expected.begin(), expected.end(), result->order);
      CHECK(same);
    }
  }
}

TEST_CASE("the bitonic network sorts", "[grouping]") {
  std::mt19937 engine(test::run_seed());
  std::uint32_t keys[256];
  for (int trial = 0; trial < 200; ++trial) {
    CAPTURE(test::run_seed(), trial);
    std::uint32_t const range = trial % 2 == 0 ? 4 : 0xffffffffU;
    for (auto& key : keys) key = static_cast<std::uint32_t>(engine()) % range;
    std::vector<std::uint32_t> expected(std::begin(keys), std::end(keys));
    std::sort(expected.begin(), expected.end());
    test::ds::detail::bitonic_sort(keys);
    CHECK(std::equal(expected.begin(), expected.end(), keys));
  }
}

TEST_CASE("the bitonic network sorts every input of zeros and ones", "[grouping]") {
  // By the zero-one principle (Knuth, TAOCP 3, 5.3.4) that proves the network of 16 keys.
  for (std::uint32_t bits = 0; bits < 65536; ++bits) {
    std::uint32_t keys[16];
    for (std::uint32_t i = 0; i < 16; ++i) keys[i] = bits >> i & 1U;
    test::ds::detail::bitonic_sort(keys);
    if (!std::is_sorted(std::begin(keys), std::end(keys))) {
      CAPTURE(bits);
      FAIL("not sorted");
    }
  }
  SUCCEED();
}

TEMPLATE_LIST_TEST_CASE("tiles cover a batch once", "[grouping]", test::host_backends) {
  for (std::uint32_t const n : test::edge_sizes<TestType>()) {
    CAPTURE(n);
    std::vector<std::uint32_t> visits(n, 0);
    test::ds::detail::for_each_tile<256>(
        TestType::policy(), n, [&](test::ds::request_index first, test::ds::request_index size) {
          for (std::uint32_t i = first; i < first + size; ++i) ++visits[i];
        });
    CHECK(visits == std::vector<std::uint32_t>(n, 1));
  }
}
