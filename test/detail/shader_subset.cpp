// SPDX-License-Identifier: Apache-2.0
// Tables from which `only` has taken shaders, without their gaps; ids to match.
#include <deferred_shade/detail/shader_subset.hpp>
#include <deferred_shade/specialized.hpp>

#include <thrust/iterator/counting_iterator.h>
#include <thrust/iterator/transform_iterator.h>

#include <bitset>
#include <cstdint>
#include <deferred_shade/deferred_shade.hpp>
#include <limits>
#include <random>
#include <type_traits>
#include <vector>

#include "support/every_schedule.hpp"
#include "support/schedule_properties.hpp"

namespace ds = deferred_shade;

namespace {

constexpr std::uint32_t shaders = 32;
bool is_kept(std::uint32_t id) { return test::is_kept<0, 3, 4, 17, 31>(id); }
enum class kind : std::uint16_t {};

/// Ids of all values around those that the table has, and the ends of their type.
template <class T>
std::vector<T> ids_of_type(std::uint32_t n) {
  using number = typename std::conditional_t<std::is_enum_v<T>, std::underlying_type<T>,
                                             std::common_type<T>>::type;
  std::mt19937 engine(test::run_seed() + n);
  std::vector<T> ids(n);
  for (auto& id : ids) {
    auto const draw = engine() % 40;
    number const value = draw == 38   ? std::numeric_limits<number>::max()
                         : draw == 39 ? std::numeric_limits<number>::lowest()
                                      : static_cast<number>(draw);
    id = static_cast<T>(value);
  }
  return ids;
}

struct plus_one {
  template <class T>
  DEFERRED_SHADE_HOST_DEVICE std::uint32_t operator()(T id) const {
    return static_cast<std::uint32_t>(id) + 1;
  }
};

struct hit {
  std::uint32_t shader;
  float distance[2];
};
struct shader_of_hit {
  DEFERRED_SHADE_HOST_DEVICE std::uint32_t operator()(hit const& h) const { return h.shader; }
};

/// Runs the kept part of a table over `ids`, of which `value_of(i)` are the values on the host, by
/// these schedules.
template <class Backend, class Ids, class Values, class... Schedules>
void check_part(std::uint32_t n, Ids ids, Values const& value_of, Schedules const&... schedules) {
  std::vector<std::uint32_t> left(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    std::uint32_t const id = value_of(i);
    left[i] = is_kept(id) ? id : shaders;
  }
  auto const expected = test::traced_by_loop<shaders>(n, left.data(), n);
  auto const check = [&](auto const& schedule) {
    ds::workspace scratch{Backend::policy()};
    test::trace<Backend> actual(n);
    auto const table = test::tracing_table<shaders>(actual.value.data(), actual.runs.data());
    ds::shade(Backend::policy(), schedule, n, ids, table.template only<0, 3, 4, 17, 31>(), scratch);
    Backend::wait();
    test::check_same(actual, expected);
  };
  if constexpr (sizeof...(Schedules) == 0) {
    test::for_each_schedule(check);
  } else {
    (check(schedules), ...);
  }
}

}  // namespace

TEST_CASE("the place of an id among those that are there", "[gaps]") {
  constexpr std::uint32_t bits = 1U | 1U << 3 | 1U << 4 | 1U << 17 | 1U << 31;
  ds::detail::place_among<bits> const place;
  std::uint32_t next = 0;
  for (std::uint32_t id = 0; id < 70; ++id) {
    CAPTURE(id);
    CHECK(place(id) == (is_kept(id) ? next++ : 32));
  }
  CHECK(next == 5);
  CHECK(place(static_cast<std::int8_t>(-1)) == 32);
  CHECK(place(std::numeric_limits<std::int32_t>::min()) == 32);
  CHECK(place(static_cast<kind>(17)) == 3);
  CHECK(ds::detail::place_among<0xffffffffU>{}(31) == 31);
}

TEST_CASE("a table without gaps has the shaders that were there, in order", "[gaps]") {
  auto const table = test::tracing_table<shaders>(nullptr, nullptr);
  auto const part =
      table.only<0, 3, 4, 17, 31>().expecting(std::bitset<shaders>().set(3).set(5).set(31));
  auto const dense = ds::detail::without_gaps(part, std::make_index_sequence<5>());
  CHECK(dense.size() == 5);
  std::vector<std::uint32_t> ids;
  dense.for_each([&](auto, auto const& shader) { ids.push_back(shader.id); });
  CHECK(ids == std::vector<std::uint32_t>{0, 3, 4, 17, 31});
  CHECK(dense.expected() == std::bitset<5>(0b10010));
}

