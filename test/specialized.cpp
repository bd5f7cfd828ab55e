// SPDX-License-Identifier: Apache-2.0
#include <deferred_shade/specialized.hpp>

#include <thrust/system/cpp/execution_policy.h>

#include <bitset>
#include <cstdint>
#include <deferred_shade/deferred_shade.hpp>
#include <initializer_list>
#include <random>
#include <vector>

#include "support/every_schedule.hpp"
#include "support/schedule_properties.hpp"

namespace ds = deferred_shade;

namespace {

constexpr std::uint32_t shaders = 6;
constexpr std::uint32_t several_tiles = 16385;
using some = ds::variants<ds::ids<0, 1>, ds::ids<1, 4, 3>, ds::ids<4, 3, 1, 0>, ds::ids<4, 1, 3>>;

std::bitset<shaders> set_of(std::initializer_list<std::uint32_t> ids) {
  std::bitset<shaders> set;
  for (std::uint32_t const id : ids) set.set(id);
  return set;
}

/// Calls `f` with one schedule of every kind: a switch, launches per shader, and both over groups,
/// tiles and windows.
template <class Function>
void for_each_kind(Function const& f) {
  f(ds::implicit_serialization{});
  f(ds::explicit_serialization{});
  f(ds::bucket_then_dispatch<>{});
  f(ds::bucket_then_dispatch<ds::implicit_serialization>{});
  f(ds::local_sort_then_dispatch<>{});
  f(ds::window_sort_then_dispatch{});
}

/// Random ids of a table, and some that it does not have.
std::vector<std::uint8_t> batch_of(std::uint32_t n) {
  return test::make_ids<std::uint8_t>(test::layout::random, n, shaders, test::run_seed() + n);
}

/// The same without those that `kept` lacks: they name no shader.
std::vector<std::uint8_t> without(std::vector<std::uint8_t> ids, std::bitset<shaders> kept) {
  for (auto& id : ids) {
    if (id >= shaders || !kept[id]) id = 0xff;
  }
  return ids;
}

struct request {
  std::uint32_t words[4];
};
struct result {
  std::uint32_t word;
};

struct mixing {
  std::uint32_t id;
  DEFERRED_SHADE_HOST_DEVICE result operator()(request const& r) const {
    std::uint32_t state = 2654435761U * (id + 1);
    for (std::uint32_t const word : r.words) state = (state ^ word) * 16777619U;
    return {state};
  }
};

}  // namespace

TEST_CASE("the smallest variant that covers a scene is chosen", "[specialized]") {
  CHECK(some::covering(set_of({})) == 0);
  CHECK(some::covering(set_of({0})) == 0);
  CHECK(some::covering(set_of({0, 1})) == 0);
  CHECK(some::covering(set_of({1, 4})) == 1);
  CHECK(some::covering(set_of({4, 3})) == 1);
  CHECK(some::covering(set_of({0, 4})) == 2);
  CHECK(some::covering(set_of({2})) == some::count);
  CHECK(some::covering(set_of({0, 1, 5})) == some::count);
  CHECK(some::covering(set_of({0, 1, 2, 3, 4, 5})) == some::count);
}

TEST_CASE("a variant that lists a shader twice has it once", "[specialized]") {
  using repeated = ds::variants<ds::ids<0, 1, 2>, ds::ids<0, 0, 1, 1>>;
  CHECK(repeated::covering(set_of({0, 1})) == 1);
  CHECK(repeated::covering(set_of({0, 1, 2})) == 0);
}

TEMPLATE_LIST_TEST_CASE("every schedule runs a part of a table, and leaves the rest alone",
                        "[specialized]", test::backends) {
  for_each_kind([](auto const& schedule) {
    ds::workspace scratch{TestType::policy()};
    for (std::uint32_t const n : test::some_sizes()) {
      CAPTURE(n, test::run_seed());
      auto const all = batch_of(n);
      auto const ids = test::on<TestType>(all);
      test::trace<TestType> actual(n);
      auto const table = test::tracing_table<shaders>(actual.value.data(), actual.runs.data());
      ds::shade(TestType::policy(), schedule, n, ids.data(), table.template only<4, 1>(), scratch);
      TestType::wait();
      auto const kept = without(all, set_of({1, 4}));
      test::check_same(actual, test::traced_by_loop<shaders>(n, kept.data(), n));
    }
  });
}

