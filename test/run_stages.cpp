// SPDX-License-Identifier: Apache-2.0
// What may be a stage, a schedule of a loop, and a loop.
#include <deferred_shade/run.hpp>

#include <algorithm>
#include <bitset>
#include <cstdint>
#include <vector>

#include "catch.hpp"
#include "examples/largest_first_then_dispatch.hpp"
#include "examples/slots_at_once.hpp"
#include "support/backends.hpp"
#include "support/random_ids.hpp"
#include "support/state_machine.hpp"

namespace {

namespace ds = deferred_shade;

// ---- Record stages: an item is a number that is halved if it is even and else 3 x + 1 until it is
// 1 (Collatz 1937). Its result is the number of steps.

enum class parity : std::uint8_t { even, odd, one = 200 };
parity of(std::uint32_t x) {
  return x == 1 ? parity::one : x % 2 == 0 ? parity::even : parity::odd;
}

struct number {
  std::uint32_t x, steps;
};
struct halve {
  number operator()(number const& n) const { return {n.x / 2, n.steps + 1}; }
};
struct triple {
  number operator()(number const& n) const { return {3 * n.x + 1, n.steps + 1}; }
};
struct store_number {
  number* numbers;
  std::uint32_t const* items;
  std::uint32_t* steps;
  parity operator()(ds::request_index slot, number const& n) const {
    numbers[slot] = n;
    if (n.x == 1) steps[items[slot]] = n.steps;
    return of(n.x);
  }
};
struct load_number {
  number const* numbers;
  number const& operator()(ds::request_index slot) const { return numbers[slot]; }
};
struct begin_number {
  number* numbers;
  std::uint32_t* items;
  parity operator()(ds::request_index slot, ds::item_index k) const {
    items[slot] = static_cast<std::uint32_t>(k);
    numbers[slot] = {static_cast<std::uint32_t>(k) + 1, 0};
    return of(numbers[slot].x);
  }
};

std::vector<std::uint32_t> collatz_steps(std::uint32_t count) {
  std::vector<std::uint32_t> steps(count);
  for (std::uint32_t k = 0; k < count; ++k) {
    for (std::uint32_t x = k + 1; x != 1; ++steps[k]) x = x % 2 == 0 ? x / 2 : 3 * x + 1;
  }
  return steps;
}

template <class Backend, class Loop>
void check_collatz(Loop const& loop) {
  std::uint32_t const count = 30000, slots = 5000;
  std::vector<number> numbers(slots);
  std::vector<std::uint32_t> items(slots), steps(count);
  ds::workspace scratch{Backend::policy()};
  store_number const sink{numbers.data(), items.data(), steps.data()};
  auto const go = [&](auto const& stages) {
    std::fill(steps.begin(), steps.end(), 0U);
    ds::run(Backend::policy(), loop, ds::items{count, slots},
            begin_number{numbers.data(), items.data()}, stages, scratch);
    CHECK(steps == collatz_steps(count));
  };
  go(ds::record_shaders(numbers.data(), sink, halve{}, triple{}));
  go(ds::record_shaders(load_number{numbers.data()}, sink, halve{}, triple{}));
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("record shaders are stages if their sink names the next one", "[run]",
                        test::host_backends) {
  ds::for_each_loop([](char const* name, auto const& loop) {
    CAPTURE(name);
    check_collatz<TestType>(loop);
  });
  check_collatz<TestType>(ds::wavefront{ds::sort_then_dispatch<>{}});
}

TEMPLATE_LIST_TEST_CASE("a loop and a schedule may be a renderer's own", "[run]",
                        test::host_backends) {
  check_collatz<TestType>(slots_at_once<ds::bucket_then_dispatch<>>{});
  check_collatz<TestType>(ds::wavefront{largest_first_then_dispatch{}});
}

TEMPLATE_LIST_TEST_CASE("a request ends at a stage that the table leaves out", "[run]",
                        test::host_backends) {
  auto const seed = test::run_seed();
  CAPTURE(seed);
  std::size_t const count = 5000;
  test::transitions const full(6, 1, seed);
  test::transitions cut = full;  // stages 2 and 5 end requests
  for (std::vector<std::uint32_t>* const ids : {&cut.row, &cut.first}) {
    for (auto& id : *ids) id = id == 2 || id == 5 ? 6 : id;
  }
  ds::for_each_loop([&](char const* name, auto const& loop) {
    CAPTURE(name);
    ds::workspace scratch{TestType::policy()};
    auto const check = [&](auto leave_out) {
      test::machine_run run(cut, count, 700);
      test::machine_run through(full, count, 700);
      ds::run(TestType::policy(), loop, ds::items{count, 700}, test::begin_machine{&run},
              test::machine_stages<6>(run), scratch);
      ds::run_control control;
      ds::run(TestType::policy(), loop, ds::items{count, 700, 0, &control},
              test::begin_machine{&through}, leave_out(test::machine_stages<6>(through)), scratch);
      CHECK(control.ended() == count);
      std::size_t ended = 0;  // by themselves, and not at a stage that is left out
      for (std::size_t k = 0; k < count; ++k) {
        if (through.begun[k] != 1) FAIL("item " << k);
        if (through.ended[k] == 0) continue;
        ++ended;
        if (through.results[k] != run.results[k]) FAIL("item " << k);
      }
      CHECK(ended > 0);
      CHECK(ended < count);
    };
    check([](auto const& stages) { return stages.template only<0, 1, 3, 4>(); });
    check([](auto const& stages) { return stages.expecting(std::bitset<6>("011011")); });
  });
}
