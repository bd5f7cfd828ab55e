// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deferred_shade/config.hpp>  // first: it refuses what is too old

#include <thrust/type_traits/is_execution_policy.h>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>

#include <deferred_shade/detail/fail.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/detail/workspace_memory.hpp>
#include <deferred_shade/types.hpp>
#ifdef __CUDACC__
#include <deferred_shade/cuda.hpp>
#endif

namespace deferred_shade {
namespace detail {

struct every_schedule;  // schedule.hpp

}  // namespace detail

/// Asks a workspace for an array of `count` elements of a trivial type. Throws std::length_error if
/// the array would take more than a sixteenth of the address space.
template <class T>
struct elements {
  explicit elements(std::size_t n) : count(n) {
    if (n > static_cast<std::size_t>(-1) / 16 / sizeof(T)) {
      detail::fail<std::length_error>("deferred_shade::elements: an array of " + std::to_string(n) +
                                      " elements has no room in memory");
    }
  }
  std::size_t count;

  static_assert(std::is_trivial_v<T>,
                "deferred_shade: elements of a workspace must be of a trivial type: it leaves them "
                "uninitialised");
  static_assert(alignof(T) <= detail::workspace_alignment,
                "deferred_shade: elements of a workspace must be aligned to at most 128 bytes");
};

/// Memory that schedules work in. It grows and never shrinks. A renderer that keeps one does not
/// allocate once the largest batch has passed, or from the start after `reserve`.
///
/// One workspace serves one `shade` at a time; on CUDA, also one stream at a time. `Allocator` is
/// any standard allocator, including Thrust's. Its memory must be accessible where `shade` runs.
/// CUDA policies use cuda_allocator, which allocates on the device that is current when the
/// workspace grows. Growing frees the old memory first. If your allocator does not wait for the
/// device as cudaFree does, reserve up front, or wait before it grows.
///
///     deferred_shade::workspace scratch{thrust::omp::par};
///     deferred_shade::workspace mine{my_allocator<std::byte>{pool}};
///
/// A renderer's own type may take its place. It needs these members, with the contracts that they
/// have here: `take(elements<T>...)`, which returns a tuple of pointers; `reserve(n, shaders)`; and
/// `begin_phase(phase) const`, which returns any object. If it has an `allocator_type`, `shade`
/// checks that the machine can reach its memory.
template <class Allocator = std::allocator<std::byte>>
class workspace {
  // The type is not over-aligned: some allocators ignore that. `aligned` does it.
  struct line {
    std::byte bytes[detail::workspace_alignment];
  };
  using traits = typename std::allocator_traits<Allocator>::template rebind_traits<line>;

 public:
  using allocator_type = Allocator;

  workspace() = default;
  explicit workspace(Allocator const& allocator) : allocator_(allocator) {}

  /// A workspace for the machine that a Thrust execution policy runs on. Nothing else of the policy
  /// is used, such as an allocator of its own.
  template <class Policy,
            class = std::enable_if_t<detail::thrust::is_execution_policy<Policy>::value &&
                                     std::is_default_constructible_v<Allocator>>>
  explicit workspace(Policy const&) {}

  workspace(workspace&& other) noexcept
      : allocator_(std::move(other.allocator_)),
        data_(std::exchange(other.data_, {})),
        lines_(std::exchange(other.lines_, 0)) {}
  // Not by swap: some allocators, those of std::pmr for example, cannot be assigned.
  workspace& operator=(workspace&& other) noexcept {
    if (this != &other) {
      this->~workspace();
      ::new (static_cast<void*>(this)) workspace(std::move(other));
    }
    return *this;
  }
  ~workspace() { release(); }

  /// Grows to the most that a schedule of the library takes, for batches of up to `n` requests over
  /// tables of up to `shaders` shaders. Throws std::length_error if `n` or `shaders` exceeds
  /// `max_requests`, and what the allocator throws. Needs schedule.hpp.
  template <class Schedules = detail::every_schedule>
  void reserve(std::size_t n, std::size_t shaders) {
    if (n > max_requests || shaders > max_requests) {
      detail::fail<std::length_error>(
          "deferred_shade::workspace::reserve: n is " + std::to_string(n) + " and shaders is " +
          std::to_string(shaders) + ", at most " + std::to_string(max_requests) + " are possible");
    }
    reserve_bytes(bytes_for<Schedules>(n, shaders));
  }

