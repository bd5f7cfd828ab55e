// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thrust/system/omp/detail/execution_policy.h>
#include <algorithm>
#include <cstddef>
#include <memory>
#include <type_traits>
#ifdef _OPENMP
#include <omp.h>
#endif

#include <deferred_shade/detail/cpu/parallel_for.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/observer.hpp>
#include <deferred_shade/workspace.hpp>

namespace deferred_shade::detail {

template <class Policy>
std::true_type find_omp(thrust::system::omp::detail::execution_policy<Policy> const&);
std::false_type find_omp(...);

/// The threads that a policy runs on.
template <class Policy>
std::size_t workers_of(Policy const&) {
#ifdef _OPENMP
  if constexpr (decltype(detail::find_omp(std::declval<Policy const&>()))::value) {
    return static_cast<std::size_t>((std::max)(1, omp_get_max_threads()));
  }
#endif
#if DEFERRED_SHADE_HAS_TBB
  if constexpr (is_tbb<Policy>) {
    return static_cast<std::size_t>((std::max)(1, ::tbb::this_task_arena::max_concurrency()));
  }
#endif
  return 1;
}

/// An allocator of one part of a larger array, and of memory of its own for those who need more.
template <class T>
struct slice_allocator {
  using value_type = T;
  std::byte* memory;
  std::size_t bytes;

  slice_allocator(std::byte* there, std::size_t size) : memory(there), bytes(size) {}
  template <class U>
  slice_allocator(slice_allocator<U> const& other) : memory(other.memory), bytes(other.bytes) {}

  T* allocate(std::size_t n) {
    if (n * sizeof(T) > bytes) return std::allocator<T>().allocate(n);
    return reinterpret_cast<T*>(memory);
  }
  void deallocate(T* p, std::size_t n) {
    if (reinterpret_cast<std::byte*>(p) != memory) std::allocator<T>().deallocate(p, n);
  }
  template <class U>
  bool operator==(slice_allocator<U> const& other) const {
    return memory == other.memory;
  }
  template <class U>
  bool operator!=(slice_allocator<U> const& other) const {
    return !(*this == other);
  }
};

/// The workspace of one worker, in a part of a larger one, with the same tuning.
template <class Workspace>
struct worker_workspace : workspace<slice_allocator<std::byte>> {
  using tuning_type = typename find_tuning<Workspace>::type;
  using workspace<slice_allocator<std::byte>>::workspace;

  /// The bytes for arrays that take `bytes`: a workspace has up to two lines more, to align them.
  static constexpr std::size_t bytes_around(std::size_t bytes) {
    return bytes + 2 * workspace_alignment;
  }
};

}  // namespace deferred_shade::detail
