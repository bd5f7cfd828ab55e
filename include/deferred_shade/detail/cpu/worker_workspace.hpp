// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>

#include <deferred_shade/detail/workspace_memory.hpp>
#include <deferred_shade/observer.hpp>
#include <deferred_shade/workspace.hpp>

namespace deferred_shade::detail {

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
