// SPDX-License-Identifier: Apache-2.0
// Covers detail/cuda/workspace_bytes.hpp.
#include <deferred_shade/schedule.hpp>

#include <cstdint>

#include "catch.hpp"
#include "support/backends.hpp"
#include "support/ledger.hpp"
#include "support/random_ids.hpp"
#include "support/schedule_properties.hpp"

namespace ds = deferred_shade;
using test::ledger;
using test::ledger_allocator;

TEMPLATE_LIST_TEST_CASE("a schedule takes what it says, and not more", "[workspace]",
                        test::backends) {
  auto const exec = TestType::policy();
  for (std::uint32_t const n : {1U, 63U, 16384U, 16385U, 200003U}) {
    std::uint32_t const seed = test::run_seed();
    auto const ids =
        test::on<TestType>(test::make_ids<std::uint16_t>(test::layout::random, n, 40, seed));
    ds::for_each_schedule([&](char const* name, auto const& schedule) {
      CAPTURE(name, n, seed);
      ledger book;
      ds::workspace scratch{ledger_allocator<std::byte, TestType>(book)};
      std::size_t const bytes = schedule.workspace_bytes(exec, n, 40);
      scratch.reserve_bytes(bytes);
      test::check_against_loop<TestType, 40, 0, 17, 39>(schedule, n, ids.data(), scratch);
      CHECK(book.allocations == (bytes > 0 ? 1 : 0));
      CHECK(bytes <= scratch.bytes_for(n, 40));
    });
  }
}
