// SPDX-License-Identifier: Apache-2.0
// What somebody else may write against the public headers alone: a grouping, a schedule of it, and
// a trait. Nothing of `detail` is named here.
#include <deferred_shade/dispatch.hpp>
#include <deferred_shade/grouping.hpp>
#include <deferred_shade/schedule.hpp>
#include <deferred_shade/shade.hpp>
#include <deferred_shade/shader_traits.hpp>
#include <deferred_shade/workspace.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "catch.hpp"
#include "support/backends.hpp"
#include "support/random_ids.hpp"
#include "support/schedule_properties.hpp"

namespace stranger {

namespace ds = deferred_shade;

/// A grouping for CPUs: counts, and puts every request to its place, on one thread.
template <ds::shader_id Shaders, class Ids, class Workspace>
ds::grouping group_in_turn(ds::request_index n, Ids ids, Workspace& scratch) {
  auto const [permutation, offsets, next] =
      scratch.take(ds::elements<ds::request_index>(n), ds::elements<ds::request_index>(Shaders + 1),
                   ds::elements<ds::request_index>(Shaders + 1));
  std::fill_n(next, Shaders + 1, 0U);
  for (ds::request_index i = 0; i < n; ++i) ++next[ds::shader_of(ids, i, Shaders)];
  std::exclusive_scan(next, next + Shaders + 1, offsets, 0U);
  std::copy_n(offsets, Shaders + 1, next);
  for (ds::request_index i = 0; i < n; ++i) {
    permutation[next[ds::shader_of(ids, i, Shaders)]++] = i;
  }
  return {permutation, offsets, n};
}

/// A schedule of it, which says what it takes of a workspace.
template <class Dispatch>
struct in_turn_then_dispatch {
  template <class Policy>
  static constexpr std::size_t workspace_bytes(Policy const&, std::size_t n, std::size_t shaders) {
    return 4 * (n + 2 * (shaders + 1)) + 3 * 128;
  }
  template <class Policy, class Ids, class... Shaders, class Workspace>
  void operator()(Policy const& exec, ds::request_index n, Ids ids,
                  ds::shader_table<Shaders...> const& shaders, Workspace& scratch) const {
    Dispatch{}(exec, group_in_turn<sizeof...(Shaders)>(n, ids, scratch), shaders, scratch);
  }
};

/// A workspace of somebody else's: the members that workspace.hpp names, and no other.
template <class Memory>
class pool {
 public:
  explicit pool(Memory& memory) : memory_(&memory) {}
  template <class... T>
  auto take(ds::elements<T>... arrays) {
    return memory_->take(arrays...);
  }
  void reserve(std::size_t n, std::size_t shaders) { memory_->reserve(n, shaders); }
  int begin_phase(ds::phase const&) const { return 0; }

 private:
  Memory* memory_;
};

/// Somebody else's function, which cannot be given a member any more.
struct shiny {
  float operator()(float const& x) const { return x + 1; }
};

}  // namespace stranger

template <>
struct deferred_shade::shader_traits<stranger::shiny>
    : deferred_shade::declared_shader_traits<stranger::shiny> {
  static constexpr bool runs_in_vectors = false;
};

namespace {

template <class Backend, class Schedule>
void check_in_turn() {
  namespace ds = deferred_shade;
  for (std::uint32_t const n : {0U, 1U, 33U, 20011U}) {
    std::uint32_t const seed = test::run_seed() + n;
    CAPTURE(n, seed);
    auto const ids = test::make_ids<std::uint8_t>(test::layout::random, n, 5, seed);
    ds::workspace scratch{Backend::policy()};
    scratch.reserve_bytes(Schedule::workspace_bytes(Backend::policy(), n, 5));
    std::size_t const reserved = scratch.capacity();
    test::check_against_loop<Backend, 5>(Schedule{}, n, ids.data(), scratch);
    CHECK(scratch.capacity() == reserved);
  }
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("a stranger's grouping and schedule go where the library's do",
                        "[stranger]", test::host_backends) {
  using stranger::in_turn_then_dispatch;
  check_in_turn<TestType, in_turn_then_dispatch<deferred_shade::explicit_serialization>>();
  check_in_turn<TestType, in_turn_then_dispatch<deferred_shade::implicit_serialization>>();
}

TEST_CASE("a stranger's trait speaks for a type of somebody else", "[stranger]") {
  namespace ds = deferred_shade;
  STATIC_REQUIRE(!ds::shader_traits<stranger::shiny>::runs_in_vectors);
  std::vector<float> const in(100, 2);
  std::vector<float> out(100);
  std::vector<std::uint8_t> const ids(100, 0);
  ds::workspace scratch{thrust::cpp::par};
  ds::shade(thrust::cpp::par, ds::local_sort_then_dispatch<>{}, 100, ids.data(),
            ds::record_shaders(in.data(), out.data(), stranger::shiny{}), scratch);
  CHECK(std::count(out.begin(), out.end(), 3.0F) == 100);
}

TEMPLATE_LIST_TEST_CASE("a stranger's workspace serves every schedule, and tables with gaps",
                        "[stranger]", test::backends) {
  namespace ds = deferred_shade;
  std::uint32_t const n = 20011;
  std::uint32_t const seed = test::run_seed();
  auto const ids = test::make_ids<std::uint8_t>(test::layout::random, n, 5, seed);
  auto const there = test::on<TestType>(ids);
  ds::workspace memory{TestType::policy()};
  stranger::pool<decltype(memory)> scratch(memory);
  ds::for_each_schedule([&](char const* name, auto const& schedule) {
    CAPTURE(name, seed);
    test::trace<TestType> actual(n);
    auto const shaders = test::tracing_table<5>(actual.value.data(), actual.runs.data());
    ds::shade(TestType::policy(), schedule, n, there.data(), shaders.template only<1, 3, 4>(),
              scratch);
    TestType::wait();
    test::trace<test::cpp> expected(n);
    for (std::uint32_t i = 0; i < n; ++i) {
      if (ids[i] != 1 && ids[i] != 3 && ids[i] != 4) continue;
      expected.value[i] = test::arithmetic(ids[i], i);
      expected.runs[i] = 1;
    }
    test::check_same(actual, expected);
  });
}
