// SPDX-License-Identifier: Apache-2.0
// What a loop tells while it runs, and how it is stopped.
#include <deferred_shade/run.hpp>

#include <atomic>
#include <vector>

#include "catch.hpp"
#include "support/backends.hpp"
#include "support/fewest_allocations.hpp"
#include "support/random_ids.hpp"
#include "support/state_machine.hpp"

namespace {

namespace ds = deferred_shade;

// A stage that goes on for ever, and asks the loop to end after 5000 steps.
struct endless {
  ds::run_control* control;
  std::atomic<std::uint64_t>* steps;
  ds::shader_id operator()(ds::request_index) const {
    if (steps->fetch_add(1) == 5000) control->stop(ds::stop_when::round_ended);
    return 0;
  }
};
struct begin_at_0 {
  ds::shader_id operator()(ds::request_index, ds::item_index) const { return 0; }
};

// Item k needs k % 7 + 1 steps; item `stop_at` asks the loop to begin no further ones.
struct counted_steps {
  std::vector<std::uint32_t>* left;      // by slot
  std::vector<ds::item_index>* item;     // by slot
  std::vector<std::atomic<int>>* ended;  // by item
  ds::run_control* control;
  ds::item_index stop_at;
  ds::shader_id operator()(ds::request_index slot, ds::item_index k) const {
    (*left)[slot] = static_cast<std::uint32_t>(k % 7 + 1);
    (*item)[slot] = k;
    if (k == stop_at) control->stop(ds::stop_when::items_ended);
    return 0;
  }
  ds::shader_id operator()(ds::request_index slot) const {
    if (--(*left)[slot] != 0) return 0;
    ++(*ended)[static_cast<std::size_t>((*item)[slot])];
    return 1;
  }
};

}  // namespace

TEMPLATE_LIST_TEST_CASE("a loop that cannot end is stopped", "[run]", test::host_backends) {
  ds::for_each_loop([](char const* name, auto const& loop) {
    CAPTURE(name);
    ds::run_control control;
    std::atomic<std::uint64_t> steps{0};
    ds::workspace scratch{TestType::policy()};
    ds::run(TestType::policy(), loop, ds::items{1000, 100, 0, &control}, begin_at_0{},
            ds::shader_table{endless{&control, &steps}}, scratch);
    CHECK(steps > 5000);
    CHECK(control.ended() == 0);
    CHECK(control.begun() > 0);
    CHECK(control.begun() <= 1000);
  });
}

TEMPLATE_LIST_TEST_CASE("a loop that begins no more items ends those that it has begun", "[run]",
                        test::host_backends) {
  std::size_t const count = 20000, slots = 64;
  ds::for_each_loop([&](char const* name, auto const& loop) {
    CAPTURE(name);
    std::vector<std::uint32_t> left(slots);
    std::vector<ds::item_index> item(slots);
    std::vector<std::atomic<int>> ended(count);
    ds::run_control control;
    ds::workspace scratch{TestType::policy()};
    counted_steps const stage{&left, &item, &ended, &control, 500};
    ds::items all{count, slots, 0, &control};
    ds::run(TestType::policy(), loop, all, stage, ds::shader_table{stage}, scratch);
    ds::item_index const begun = control.begun();
    CHECK(begun > 500);
    CHECK(begun < count);
    CHECK(control.ended() == begun);
    for (std::size_t k = 0; k < count; ++k) {
      if (ended[k] != (k < begun ? 1 : 0)) FAIL("item " << k << " ended " << ended[k] << " times");
    }

    // A loop heeds a flag that is already set; without it, the other items follow.
    ds::run(TestType::policy(), loop, all, stage, ds::shader_table{stage}, scratch);
    CHECK(control.begun() == 0);
    control.stop(ds::stop_when::never);
    all.first = begun;
    all.count = count - begun;
    ds::run(TestType::policy(), loop, all, stage, ds::shader_table{stage}, scratch);
    CHECK(control.ended() == count - begun);
    for (auto const& times : ended) CHECK(times == 1);
  });
}

TEMPLATE_LIST_TEST_CASE("a second run of a loop allocates nothing", "[run]", test::host_backends) {
  if (!test::counts_allocations_of<TestType>()) {
    WARN("skipped: the allocations of this build or runtime are not counted");
    return;
  }
  test::transitions const t(4, 2, 5);
  ds::for_each_loop([&](char const* name, auto const& loop) {
    CAPTURE(name);
    test::machine_run run(t, 10000, 9000);
    ds::workspace scratch{TestType::policy()};
    auto const stages = test::machine_stages<4>(run);
    auto const go = [&] {
      ds::run(TestType::policy(), loop, ds::items{10000, 9000}, test::begin_machine{&run}, stages,
              scratch);
    };
    go();
    CHECK(test::fewest_allocations(go) == 0);
  });
}
