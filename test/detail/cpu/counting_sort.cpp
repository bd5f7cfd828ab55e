// SPDX-License-Identifier: Apache-2.0
// The steps that groupings on a CPU share, next to a plain loop: tables on both sides of each size
// at which they work in another way, sizes on both sides of their steps.
#include <deferred_shade/detail/cpu/counting_sort.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "catch.hpp"
#include "support/compare.hpp"
#include "support/random_ids.hpp"

namespace ds = deferred_shade;

namespace {

constexpr std::size_t capacity = 8192;
constexpr std::uint32_t sizes[] = {0,  1,  7,  8,    9,    15,   16,   17,   31,   32,
                                   33, 63, 64, 1000, 4095, 4096, 4097, 8159, 8191, 8192};

template <std::uint32_t Shaders, ds::request_index Parts>
using counts_of =
    ds::detail::key_counts<Shaders, Parts, ds::detail::compared_bytes<Shaders, ds::cpu_tuning>>;

template <std::uint32_t Shaders, ds::cache_level Ahead, class Number>
void check_places(std::vector<ds::detail::sort_key<Shaders>> const& keys, Number first) {
  std::vector<std::vector<Number>> of_key(Shaders + 1);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    of_key[keys[i]].push_back(static_cast<Number>(first + i));
  }
  std::vector<Number> expected;
  std::vector<std::uint32_t> next;
  std::vector<std::uint32_t> ends;
  for (auto const& numbers : of_key) {
    next.push_back(static_cast<std::uint32_t>(expected.size()));
    expected.insert(expected.end(), numbers.begin(), numbers.end());
    ends.push_back(static_cast<std::uint32_t>(expected.size()));
  }
  auto const size = static_cast<std::uint32_t>(keys.size());
  auto const check = [&](auto const& place) {
    std::vector<Number> places(size);
    std::vector<std::uint32_t> here = next;
    place(here.data(), places.data());
    CHECK(test::first_difference(places, expected) == places.size());
    CHECK(here == ends);
  };
  check([&](std::uint32_t* here, Number* places) {
    ds::detail::place_by_keys<Ahead>(keys.data(), size, first, here, places);
  });
  check([&](std::uint32_t* here, Number* places) {
    counts_of<Shaders, ds::cpu_tuning::counted_parts(Shaders)> counts;
    counts.add(keys.data(), size);
    counts.place(keys.data(), size, first, here, places);
  });
}

template <std::uint32_t Shaders>
void check_table() {
  for (std::uint32_t const size : sizes) {
    for (test::layout const how : test::layouts) {
      std::uint32_t const seed = test::run_seed() + size + static_cast<std::uint32_t>(how);
      CAPTURE(Shaders, size, static_cast<int>(how), seed);
      auto const ids = test::make_ids<std::uint32_t>(how, size + 3, Shaders, seed);
      ds::detail::sort_key<Shaders> loaded[capacity];
      ds::detail::load_keys<Shaders>(ids.data(), 3, size, loaded);
      std::vector<ds::detail::sort_key<Shaders>> const keys(loaded, loaded + size);
      counts_of<Shaders, ds::cpu_tuning::counted_parts(Shaders)> counts;
      counts.add(keys.data(), size);
      counts.add(keys.data(), size / 2);
      counts_of<Shaders, 1> at_once;
      at_once.add(keys.data(), size);
      bool right = true;
      for (std::uint32_t i = 0; i < size; ++i) right &= keys[i] == std::min(ids[i + 3], Shaders);
      for (std::uint32_t k = 0; k <= Shaders; ++k) {
        auto const half = keys.begin() + size / 2;
        right &= counts.of(k) ==
                 std::count(keys.begin(), keys.end(), k) + std::count(keys.begin(), half, k);
        right &= at_once.of(k) == std::count(keys.begin(), keys.end(), k);
      }
      REQUIRE(right);
      check_places<Shaders, ds::cache_level::none>(keys, std::uint16_t{0});
      check_places<Shaders, ds::cache_level::first_level>(keys, std::uint32_t{4000000000});
      check_places<Shaders, ds::cache_level::second_level>(keys, std::uint32_t{0});
    }
  }
}

}  // namespace

TEST_CASE("keys are loaded, counted and put to their places", "[grouping]") {
  check_table<1>();
  check_table<3>();
  check_table<4>();
  check_table<5>();
  check_table<16>();
  check_table<17>();
  check_table<32>();
  check_table<33>();
  check_table<255>();
  check_table<256>();
  check_table<511>();
  check_table<512>();
}

TEST_CASE("a sort key is as narrow as the table allows", "[grouping]") {
  // One more value than the table has shaders: for requests that name none.
  STATIC_REQUIRE(sizeof(ds::detail::sort_key<1>) == 1);
  STATIC_REQUIRE(sizeof(ds::detail::sort_key<255>) == 1);
  STATIC_REQUIRE(sizeof(ds::detail::sort_key<256>) == 2);
  STATIC_REQUIRE(sizeof(ds::detail::sort_key<65535>) == 2);
  STATIC_REQUIRE(sizeof(ds::detail::sort_key<65536>) == 4);
}
