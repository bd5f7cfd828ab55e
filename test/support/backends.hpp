// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thrust/system/cpp/execution_policy.h>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <tuple>
#include <vector>
#ifdef DEFERRED_SHADE_TEST_OMP
#include <thrust/system/omp/execution_policy.h>
#endif
#ifdef DEFERRED_SHADE_TEST_TBB
#include <thrust/system/tbb/execution_policy.h>
#endif
#ifdef DEFERRED_SHADE_TEST_CUDA
#include "cuda.hpp"
#endif

namespace test {

/// What the CPU backends share, and what every backend has: `vector`, for data that a test fills
/// and compares and that `shade` reads and writes; `allocator`, for memory that a workspace takes;
/// `wait`, which returns when `shade` is done; `read`, which copies out of a workspace; and
/// `many_blocks`, the size of a batch of several blocks.
struct on_host {
  static constexpr std::uint32_t many_blocks = 50021;
  template <class T>
  using vector = std::vector<T>;
  template <class T>
  using allocator = std::allocator<T>;
  static void wait() {}
  template <class T>
  static std::vector<T> read(T const* first, std::size_t n) {
    return {first, first + n};
  }
};

struct cpp : on_host {
  static auto policy() { return thrust::cpp::par; }
};
#ifdef DEFERRED_SHADE_TEST_OMP
struct omp : on_host {
  static auto policy() { return thrust::omp::par; }
};
#endif
#ifdef DEFERRED_SHADE_TEST_TBB
struct tbb : on_host {
  static auto policy() { return thrust::tbb::par; }
};
#endif

/// The Thrust systems for CPUs that this build tests, for TEMPLATE_LIST_TEST_CASE.
using host_backends = decltype(std::tuple_cat(
#ifdef DEFERRED_SHADE_TEST_CPP
    std::tuple<cpp>{},
#endif
#ifdef DEFERRED_SHADE_TEST_OMP
    std::tuple<omp>{},
#endif
#ifdef DEFERRED_SHADE_TEST_TBB
    std::tuple<tbb>{},
#endif
    std::tuple<>{}));

/// All Thrust systems that this build tests.
#ifdef DEFERRED_SHADE_TEST_CUDA
using backends = decltype(std::tuple_cat(host_backends{}, std::tuple<cuda>{}));
#else
using backends = host_backends;
#endif

/// A copy of `data` where shaders on `Backend` can reach it.
template <class Backend, class T>
typename Backend::template vector<T> on(std::vector<T> const& data) {
  return {data.begin(), data.end()};
}

}  // namespace test