  /// Grows to `bytes`, such as `schedule.workspace_bytes(exec, n, shaders)` of one schedule. Throws
  /// what the allocator throws.
  void reserve_bytes(std::size_t bytes) { grow(bytes); }

  /// The bytes that `reserve(n, shaders)` grows to: the most that a schedule takes, on any machine
  /// that the memory may be for. Needs schedule.hpp.
  template <class Schedules = detail::every_schedule>
  static constexpr std::size_t bytes_for(std::size_t n, std::size_t shaders) noexcept {
    static_assert(detail::is_complete<Schedules>,
                  "deferred_shade: reserve and bytes_for ask every schedule what it takes; include "
                  "<deferred_shade/schedule.hpp>");
    std::size_t const on_host = Schedules::workspace_bytes(detail::host_system{}, n, shaders);
    if constexpr (detail::is_for_hosts_alone<Allocator>) {
      return on_host;
    } else {
      return (std::max)(on_host, Schedules::workspace_bytes(detail::cuda_system{}, n, shaders));
    }
  }

  /// The bytes held.
  std::size_t capacity() const noexcept { return lines_ * sizeof(line); }

  /// Gives a schedule arrays to work in, one for each argument, each aligned to 128 bytes.
  ///
  /// The arrays are uninitialised, and valid until the next call: a schedule asks once for all that
  /// it needs. Throws what the allocator throws, and stays usable.
  ///
  ///     auto const [keys, offsets] = scratch.take(elements<std::uint8_t>(n), elements<int>(m));
  template <class... T>
  std::tuple<T*...> take(elements<T>... arrays) {
    grow((detail::array_bytes<T>(arrays.count) + ... + 0));
    std::size_t used = 0;
    return {place(arrays, used)...};  // braces: from left to right
  }

  /// Does nothing, since no one observes: see `observed`.
  char begin_phase(phase const&) const noexcept { return 0; }

  /// Gives the memory back.
  void release() noexcept {
    if (lines_ != 0) traits::deallocate(allocator_, data_, lines_);
    data_ = {};
    lines_ = 0;
  }

 private:
  template <class T>
  T* place(elements<T> array, std::size_t& used) noexcept {
    std::byte* const first = aligned() + used;
    used += detail::array_bytes<T>(array.count);
    return reinterpret_cast<T*>(first);
  }

  // The memory may be the GPU's: nothing is read through the pointer, whatever its type.
  std::byte* aligned() const noexcept {
    if (lines_ == 0) return nullptr;
    auto const address = reinterpret_cast<std::uintptr_t>(detail::raw_pointer(data_));
    std::uintptr_t const past = address % detail::workspace_alignment;
    return reinterpret_cast<std::byte*>(address) +
           (past == 0 ? 0 : detail::workspace_alignment - past);
  }

  // Frees first: the memory of two batches need not fit side by side.
  void grow(std::size_t bytes) {
    if (bytes == 0) return;
    std::size_t const lines = (bytes + sizeof(line) - 1) / sizeof(line) + 1;  // one to align by
    if (lines <= lines_) return;
    release();
    data_ = traits::allocate(allocator_, lines);
    lines_ = lines;
  }

  typename traits::allocator_type allocator_{};
  typename traits::pointer data_{};
  std::size_t lines_ = 0;
};

namespace detail {

template <class System>
struct allocator_on {
  static_assert(
      !std::is_void_v<System>,
      "deferred_shade: a workspace must be made of an allocator or of an execution policy "
      "of Thrust's system cpp, omp, tbb or, in code for nvcc, cuda; pass thrust::omp::par, "
      "for example");
  using type = std::allocator<std::byte>;
};
#ifdef __CUDACC__
template <>
struct allocator_on<cuda_system> {
  using type = cuda_allocator<std::byte>;
};
#endif

// An allocator is taken as it is. A policy says which machine the memory is for.
template <class T, class = void>
struct allocator_for : allocator_on<system_of<T>> {};
template <class Allocator>
struct allocator_for<workspace<Allocator>> {
  using type = Allocator;
};
template <class T>
struct allocator_for<T, std::void_t<typename T::value_type>> {
  using type = T;
};

}  // namespace detail

// From an allocator, or from a Thrust execution policy.
template <class T>
workspace(T const&) -> workspace<typename detail::allocator_for<T>::type>;

}  // namespace deferred_shade
