// SPDX-License-Identifier: Apache-2.0
// What `shade` promises of the machine that it runs on, on all systems for CPUs: the order in which
// a worker starts requests, where it runs few of them, and how much of a stack it takes.
// Covers detail/cpu/parallel_for.hpp.
#include <deferred_shade/deferred_shade.hpp>

#include <atomic>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

#include "catch.hpp"
#include "support/backends.hpp"
#include "support/random_ids.hpp"
#include "support/schedule_properties.hpp"
#include "support/stack.hpp"
#ifdef DEFERRED_SHADE_TEST_TBB
#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

namespace {

namespace ds = deferred_shade;

#if !defined(DEFERRED_SHADE_TEST_SANITIZED) || defined(DEFERRED_SHADE_TEST_TBB)
struct adding_shader {
  std::uint32_t id;
  std::uint32_t* sums;
  void operator()(ds::request_index i) const { sums[i] += 7 * i + id; }
};
template <std::uint32_t Shaders, std::uint32_t... Kept>
auto adding_table(std::uint32_t* sums) {
  return test::table_of<Kept...>(
      [sums](std::uint32_t id) {
        return adding_shader{id + 1, sums};
      },
      std::make_integer_sequence<std::uint32_t, Shaders>());
}
#endif

}  // namespace

TEMPLATE_LIST_TEST_CASE("a worker starts the requests of a shader in the order of their indices",
                        "[promises]", test::host_backends) {
  struct last_started {
    std::uint64_t batch = 0;
    std::int64_t index[3] = {-1, -1, -1};
  };
  static std::atomic<std::uint64_t> batch{0};
  static thread_local last_started last;
  std::uint32_t const n = 300007;
  auto const ids = test::make_ids<std::uint8_t>(test::layout::random, n, 3, test::run_seed());
  CAPTURE(test::run_seed());
  std::vector<float> results(n);
  std::atomic<int> late{0};
  auto const watching = [&](std::uint32_t id) {
    return [&late, id, results = results.data()](ds::request_index i) {
      if (last.batch != batch.load(std::memory_order_relaxed)) last = {batch.load(), {-1, -1, -1}};
      if (last.index[id] > static_cast<std::int64_t>(i)) ++late;
      last.index[id] = i;
      auto x = static_cast<float>(i);
      for (int step = 0; step < 10; ++step) x = x * 1.0001F + 1;
      results[i] = x;
    };
  };
  ds::shader_table const shaders{watching(0), watching(1), watching(2)};
  ds::workspace scratch{TestType::policy()};
  ds::for_each_schedule([&](char const* name, auto const& schedule) {
    CAPTURE(name);
    for (int repetition = 0; repetition < 3; ++repetition) {
      ++batch;
      ds::shade(TestType::policy(), schedule, n, ids.data(), shaders, scratch);
    }
    CHECK(late.exchange(0) == 0);
  });
}

TEMPLATE_LIST_TEST_CASE("what fits one worker runs on the thread that called", "[promises]",
                        test::host_backends) {
  auto const caller = std::this_thread::get_id();
  for (std::uint32_t const n : {1U, 2U, 32U}) {
    std::vector<std::uint8_t> const ids(n, 1);
    std::atomic<int> elsewhere{0};
    auto const watching = [&](ds::request_index) {
      if (std::this_thread::get_id() != caller) ++elsewhere;
    };
    ds::workspace scratch{TestType::policy()};
    ds::for_each_schedule([&](char const* name, auto const& schedule) {
      CAPTURE(name, n);
      ds::shade(TestType::policy(), schedule, n, ids.data(),
                ds::shader_table{watching, watching, watching}, scratch);
      CHECK(elsewhere.exchange(0) == 0);
    });
  }
}

