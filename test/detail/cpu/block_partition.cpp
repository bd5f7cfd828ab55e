// SPDX-License-Identifier: Apache-2.0
#include <deferred_shade/detail/cpu/block_partition.hpp>

#include <cstdint>
#include <vector>

#include "catch.hpp"
#include "support/backends.hpp"
#include "support/random_ids.hpp"

using deferred_shade::detail::block_partition;

TEST_CASE("blocks cover a batch once, in order", "[blocks]") {
  for (std::size_t const n : {0UL, 1UL, 16383UL, 16384UL, 16385UL, 40000000UL, 4294967295UL}) {
    for (std::size_t const shaders : {1UL, 11UL, 256UL, 100000UL}) {
      CAPTURE(n, shaders);
      block_partition const blocks(n, shaders);
      std::size_t covered = 0;
      for (std::size_t b = 0; b < blocks.count(); ++b) {
        REQUIRE(blocks.begin(b) == covered);
        REQUIRE(blocks.end(b) > blocks.begin(b));
        REQUIRE(blocks.end(b) - blocks.begin(b) <= blocks.size());
        covered = blocks.end(b);
      }
      CHECK(covered == n);
      CHECK(blocks.count() <= 1024);
      CHECK(blocks.size() % 64 == 0);
      CHECK(blocks.size() >= 16 * (shaders + 1));
    }
  }
}

TEMPLATE_LIST_TEST_CASE("every block is visited once", "[blocks]", test::host_backends) {
  block_partition const blocks(1000000, 3);
  std::vector<int> visits(blocks.count(), 0);
  deferred_shade::detail::for_each_block(TestType::policy(), blocks,
                                         [&](std::size_t b) { ++visits[b]; });
  CHECK(visits == std::vector<int>(blocks.count(), 1));
}

TEST_CASE("scan_columns orders by column, then by block", "[blocks]") {
  std::mt19937 engine(test::run_seed());
  CAPTURE(test::run_seed());
  block_partition const blocks(5 * 16384, 3);
  REQUIRE(blocks.count() == 5);
  std::uint32_t const columns = 4;
  std::vector<std::uint32_t> counts(blocks.count() * columns);
  for (auto& count : counts) count = static_cast<std::uint32_t>(engine() % 100);

  std::vector<std::uint32_t> expected(counts.size());
  std::vector<std::uint32_t> expected_offsets;
  std::uint32_t sum = 0;
  for (std::uint32_t k = 0; k < columns; ++k) {
    expected_offsets.push_back(sum);
    for (std::size_t b = 0; b < blocks.count(); ++b) {
      expected[b * columns + k] = sum;
      sum += counts[b * columns + k];
    }
  }

  std::vector<std::uint32_t> offsets(columns);
  deferred_shade::detail::scan_columns(blocks, columns, counts.data(), offsets.data());
  CHECK(counts == expected);
  CHECK(offsets == expected_offsets);
}

TEST_CASE("bounds of blocks and counters do not fall when batches or tables grow", "[blocks]") {
  // Also at the sizes at which the number of blocks falls: one more request, larger blocks.
  std::mt19937_64 engine(test::run_seed());
  CAPTURE(test::run_seed());
  for (int trial = 0; trial < 20000; ++trial) {
    std::size_t const n = engine() % (std::size_t{1} << (1 + engine() % 32));
    std::size_t const shaders = 1 + engine() % (std::size_t{1} << (1 + engine() % 20));
    std::size_t const fewer = engine() % (n + 1);
    std::size_t const smaller = 1 + engine() % shaders;
    block_partition const blocks(n, shaders);
    REQUIRE(blocks.count() <= blocks.max_count(n, shaders));
    REQUIRE(blocks.max_count(fewer, shaders) <= blocks.max_count(n, shaders));
    REQUIRE(blocks.max_count(n, shaders) * (shaders + 1) <= blocks.max_counters(n, shaders));
    REQUIRE(blocks.max_counters(fewer, smaller) <= blocks.max_counters(n, shaders));
  }
}
