// SPDX-License-Identifier: Apache-2.0
// Covers detail/workspace_memory.hpp.
#include <deferred_shade/workspace.hpp>

#include <algorithm>
#include <cstdint>
#include <memory_resource>
#include <new>
#include <random>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "catch.hpp"
#include "support/backends.hpp"
#include "support/every_schedule.hpp"
#include "support/fewest_allocations.hpp"
#include "support/ledger.hpp"
#include "support/random_ids.hpp"

namespace ds = deferred_shade;

namespace {

using test::ledger;
using test::ledger_allocator;

struct nothing {
  DEFERRED_SHADE_HOST_DEVICE void operator()(ds::request_index) const {}
};

template <std::uint32_t... Ids>
auto table_of_nothing(std::integer_sequence<std::uint32_t, Ids...>) {
  return ds::shader_table{(static_cast<void>(Ids), nothing{})...};
}

template <std::uint32_t Shaders, class Policy, class Ids, class Allocator>
void shade_all(Policy const& exec, Ids const& ids, ds::workspace<Allocator>& scratch) {
  auto const shaders = table_of_nothing(std::make_integer_sequence<std::uint32_t, Shaders>());
  test::for_each_schedule(
      [&](auto schedule) { ds::shade(exec, schedule, ids.size(), ids.data(), shaders, scratch); });
}

}  // namespace

TEST_CASE("arrays of a workspace are aligned and apart", "[workspace]") {
  ds::workspace<> scratch;
  for (std::size_t n : {0UL, 1UL, 127UL, 128UL, 129UL, 5000UL}) {
    CAPTURE(n);
    auto const [bytes, words, doubles] = scratch.take(
        ds::elements<std::uint8_t>(n), ds::elements<std::uint32_t>(n + 1), ds::elements<double>(n));
    CHECK(reinterpret_cast<std::uintptr_t>(bytes) % 128 == 0);
    CHECK(reinterpret_cast<std::uintptr_t>(words) % 128 == 0);
    CHECK(reinterpret_cast<std::uintptr_t>(doubles) % 128 == 0);
    for (std::size_t i = 0; i < n; ++i) {
      bytes[i] = 1;
      doubles[i] = 3;
    }
    for (std::size_t i = 0; i <= n; ++i) words[i] = 2;
    for (std::size_t i = 0; i < n; ++i) {
      REQUIRE(bytes[i] == 1);
      REQUIRE(doubles[i] == 3);
    }
  }
}

TEST_CASE("a workspace grows, never shrinks, and gives everything back", "[workspace]") {
  ledger book;
  {
    ds::workspace scratch{ledger_allocator<std::byte>(book)};
    CHECK(scratch.capacity() == 0);
    CHECK(book.allocations == 0);
    scratch.take(ds::elements<int>(1000));
    std::size_t const grown = scratch.capacity();
    CHECK(grown >= 4000);
    CHECK(book.live_bytes == grown);
    scratch.take(ds::elements<int>(10));
    CHECK(scratch.capacity() == grown);
    CHECK(book.allocations == 1);

    ds::workspace moved{std::move(scratch)};
    CHECK(moved.capacity() == grown);
    ds::workspace<ledger_allocator<std::byte>> target{ledger_allocator<std::byte>(book)};
    target = std::move(moved);
    CHECK(target.capacity() == grown);
    CHECK(book.live_bytes == grown);
    target.release();
    CHECK(target.capacity() == 0);
    CHECK(book.live_bytes == 0);
    target.take(ds::elements<int>(10));
    CHECK(book.live_bytes > 0);
  }
  CHECK(book.live_bytes == 0);
}

TEST_CASE("an allocator that cannot be assigned serves as well", "[workspace]") {
  STATIC_REQUIRE(!std::is_copy_constructible_v<ds::workspace<>>);
  STATIC_REQUIRE(!std::is_constructible_v<ds::workspace<>, std::string>);
  std::pmr::monotonic_buffer_resource pool;
  ds::workspace a{std::pmr::polymorphic_allocator<std::byte>(&pool)};
  a.take(ds::elements<int>(1000));
  std::size_t const grown = a.capacity();
  ds::workspace<std::pmr::polymorphic_allocator<std::byte>> b;
  b = std::move(a);
  CHECK(b.capacity() == grown);
}

TEST_CASE("a workspace refuses sizes that no memory has", "[workspace]") {
  ds::workspace<> scratch;
  std::size_t const most = static_cast<std::size_t>(-1);
  CHECK_THROWS_AS(ds::elements<double>(std::size_t{1} << 61), std::length_error);
  CHECK_THROWS_AS(ds::elements<std::uint8_t>(most), std::length_error);
  CHECK_THROWS_AS(scratch.reserve(most, 1), std::length_error);
  CHECK_THROWS_AS(scratch.reserve(1, most), std::length_error);
  CHECK(scratch.capacity() == 0);
}

TEST_CASE("what a batch takes does not fall when batches or tables grow", "[workspace]") {
  std::mt19937_64 engine(test::run_seed());
  CAPTURE(test::run_seed());
  using on_host = ds::workspace<>;
  using anywhere = ds::workspace<ledger_allocator<std::byte>>;
  for (int trial = 0; trial < 20000; ++trial) {
    std::size_t const n = engine() % (std::size_t{1} << (1 + engine() % 32));
    std::size_t const shaders = 1 + engine() % (std::size_t{1} << (1 + engine() % 20));
    std::size_t const fewer = engine() % (n + 1);
    std::size_t const smaller = 1 + engine() % shaders;
    REQUIRE(on_host::bytes_for(fewer, smaller) <= on_host::bytes_for(n, shaders));
    REQUIRE(anywhere::bytes_for(fewer, smaller) <= anywhere::bytes_for(n, shaders));
    REQUIRE(anywhere::bytes_for(n, shaders) >= on_host::bytes_for(n, shaders));
  }
}

