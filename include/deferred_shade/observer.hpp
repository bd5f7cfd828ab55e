// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

#include <deferred_shade/types.hpp>
#include <deferred_shade/workspace.hpp>

namespace deferred_shade {
namespace detail {

// The tuning of a workspace that carries one: see `tuned`.
template <class Workspace, class = void>
struct find_tuning {
  using type = void;
};
template <class Workspace>
struct find_tuning<Workspace, std::void_t<typename Workspace::tuning_type>> {
  using type = typename Workspace::tuning_type;
};

/// What observed, tuned and others have in common: they are the workspace, except in one thing.
template <class Workspace>
struct workspace_wrapper {
  using tuning_type = typename find_tuning<Workspace>::type;
  using allocator_type = typename allocator_of<Workspace>::type;

  explicit workspace_wrapper(Workspace& wrapped) : scratch(wrapped) {}

  void reserve(std::size_t n, std::size_t shaders) const { scratch.reserve(n, shaders); }
  template <class... T>
  auto take(elements<T>... arrays) const {
    return scratch.take(arrays...);
  }
  auto begin_phase(phase const& p) const { return scratch.begin_phase(p); }

  Workspace& scratch;
};

}  // namespace detail

/// A workspace whose observer is told what a schedule does, for a profiler or a timeline. Pass it
/// in place of the workspace. A workspace that is not observed costs nothing.
///
/// `Observer` is a function object that is cheap to copy, called with each phase. What it returns,
/// any value if it needs none, lives as long as the phase and ends with it, by an exception as
/// well, on the thread that called shade(). `group` is told by schedules that order a batch before
/// they run it, `dispatch` by all, and in it `shader` by those that have a launch for each shader.
/// On CUDA, what lies between is the submission of work: nothing waits, and what the observer
/// itself puts on the stream, an event say, stands before and behind the work of the phase. Kernels
/// do not overlap across it.
///
///     auto const ranges = [](ds::phase const& p) { return nvtx3::scoped_range{p.name}; };
///     deferred_shade::observed seen{scratch, ranges};
///     deferred_shade::shade(exec, schedule, n, ids, shaders, seen);
template <class Workspace, class Observer>
struct observed : detail::workspace_wrapper<Workspace> {
  Observer observer;

  observed(Workspace& scratch, Observer tells)
      : detail::workspace_wrapper<Workspace>(scratch), observer(std::move(tells)) {}

  /// Tells the observer; the phase lasts as long as what is returned.
  auto begin_phase(phase const& p) const {
    constexpr bool is_called = std::is_invocable_v<Observer const&, phase const&>;
    static_assert(is_called,
                  "deferred_shade: an observer must be callable as observer(phase), by an "
                  "operator() that is const");
    if constexpr (is_called) {
      constexpr bool returns = !std::is_void_v<std::invoke_result_t<Observer const&, phase const&>>;
      static_assert(
          returns, "deferred_shade: an observer must return something; return 0 if it has nothing");
      if constexpr (returns) {
        return observer(p);
      } else {
        return 0;
      }
    } else {
      return 0;
    }
  }
};

}  // namespace deferred_shade
