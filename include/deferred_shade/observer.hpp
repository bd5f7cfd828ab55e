// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

#include <deferred_shade/types.hpp>
#include <deferred_shade/workspace.hpp>

namespace deferred_shade {
namespace detail {

// The tuning that a workspace carries (see `tuned`), or void.
template <class Workspace, class = void>
struct find_tuning {
  using type = void;
};
template <class Workspace>
struct find_tuning<Workspace, std::void_t<typename Workspace::tuning_type>> {
  using type = typename Workspace::tuning_type;
};

/// The base of observed, tuned and others: a workspace that passes everything on to another one.
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

/// A workspace that tells an observer what a schedule does, for a profiler or a timeline. Pass it
/// in place of the workspace. An unobserved workspace costs nothing.
///
/// `Observer` is a function object that is cheap to copy. It is called as each phase begins, on the
/// thread that called shade(). It returns an object, which is destroyed when the phase ends, by an
/// exception as well; any value does if it needs none. All schedules have a phase `dispatch`. Those
/// that order a batch first have a phase `group` before it. Those with a launch for each shader
/// have phases `shader` within it.
///
/// On CUDA, a phase is the submission of work, and nothing waits for the work. An event that the
/// observer records on the stream stands before or behind the work of the phase. Kernels do not
/// overlap across it.
///
///     auto const ranges = [](ds::phase const& p) { return nvtx3::scoped_range{p.name}; };
///     deferred_shade::observed seen{scratch, ranges};
///     deferred_shade::shade(exec, schedule, n, ids, shaders, seen);
template <class Workspace, class Observer>
struct observed : detail::workspace_wrapper<Workspace> {
  Observer observer;

  observed(Workspace& scratch, Observer tells)
      : detail::workspace_wrapper<Workspace>(scratch), observer(std::move(tells)) {}

  /// Tells the observer. The phase lasts as long as the object that is returned.
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