// Every schedule with ids of one type, and one after the other with those of others: an id is
// turned into a place by an iterator of which no schedule knows.
TEMPLATE_LIST_TEST_CASE("a part of a table takes ids of any type", "[gaps]", test::backends) {
  CAPTURE(test::run_seed());
  auto const check = [](auto type, auto const&... schedules) {
    using id = decltype(type);
    for (std::uint32_t const n : {1U, 33U, 8193U}) {
      CAPTURE(sizeof(id), n);
      auto const host = ids_of_type<id>(n);
      auto const ids = test::on<TestType>(host);
      check_part<TestType>(
          n, ids.data(), [&](std::uint32_t i) { return static_cast<std::uint32_t>(host[i]); },
          schedules...);
    }
  };
  check(std::uint8_t{});
  check(std::int8_t{}, ds::implicit_serialization{}, ds::sort_then_dispatch<>{});
  check(std::uint16_t{}, ds::explicit_serialization{}, ds::local_sort_then_dispatch<>{});
  check(std::int32_t{}, ds::bucket_then_dispatch<>{}, ds::window_sort_then_dispatch{});
  check(kind{}, ds::compact_then_dispatch<>{}, ds::local_sort_then_dispatch<ds::bitonic>{});
}

TEMPLATE_LIST_TEST_CASE("a part of a table takes ids from any iterator", "[gaps]", test::backends) {
  CAPTURE(test::run_seed());
  std::uint32_t const n = 8193;
  auto const host = ids_of_type<std::uint8_t>(n);
  auto const ids = test::on<TestType>(host);
  auto const one_more = [&](std::uint32_t i) { return std::uint32_t{host[i]} + 1; };
  using of_pointer =
      thrust::transform_iterator<plus_one, decltype(ids.data()), std::uint32_t, std::uint32_t>;
  auto const bucket = ds::bucket_then_dispatch<>{};
  auto const window = ds::window_sort_then_dispatch{};
  check_part<TestType>(n, of_pointer(ids.data(), {}), one_more, bucket, window);
  check_part<TestType>(
      n - 3, of_pointer(ids.data() + 3, {}), [&](std::uint32_t i) { return one_more(i + 3); },
      bucket, window);
  check_part<TestType>(
      70, thrust::counting_iterator<std::uint32_t>(0), [](std::uint32_t i) { return i; },
      ds::sort_then_dispatch<>{}, ds::local_sort_then_dispatch<>{});
}

TEMPLATE_LIST_TEST_CASE("ids may lie in records, for a table and for a part of it", "[gaps]",
                        test::backends) {
  CAPTURE(test::run_seed());
  std::uint32_t const n = 8193;
  std::vector<hit> host(n);
  auto const drawn = ids_of_type<std::uint8_t>(n);
  for (std::uint32_t i = 0; i < n; ++i) host[i] = {drawn[i], {}};
  auto const hits = test::on<TestType>(host);
  using iterator = thrust::transform_iterator<shader_of_hit, decltype(hits.data()), std::uint32_t,
                                              std::uint32_t>;
  iterator const ids(hits.data(), {});
  check_part<TestType>(
      n, ids, [&](std::uint32_t i) { return host[i].shader; }, ds::implicit_serialization{},
      ds::compact_then_dispatch<>{}, ds::window_sort_then_dispatch{});
  ds::workspace scratch{TestType::policy()};
  auto const expected = test::traced_by_loop<shaders>(n, drawn.data(), n);
  auto const check = [&](auto const& schedule) {
    test::trace<TestType> actual(n);
    auto const table = test::tracing_table<shaders>(actual.value.data(), actual.runs.data());
    ds::shade(TestType::policy(), schedule, n, ids, table, scratch);
    TestType::wait();
    test::check_same(actual, expected);
  };
  check(ds::bucket_then_dispatch<>{});
  check(ds::local_sort_then_dispatch<>{});
}

TEMPLATE_LIST_TEST_CASE("a part of a table may be specialized further", "[gaps]", test::backends) {
  CAPTURE(test::run_seed());
  std::uint32_t const n = 5000;
  auto const host = ids_of_type<std::uint8_t>(n);
  auto const ids = test::on<TestType>(host);
  std::vector<std::uint32_t> left(n);
  for (std::uint32_t i = 0; i < n; ++i) left[i] = host[i] == 3 || host[i] == 17 ? host[i] : shaders;
  auto const expected = test::traced_by_loop<shaders>(n, left.data(), n);
  using sets = ds::variants<ds::ids<3, 17>, ds::ids<0, 3, 4, 17>>;
  auto const occurring = std::bitset<shaders>().set(3).set(17);
  ds::specialized const inner{ds::window_sort_then_dispatch{}, sets{}, occurring};
  auto const check = [&](auto const& schedule) {
    ds::workspace scratch{TestType::policy()};
    test::trace<TestType> actual(n);
    auto const table = test::tracing_table<shaders>(actual.value.data(), actual.runs.data());
    ds::shade(TestType::policy(), schedule, n, ids.data(), table.template only<0, 3, 4, 17, 31>(),
              scratch);
    TestType::wait();
    test::check_same(actual, expected);
  };
  check(inner);
  check(ds::specialized{inner, sets{}, occurring});
}