// Every kind has run a part of a table above; here each variant of a table is one.
TEMPLATE_LIST_TEST_CASE("a specialized schedule runs every request of a scene", "[specialized]",
                        test::backends) {
  auto const check = [](auto const& schedule) {
    ds::workspace scratch{TestType::policy()};
    for (auto const& occurring :
         {set_of({}), set_of({1}), set_of({0, 1}), set_of({1, 3, 4}), set_of({0, 3}), set_of({2}),
          set_of({5, 0}), set_of({0, 1, 2, 3, 4, 5})}) {
      CAPTURE(occurring, test::run_seed());
      auto const batch = without(batch_of(several_tiles), occurring);
      auto const ids = test::on<TestType>(batch);
      ds::specialized const special{schedule, some{}, occurring};
      CHECK(special.variant() == some::covering(occurring));
      test::check_against_loop<TestType, shaders>(special, several_tiles, ids.data(), scratch);
    }
  };
  check(ds::implicit_serialization{});
  check(ds::bucket_then_dispatch<>{});
}

TEMPLATE_LIST_TEST_CASE("a part of a table may be of records", "[specialized]", test::backends) {
  CAPTURE(test::run_seed());
  std::mt19937 engine(test::run_seed());
  std::vector<request> requests(several_tiles);
  for (request& r : requests) {
    for (auto& word : r.words) word = static_cast<std::uint32_t>(engine());
  }
  auto const batch = without(batch_of(several_tiles), set_of({2, 3}));
  std::vector<result> expected(several_tiles);
  for (std::uint32_t i = 0; i < several_tiles; ++i) {
    if (batch[i] < shaders) expected[i] = mixing{batch[i]}(requests[i]);
  }
  auto const in = test::on<TestType>(requests);
  auto const ids = test::on<TestType>(batch);
  for_each_kind([&](auto const& schedule) {
    auto results = test::on<TestType>(std::vector<result>(several_tiles));
    ds::workspace scratch{TestType::policy()};
    auto const table = ds::record_shaders(in.data(), results.data(), mixing{0}, mixing{1},
                                          mixing{2}, mixing{3}, mixing{4}, mixing{5});
    ds::shade(TestType::policy(), schedule, several_tiles, ids.data(), table.template only<2, 3>(),
              scratch);
    TestType::wait();
    CHECK(test::first_difference(results, expected) == several_tiles);
  });
}

TEMPLATE_LIST_TEST_CASE("shaders that are not expected are not run, others as ever",
                        "[specialized]", test::backends) {
  CAPTURE(test::run_seed());
  test::for_each_schedule([](auto const& schedule) {
    for (auto const& occurring : {set_of({}), set_of({3}), set_of({0, 5}), set_of({1, 2, 3, 4})}) {
      CAPTURE(occurring);
      auto const batch = without(batch_of(several_tiles), occurring);
      auto const ids = test::on<TestType>(batch);
      ds::workspace scratch{TestType::policy()};
      auto const expecting = [&](auto const& exec, auto n, auto first, auto const& table,
                                 auto& memory) {
        schedule(exec, n, first, table.expecting(occurring), memory);
      };
      test::check_against_loop<TestType, shaders>(expecting, several_tiles, ids.data(), scratch);
    }
  });
}

TEST_CASE("explicit serialization launches what is expected, and nothing else", "[specialized]") {
  // Requests that name an unexpected shader show whether it was launched.
  std::vector<std::uint8_t> const ids = {0, 1, 2, 1, 0};
  std::vector<int> ran(ids.size());
  auto const mark = [&ran](ds::request_index i) { ++ran[i]; };
  ds::shader_table const table{mark, mark, mark};
  auto const fewer = table.expecting(std::bitset<3>().set(1));
  ds::workspace scratch{thrust::cpp::par};
  ds::shade(thrust::cpp::par, ds::explicit_serialization{}, ids.size(), ids.data(), fewer, scratch);
  CHECK(ran == std::vector<int>{0, 1, 0, 1, 0});
  ds::shade(thrust::cpp::par, ds::bucket_then_dispatch<>{}, ids.size(), ids.data(), fewer, scratch);
  CHECK(ran == std::vector<int>{0, 2, 0, 2, 0});
  ds::shade(thrust::cpp::par, ds::compact_then_dispatch<ds::implicit_serialization>{}, ids.size(),
            ids.data(), fewer, scratch);
  CHECK(ran == std::vector<int>{0, 3, 0, 3, 0});
}

TEMPLATE_LIST_TEST_CASE("the shaders of a batch choose the variant", "[specialized]",
                        test::backends) {
  CAPTURE(test::run_seed());
  for (auto const& kept : {set_of({}), set_of({1, 3, 4}), set_of({0, 2})}) {
    auto const batch = without(batch_of(several_tiles), kept);
    auto const ids = test::on<TestType>(batch);
    auto const exec = TestType::policy();
    auto const counts = ds::count_occurrences(exec, several_tiles, ids.data(), shaders);
    ds::specialized const special{ds::bucket_then_dispatch<>{}, some{},
                                  counts.template occurring<shaders>()};
    CHECK(special.occurring == kept);
    CHECK(special.variant() == some::covering(kept));
    ds::workspace scratch{exec};
    test::check_against_loop<TestType, shaders>(special, several_tiles, ids.data(), scratch);
  }
}
