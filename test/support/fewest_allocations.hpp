// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <type_traits>

#include "allocation_count.hpp"
#include "backends.hpp"

namespace test {

/// Whether this build counts the allocations of calls on a backend, and its runtime makes none.
/// LLVM's OpenMP allocates for every parallel region, libgomp does not.
template <class Backend>
bool counts_allocations_of() {
#if defined(__clang__) && defined(DEFERRED_SHADE_TEST_OMP)
  if (std::is_same_v<Backend, omp>) return false;
#endif
  return counts_allocations;
}

/// The allocations of a call of `f`. The least of three calls: threads of the runtime are warm
/// then, and those of the CUDA driver allocate now and then, for purposes of their own.
template <class Function>
std::size_t fewest_allocations(Function const& f) {
  std::size_t least = static_cast<std::size_t>(-1);
  for (int call = 0; call < 3; ++call) {
    std::size_t const before = allocations();
    f();
    least = std::min(least, allocations() - before);
  }
  return least;
}

}  // namespace test
