// SPDX-License-Identifier: Apache-2.0
// Loops over random state machines, beside a plain loop over items.
// Covers loop.hpp, items.hpp, detail/requirements_of_run.hpp, detail/stage_shaders.hpp,
// detail/cpu/item_source.hpp, detail/cpu/loops.hpp, detail/cpu/pool.hpp, detail/cpu/rounds.hpp and
// detail/cpu/worker_workspace.hpp.
#include <deferred_shade/run.hpp>

#include <cstring>
#include <limits>
#include <stdexcept>

#include "catch.hpp"
#include "support/backends.hpp"
#include "support/random_ids.hpp"
#include "support/state_machine.hpp"

namespace {

namespace ds = deferred_shade;

bool same_bits(std::vector<float> const& a, std::vector<float> const& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), 4 * a.size()) == 0);
}

template <class Numbers>
bool all_are(Numbers const& numbers, std::uint32_t value) {
  for (auto const& n : numbers) {
    if (n != value) return false;
  }
  return true;
}

// Every item begins once and ends once, no slot has two at a time, and the results are right.
template <class Backend, ds::shader_id Stages, class Loop>
void check(Loop const& loop, test::transitions const& t, std::size_t count, std::size_t slots,
           ds::item_index first = 0) {
  CAPTURE(Stages, count, slots, first);
  test::machine_run run(t, count, slots, first);
  ds::workspace scratch{Backend::policy()};
  ds::run_control control;
  ds::run(Backend::policy(), loop, ds::items{count, slots, first, &control},
          test::begin_machine{&run}, test::machine_stages<Stages>(run), scratch);
  CHECK(all_are(run.begun, 1));
  CHECK(all_are(run.ended, 1));
  CHECK_FALSE(run.overlaps);
  CHECK(control.begun() == count);
  CHECK(control.ended() == count);
  CHECK(same_bits(run.results, test::expected_results(t, count, first)));
}

template <class Function>
void for_each_kind_of_loop(Function const& f) {
  ds::for_each_loop([&](char const* name, auto const& loop) { f(name, loop); });
  f("no tail", ds::wavefront<>{{}, 0, 8, 0});
  f("all tail", ds::wavefront<>{{}, 0, 8, 2});
  f("minimum", ds::wavefront<>{{}, 50, 3});
  f("never", ds::wavefront<>{{}, 1000000, 1000000});
  f("half", ds::wavefront<>{{}, 7, 2, 0.1F, 0.5F});
  f("rarely", ds::wavefront<>{{}, 0, 0, 0, 0.01F});
  f("when empty", ds::wavefront<>{{}, 0, 0, 0, 0});
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("every loop runs random state machines as a plain loop does", "[run]",
                        test::host_backends) {
  auto const seed = test::run_seed();
  CAPTURE(seed);
  for_each_kind_of_loop([&](char const* name, auto const& loop) {
    CAPTURE(name);
    for (std::uint32_t const ending : {0U, 1U, 4U, 8U}) {
      CAPTURE(ending);
      check<TestType, 1>(loop, {1, ending, seed}, 300, 40);
      check<TestType, 6>(loop, {6, ending, seed + 1}, 5000, 300);
    }
  });
}

TEMPLATE_LIST_TEST_CASE("a wavefront runs by any schedule", "[run]", test::host_backends) {
  auto const seed = test::run_seed();
  CAPTURE(seed);
  test::transitions const t(6, 1, seed);
  check<TestType, 6>(ds::wavefront{ds::implicit_serialization{}}, t, 5000, 300);
  check<TestType, 6>(ds::wavefront{ds::compact_then_dispatch<>{}}, t, 5000, 300);
  check<TestType, 6>(ds::wavefront{ds::bucket_then_dispatch<>{}}, t, 5000, 300);
}

TEST_CASE("loops run 64 stages, each of a type of its own", "[run]") {
  auto const seed = test::run_seed();
  CAPTURE(seed);
  for (std::uint32_t const ending : {0U, 1U, 8U}) {
    check<test::cpp, 64>(ds::wavefront{}, {64, ending, seed}, 3000, 1000);
  }
}

TEMPLATE_LIST_TEST_CASE("loops run any number of items through any number of slots", "[run]",
                        test::host_backends) {
  auto const seed = test::run_seed();
  CAPTURE(seed);
  test::transitions const t(6, 2, seed);
  for_each_kind_of_loop([&](char const* name, auto const& loop) {
    CAPTURE(name);
    for (std::size_t const slots : {std::size_t{1}, std::size_t{2}, std::size_t{33}}) {
      for (std::size_t const count :
           {std::size_t{0}, std::size_t{1}, slots - 1, slots, slots + 1}) {
        check<TestType, 6>(loop, t, count, slots);
      }
    }
    for (std::size_t const slots : {4095U, 4096U, 4097U, 8192U, 8193U, 1U << 17}) {
      check<TestType, 6>(loop, t, 9000, slots);
    }
    check<TestType, 6>(loop, t, 1000, 64, 0xffffffff00000000U);
    check<TestType, 6>(loop, t, 1000, 64, std::numeric_limits<ds::item_index>::max() - 1000);
  });
}

TEST_CASE("a table of hundreds of stages runs", "[run]") {
  auto const seed = test::run_seed();
  CAPTURE(seed);
  constexpr ds::shader_id stages = 300;  // ids of 16 bits
  test::transitions const t(stages, 1, seed);
  test::machine_run run(t, 20000, 5000);
  auto const any = [&run](ds::shader_id id, ds::request_index slot) { return run.step(id, slot); };
  ds::workspace scratch{thrust::cpp::par};
  ds::run(thrust::cpp::par, ds::wavefront{}, ds::items{20000, 5000}, test::begin_machine{&run},
          ds::shared_shaders<stages>(any), scratch);
  CHECK(all_are(run.ended, 1));
  CHECK(same_bits(run.results, test::expected_results(t, 20000)));
}

TEST_CASE("bad items are refused before one begins", "[run]") {
  test::transitions const t(1, 8, 1);
  test::machine_run run(t, 10, 1);
  ds::workspace scratch{thrust::cpp::par};
  ds::run_control control;
  auto const with = [&](ds::items all) {
    all.control = &control;
    ds::run(thrust::cpp::par, ds::wavefront{}, all, test::begin_machine{&run},
            test::machine_stages<1>(run), scratch);
  };
  CHECK_THROWS_AS(with({10, 0}), std::invalid_argument);
  CHECK_THROWS_AS(with({10, std::size_t{1} << 32}), std::length_error);
  CHECK_THROWS_AS(with({10, 1, std::numeric_limits<ds::item_index>::max() - 9}), std::length_error);
  CHECK(all_are(run.begun, 0));
  CHECK(control.begun() == 0);
  with({0, 0});
  with({10, 1});
  CHECK(all_are(run.ended, 1));
}
