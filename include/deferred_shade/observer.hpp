// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <type_traits>

#include <deferred_shade/types.hpp>
#include <deferred_shade/workspace.hpp>

namespace deferred_shade {

/// A workspace whose observer is told what a schedule does, for a profiler or a timeline. It goes
/// where the workspace would; there, no code is made for it.
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
template <class Allocator, class Observer>
struct observed {
  using allocator_type = Allocator;

  workspace<Allocator>& scratch;
  Observer observer;

  /// The workspace's.
  void reserve(std::size_t n, std::size_t shaders) const { scratch.reserve(n, shaders); }
  template <class... T>
  auto take(elements<T>... arrays) const {
    return scratch.take(arrays...);
  }

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

template <class Allocator, class Observer>
observed(workspace<Allocator>&, Observer) -> observed<Allocator, Observer>;

}  // namespace deferred_shade