TEST_CASE("a warm workspace serves a batch of fewer requests in more blocks", "[workspace]") {
  ledger book;
  ds::workspace scratch{ledger_allocator<std::byte>(book)};
  ds::request_index const n = 1024 * 16384;
  std::vector<std::uint16_t> const ids(n + 1, 3);
  ds::group_by_bucket<255>(thrust::cpp::par, n + 1, ids.data(), scratch);
  ds::group_by_bucket<255>(thrust::cpp::par, n, ids.data(), scratch);
  CHECK(book.allocations == 1);
}

TEST_CASE("a device_count is worth its maximum in memory", "[workspace]") {
  ledger book;
  ds::workspace scratch{ledger_allocator<std::byte>(book)};
  std::uint32_t count = 10;
  std::vector<std::uint8_t> const ids(100000, 0);
  for (std::uint32_t const next : {10U, 1000U, 100000U}) {
    count = next;
    ds::shade(thrust::cpp::par, ds::sort_then_dispatch<>{}, ds::device_count{&count, ids.size()},
              ids.data(), ds::shader_table{nothing{}}, scratch);
  }
  CHECK(book.allocations == 1);
}

TEST_CASE("a workspace stays usable when its allocator fails", "[workspace]") {
  ledger book;
  ds::workspace scratch{ledger_allocator<std::byte>(book)};
  std::vector<std::uint16_t> const ids(500000, 1);
  scratch.reserve(10, 2);  // and it fails when it grows
  book.limit = 10000;
  int calls = 0;
  auto const count = [&calls](ds::request_index) { ++calls; };
  auto const shade = [&] {
    ds::shade(thrust::cpp::par, ds::sort_then_dispatch<>{}, ids.size(), ids.data(),
              ds::shader_table{count, count}, scratch);
  };
  CHECK_THROWS_AS(shade(), std::bad_alloc);
  CHECK(calls == 0);
  CHECK(scratch.capacity() == 0);
  CHECK(book.live_bytes == 0);
  book.limit = static_cast<std::size_t>(-1);
  shade();
  CHECK(calls == 500000);
}

TEMPLATE_LIST_TEST_CASE("reserve is enough for every schedule", "[workspace]", test::backends) {
  auto const exec = TestType::policy();
  for (std::uint32_t const n : {1U, 63U, 16384U, 16385U, 200003U}) {
    std::uint32_t const seed = test::run_seed();
    CAPTURE(n, seed);
    auto const check = [&](auto shaders, auto const& shade) {
      ledger book;
      ds::workspace scratch{ledger_allocator<std::byte, TestType>(book)};
      auto const ids =
          test::on<TestType>(test::make_ids<std::uint16_t>(test::layout::random, n, shaders, seed));
      scratch.reserve(n, shaders);
      CHECK(scratch.capacity() >= scratch.bytes_for(n, shaders));
      shade(ids, scratch);
      TestType::wait();
      CHECK(book.allocations == 1);
    };
    check(std::integral_constant<std::uint32_t, 11>{},
          [&](auto const& ids, auto& scratch) { shade_all<11>(exec, ids, scratch); });
    check(std::integral_constant<std::uint32_t, 1>{}, [&](auto const& ids, auto& scratch) {
      ds::group_by_compaction<1>(exec, n, ids.data(), scratch);
      ds::group_by_radix_sort<1>(exec, n, ids.data(), scratch);
      ds::group_by_bucket<1>(exec, n, ids.data(), scratch);
      ds::shade(exec, ds::window_sort_then_dispatch{}, n, ids.data(), ds::shader_table{nothing{}},
                scratch);
    });
  }
}

TEMPLATE_LIST_TEST_CASE("reserve is enough for keys of two bytes", "[workspace]", test::backends) {
  auto const exec = TestType::policy();
  ledger book;
  ds::workspace scratch{ledger_allocator<std::byte, TestType>(book)};
  std::uint32_t const n = 100003;
  auto const ids = test::on<TestType>(
      test::make_ids<std::uint16_t>(test::layout::random, n, 300, test::run_seed()));
  scratch.reserve(n, 300);
  ds::group_by_radix_sort<300>(exec, n, ids.data(), scratch);
  ds::group_by_bucket<300>(exec, n, ids.data(), scratch);
  ds::group_by_compaction<300>(exec, n, ids.data(), scratch);
  TestType::wait();
  CHECK(book.allocations == 1);
}

TEMPLATE_LIST_TEST_CASE("nothing allocates once the workspace is warm", "[workspace]",
                        test::host_backends) {
  if (!test::counts_allocations_of<TestType>()) {
    WARN("skipped: the allocations of this build or runtime are not counted");
    return;
  }
  auto const exec = TestType::policy();
  std::uint32_t const seed = test::run_seed();
  CAPTURE(seed);
  auto const ids = test::make_ids<std::uint16_t>(test::layout::random, 300007, 11, seed);
  ds::workspace scratch{exec};
  shade_all<11>(exec, ids, scratch);
  CHECK(test::fewest_allocations([&] { shade_all<11>(exec, ids, scratch); }) == 0);
}
