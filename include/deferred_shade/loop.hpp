// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deferred_shade/config.hpp>  // first: it refuses what is too old

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <deferred_shade/detail/cpu/loops.hpp>
#include <deferred_shade/detail/cpu/rounds.hpp>
#include <deferred_shade/detail/stage_shaders.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/items.hpp>
#include <deferred_shade/schedule.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/types.hpp>

// A loop is a function object that `run` calls with its own arguments. A renderer may write one.

namespace deferred_shade {

/// Runs items in rounds. A round runs the next stage of every live request once, by `Schedule`;
/// then slots whose requests have ended take the next items.
///
/// On a CPU, each worker runs rounds over slots of its own, at most cpu_tuning::slots_of_worker,
/// and never waits for the others. The numbers below are of the slots of one worker then.
template <class Schedule = local_sort_then_dispatch<>>
struct wavefront {
  Schedule schedule{};
  /// A stage that fewer requests need waits, unless all do.
  request_index minimum = 0;
  /// The rounds that a stage waits at most.
  std::uint32_t oldest = 8;
  /// When no item is left and the share of live slots is below this one, each worker runs its
  /// requests to their ends, one by one.
  float tail = 0.01F;
  /// Slots take new items when the share of live ones is below this one.
  float refill_below = 1;

  template <class Policy, class Begin, class... Stages, class Workspace>
  void operator()(Policy const& exec, items const& all, Begin const& begin,
                  shader_table<Stages...> const& stages, Workspace& scratch) const {
    detail::run_wavefront(detail::system_of<Policy>{}, exec, *this, all,
                          detail::program<Begin, Stages...>{begin, stages}, scratch);
  }
};

template <class Schedule>
wavefront(Schedule) -> wavefront<Schedule>;

/// Runs items in rounds of one stage: the one that most requests need. Lanes never diverge between
/// stages, but a round leaves all other requests where they are.
struct fullest_first {
  template <class Policy, class Begin, class... Stages, class Workspace>
  void operator()(Policy const& exec, items const& all, Begin const& begin,
                  shader_table<Stages...> const& stages, Workspace& scratch) const {
    detail::run_fullest_first(detail::system_of<Policy>{}, exec, all,
                              detail::program<Begin, Stages...>{begin, stages}, scratch);
  }
};

/// Runs each item to its end before the next one, by a switch over its stages: the "megakernel". It
/// uses one slot for each worker, and no workspace.
struct depth_first {
  template <class Policy, class Begin, class... Stages, class Workspace>
  void operator()(Policy const& exec, items const& all, Begin const& begin,
                  shader_table<Stages...> const& stages, Workspace&) const {
    detail::run_depth_first(detail::system_of<Policy>{}, exec, all,
                            detail::program<Begin, Stages...>{begin, stages});
  }
};

/// The stages as shaders, for a renderer that runs rounds by itself on a CPU: shader k of this
/// table runs stage k on request i and stores the id of its next stage in next[i]. An id outside
/// the table becomes the table's size. `shade` must not read its ids from `next`: a schedule may
/// read an id again after the request has run.
///
///     ds::shade(exec, schedule, n, ids, ds::stepping(stages, next), scratch);
template <class... Stages, class Id>
auto stepping(shader_table<Stages...> const& stages, Id* next) {
  static_assert(detail::is_id<Id>,
                "deferred_shade: next must point at integers or enumerators of at most 32 bits");
  if constexpr (detail::is_id<Id>) {
    static_assert(detail::largest_id<Id>() >= sizeof...(Stages),
                  "deferred_shade: the type of next must be wide enough for the size of the table");
    return detail::stage_shaders(stages, detail::next_stages<Id>{next, 0, sizeof...(Stages)});
  }
}

/// Calls `f(name, loop)` for every loop of the library, with a `char const*` and an object of its
/// type.
template <class Function>
constexpr void for_each_loop(Function&& f) {
  f("wavefront", wavefront<>{});
  f("fullest-first", fullest_first{});
  f("depth-first", depth_first{});
}

}  // namespace deferred_shade
