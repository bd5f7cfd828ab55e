// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thrust/for_each.h>
#include <thrust/iterator/counting_iterator.h>
#include <thrust/system/omp/detail/execution_policy.h>
#include <thrust/system/tbb/detail/execution_policy.h>
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#ifdef _OPENMP
#include <omp.h>
#endif
#if __has_include(<tbb/task_arena.h>)
// Its headers do not compile with macros of these names, which a renderer may have.
#pragma push_macro("min")
#pragma push_macro("max")
#undef min
#undef max
#include <tbb/task_arena.h>
#pragma pop_macro("max")
#pragma pop_macro("min")
#define DEFERRED_SHADE_HAS_TBB 1
#else
#define DEFERRED_SHADE_HAS_TBB 0
#endif

#include <deferred_shade/detail/cpu/tuning.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/types.hpp>

// The loops that all algorithms for CPUs are made of. They make two promises that Thrust's TBB
// system does not make. First, a worker takes indices in ascending order. Second, a thread that
// waits for the end of the loop takes no other task of the renderer's, which could call the library
// with the same workspace.

namespace deferred_shade::detail {

template <class Policy>
std::true_type find_tbb(thrust::system::tbb::detail::execution_policy<Policy> const&);
std::false_type find_tbb(...);
template <class Policy>
inline constexpr bool is_tbb = decltype(detail::find_tbb(std::declval<Policy const&>()))::value;
template <class Policy>
std::true_type find_omp(thrust::system::omp::detail::execution_policy<Policy> const&);
std::false_type find_omp(...);
template <class Policy>
inline constexpr bool is_omp = decltype(detail::find_omp(std::declval<Policy const&>()))::value;

/// The threads that a policy runs on.
template <class Policy>
std::size_t workers_of(Policy const&) {
  int workers = 1;
#ifdef _OPENMP
  if constexpr (is_omp<Policy>) workers = omp_get_max_threads();
#endif
#if DEFERRED_SHADE_HAS_TBB
  if constexpr (is_tbb<Policy>) workers = ::tbb::this_task_arena::max_concurrency();
#endif
  return static_cast<std::size_t>((std::max)(1, workers));
}

#if DEFERRED_SHADE_HAS_TBB
/// Calls `f(i)` for i from 0 to `count` - 1. Each worker takes the next index that is left.
template <class Policy, class Function>
void parallel_for_tbb(Policy const& exec, std::size_t count, Function const& f) {
  std::size_t const workers = detail::workers_of(exec);
  std::atomic<std::size_t> next{0};
  ::tbb::this_task_arena::isolate([&] {
    thrust::for_each_n(exec, thrust::counting_iterator<std::uint32_t>(0),
                       (std::min)(count, workers), [&](std::uint32_t) {
                         for (std::size_t i = next++; i < count; i = next++) f(i);
                       });
  });
}
#endif

/// Calls `f(i)` for i from 0 to `count` - 1, a std::size_t, spread over the workers of `exec`. A
/// single index runs on the calling thread, without a parallel region.
template <class Policy, class Function>
void parallel_for(Policy const& exec, std::size_t count, Function const& f) {
  if (count <= 1) {
    if (count == 1) f(std::size_t{0});
    return;
  }
  if constexpr (is_tbb<Policy>) {
#if DEFERRED_SHADE_HAS_TBB
    detail::parallel_for_tbb(exec, count, f);
#endif
  } else {
    thrust::for_each_n(exec, thrust::counting_iterator<std::size_t>(0), count, f);
  }
}

/// Calls `f(i)` for the requests from 0 to `n` - 1, spread over the workers of `exec`. A few
/// requests run on the calling thread: only slow shaders would be worth a parallel region.
template <class Policy, class Function>
void for_each_request(Policy const& exec, std::size_t n, Function const& f) {
  if (n <= serial_requests) {
    for (std::size_t i = 0; i < n; ++i) f(static_cast<request_index>(i));
    return;
  }
  if constexpr (is_tbb<Policy>) {
    std::size_t const chunk = (std::min)(largest_chunk, n / chunks_by_tbb + 1);
    detail::parallel_for(exec, (n + chunk - 1) / chunk, [&](std::size_t c) {
      std::size_t const end = (std::min)(n, (c + 1) * chunk);
      for (std::size_t i = c * chunk; i < end; ++i) f(static_cast<request_index>(i));
    });
  } else {
    thrust::for_each_n(exec, thrust::counting_iterator<request_index>(0), n, f);
  }
}

}  // namespace deferred_shade::detail
