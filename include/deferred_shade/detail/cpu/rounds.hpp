// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thrust/system/cpp/execution_policy.h>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <new>
#include <type_traits>
#include <utility>

#include <deferred_shade/detail/cpu/item_source.hpp>
#include <deferred_shade/detail/cpu/loops.hpp>
#include <deferred_shade/detail/cpu/segment.hpp>
#include <deferred_shade/detail/cpu/worker_workspace.hpp>
#include <deferred_shade/detail/shader_subset.hpp>
#include <deferred_shade/detail/stage_shaders.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/items.hpp>
#include <deferred_shade/types.hpp>
#include <deferred_shade/workspace.hpp>

// Loops that run rounds over the slots of a worker.

namespace deferred_shade::detail {

/// How many requests of a pool need each stage.
template <shader_id Stages>
struct stage_counts {
  request_index of[Stages + 1];

  template <class Key>
  void count(Key const* next, request_index size) {
    std::fill_n(of, Stages + 1, 0U);
    for (request_index i = 0; i < size; ++i) ++of[next[i]];
  }
};

/// The stages that wait for more requests.
template <shader_id Stages>
class waiting_stages {
 public:
  /// Copies the keys to `current`, except those of stages that wait for another round.
  template <class Loop, class Key>
  void leave_out(Loop const& loop, Key const* next, request_index size, Key* current) {
    counts_.count(next, size);
    bool any = false;
    for (shader_id k = 0; k < Stages; ++k) {
      waits_[k] = counts_.of[k] < loop.minimum && rounds_[k] < loop.oldest;
      any = any || (!waits_[k] && counts_.of[k] != 0);
    }
    for (shader_id k = 0; k < Stages; ++k) {
      waits_[k] = waits_[k] && any;
      rounds_[k] = waits_[k] && counts_.of[k] != 0 ? rounds_[k] + 1 : 0;
    }
    for (request_index i = 0; i < size; ++i) {
      current[i] = waits_[next[i]] ? static_cast<Key>(Stages) : next[i];
    }
  }

 private:
  stage_counts<Stages> counts_{};
  std::uint32_t rounds_[Stages] = {};
  bool waits_[Stages + 1] = {};
};

/// The bytes of workspace that a schedule says it takes, or 0.
template <class Schedule, class Policy, class = void>
struct bytes_of_schedule {
  static std::size_t of(Schedule const&, Policy const&, std::size_t, std::size_t) { return 0; }
};
template <class Schedule, class Policy>
struct bytes_of_schedule<Schedule, Policy,
                         std::void_t<decltype(std::declval<Schedule const&>().workspace_bytes(
                             std::declval<Policy const&>(), std::size_t{}, std::size_t{}))>> {
  static std::size_t of(Schedule const& schedule, Policy const& exec, std::size_t n,
                        std::size_t stages) {
    return schedule.workspace_bytes(exec, n, stages);
  }
};

/// Runs rounds: in each, all live requests of a pool by the schedule of the loop, except stages
/// that wait.
template <class Policy, class Loop, class Program, class Workspace>
void run_wavefront(host_system here, Policy const& exec, Loop const& loop, items const& all,
                   Program const& what, Workspace& scratch) {
  using key = typename Program::key;
  auto const alone = thrust::cpp::par;  // a worker runs the schedule by itself
  using schedule_bytes = bytes_of_schedule<decltype(loop.schedule), decltype(alone)>;
  request_index const slots = detail::slots_of(exec, all, scratch).each;
  // Not on the stack, which may be small beside a large table.
  using waiting_stages = detail::waiting_stages<Program::none>;
  std::size_t const state = detail::array_bytes<waiting_stages>(1);
  std::size_t const keys = detail::array_bytes<key>(slots);
  std::size_t const bytes = worker_workspace<Workspace>::bytes_around(
      schedule_bytes::of(loop.schedule, alone, slots, Program::none));
  detail::for_each_pool(
      exec, all, what, scratch, state + keys + detail::array_bytes<std::byte>(bytes),
      [&](auto& pool, std::byte* memory, item_source& source) {
        auto& waiting = *::new (static_cast<void*>(memory)) waiting_stages{};
        auto* const current = reinterpret_cast<key*>(memory + state);
        worker_workspace<Workspace> own({memory + state + keys, bytes});
        auto const shaders = detail::stage_shaders(what.stages, pool.target());
        auto const size = static_cast<float>(pool.size());
        while (!source.must_end()) {
          bool const refills = static_cast<float>(pool.live()) < loop.refill_below * size;
          if (refills || pool.live() == 0) pool.refill(source);
          if (pool.live() == 0) return;
          if (!source.has_more() && static_cast<float>(pool.live()) < loop.tail * size) {
            return pool.finish(source);
          }
          if (loop.minimum > 0) {
            waiting.leave_out(loop, pool.next(), pool.size(), current);
          } else {
            std::copy_n(pool.next(), pool.size(), current);
          }
          detail::run_schedule(here, loop.schedule, alone, pool.size(), current, shaders, own);
          pool.count_ended(source);
        }
      });
}

/// Runs the stage that most requests of a pool need. `those` has room for its slots.
template <class Pool, class Shaders, class Counts>
void run_fullest(Pool const& pool, Shaders const& shaders, Counts& counts, request_index* those) {
  counts.count(pool.next(), pool.size());
  auto const fullest =
      static_cast<shader_id>(std::max_element(counts.of, counts.of + Shaders::size()) - counts.of);
  std::size_t n = 0;
  for (request_index i = 0; i < pool.size(); ++i) {
    if (pool.next()[i] == fullest) those[n++] = i;
  }
  shaders.visit(fullest, [=](auto const& shader) {
    detail::run_segment(
        shader, n, [those](std::size_t j) { return those[j]; }, [](std::size_t) {});
  });
}

/// Runs rounds of one stage.
template <class Policy, class Program, class Workspace>
void run_fullest_first(host_system, Policy const& exec, items const& all, Program const& what,
                       Workspace& scratch) {
  using stage_counts = detail::stage_counts<Program::none>;
  std::size_t const state = detail::array_bytes<stage_counts>(1);
  request_index const slots = detail::slots_of(exec, all, scratch).each;
  detail::for_each_pool(exec, all, what, scratch, state + detail::array_bytes<request_index>(slots),
                        [&](auto& pool, std::byte* memory, item_source& source) {
                          auto& counts = *::new (static_cast<void*>(memory)) stage_counts{};
                          auto* const those = reinterpret_cast<request_index*>(memory + state);
                          auto const shaders = detail::stage_shaders(what.stages, pool.target());
                          while (!source.must_end()) {
                            pool.refill(source);
                            if (pool.live() == 0) return;
                            detail::run_fullest(pool, shaders, counts, those);
                            pool.count_ended(source);
                          }
                        });
}

}  // namespace deferred_shade::detail