#ifndef DEFERRED_SHADE_TEST_SANITIZED
template <std::uint32_t Shaders, std::uint32_t... Kept, class Schedule>
void check_stack(Schedule const& schedule) {
  std::uint32_t const n = 70001;
  auto const ids =
      test::make_ids<std::uint16_t>(test::layout::random, n, Shaders, test::run_seed());
  CAPTURE(test::run_seed(), Shaders);
  std::vector<std::uint32_t> sums(n);
  auto const shaders = adding_table<Shaders, Kept...>(sums.data());
  ds::workspace scratch{thrust::cpp::par};
  std::size_t const bytes = test::stack_bytes(
      [&] { ds::shade(thrust::cpp::par, schedule, n, ids.data(), shaders, scratch); });
  CHECK(bytes < 64 * 1024);
}

TEST_CASE("no schedule takes more than 64 KiB of stack", "[promises]") {
  ds::for_each_schedule([&](char const* name, auto const& schedule) {
    CAPTURE(name);
    check_stack<5>(schedule);
  });
  // Code for many shaders, and the largest tables of each way in which a tile is sorted: by keys of
  // one byte, by keys of two, with counters once instead of in parts, and by the network, whose
  // stack does not depend on the table.
  check_stack<64>(ds::local_sort_then_dispatch<>{});
  check_stack<255, 0, 100, 254>(ds::local_sort_then_dispatch<>{});
  check_stack<511, 0, 300, 510>(ds::local_sort_then_dispatch<>{});
  constexpr std::uint32_t tile = ds::cpu_tuning::tile;
  auto const ids =
      test::make_ids<std::uint16_t>(test::layout::random, tile, 1023, test::run_seed());
  CHECK(test::stack_bytes([&] {
          ds::detail::sorted_tile<1023, tile> sorted;
          ds::detail::counting_sort<ds::cpu_tuning>(ids.data(), 0, tile, sorted);
        }) < 60 * 1024);
  STATIC_REQUIRE(ds::cpu_tuning::counts_tiles(1023));
  STATIC_REQUIRE(!ds::cpu_tuning::counts_tiles(1024));
}

TEST_CASE("groupings over many ids take little stack", "[promises]") {
  std::uint32_t const n = 300007;
  auto const ids = test::make_ids<std::uint32_t>(test::layout::random, n, 65535, test::run_seed());
  ds::workspace scratch{thrust::cpp::par};
  CHECK(test::stack_bytes([&] {
          ds::group_by_bucket<65535>(thrust::cpp::par, n, ids.data(), scratch);
        }) < 64 * 1024);
  CHECK(test::stack_bytes([&] {
          ds::group_by_bucket<2500000>(thrust::cpp::par, n, ids.data(), scratch);
        }) < 64 * 1024);
  CHECK(test::stack_bytes([&] {
          ds::group_by_radix_sort<65535>(thrust::cpp::par, n, ids.data(), scratch);
        }) < 64 * 1024);
}
#endif

#ifdef DEFERRED_SHADE_TEST_TBB
TEST_CASE("a TBB thread that waits in shade takes no other task of the renderer's", "[promises]") {
  // A workspace for each thread. A task that came in between would use it twice.
  tbb::global_control const threads(tbb::global_control::max_allowed_parallelism, 8);
  tbb::task_arena arena(8);
  tbb::enumerable_thread_specific<ds::workspace<>> scratch;
  static thread_local int depth = 0;
  std::atomic<int> nested{0};
  std::atomic<int> wrong{0};
  arena.execute([&] {
    for (int repetition = 0; repetition < 3; ++repetition) {
      tbb::parallel_for(0, 64, [&](int task) {
        if (++depth > 1) ++nested;
        std::uint32_t const n = 100003;
        auto const ids = test::make_ids<std::uint8_t>(test::layout::random, n, 7,
                                                      static_cast<std::uint32_t>(task));
        std::vector<std::uint32_t> sums(n);
        auto const shaders = adding_table<5>(sums.data());
        ds::shade(thrust::tbb::par, ds::bucket_then_dispatch<>{}, n, ids.data(), shaders,
                  scratch.local());
        for (std::uint32_t i = 0; i < n; ++i) {
          if (sums[i] != (ids[i] < 5 ? 7 * i + ids[i] + 1 : 0)) {
            ++wrong;
            break;
          }
        }
        --depth;
      });
    }
  });
  CHECK(wrong == 0);
  CHECK(nested == 0);
}
#endif
