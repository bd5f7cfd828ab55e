// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>

// What workspaces, and those who compute their size, know of memory and allocators.

namespace deferred_shade::detail {

template <class T, class = void>
inline constexpr bool is_complete = false;
template <class T>
inline constexpr bool is_complete<T, std::void_t<decltype(sizeof(T))>> = true;

// Memory of std::allocator is never a GPU's; memory of others may be.
template <class Allocator>
inline constexpr bool is_for_hosts_alone = false;
template <class T>
inline constexpr bool is_for_hosts_alone<std::allocator<T>> = true;

inline constexpr std::size_t workspace_alignment = 128;

/// The plain pointer of an allocator's pointer: itself, or what its get() (as Thrust's) or
/// operator->() returns.
template <class Pointer, class = void>
inline constexpr bool has_get = false;
template <class Pointer>
inline constexpr bool
    has_get<Pointer, std::void_t<decltype(std::declval<Pointer const&>().get())>> = true;
template <class Pointer>
void* raw_pointer(Pointer const& pointer) {
  if constexpr (std::is_pointer_v<Pointer>) {
    return static_cast<void*>(pointer);
  } else if constexpr (has_get<Pointer>) {
    return static_cast<void*>(pointer.get());
  } else {
    return static_cast<void*>(pointer.operator->());
  }
}

/// The bytes of workspace that an array of `count` elements takes.
template <class T>
constexpr std::size_t array_bytes(std::size_t count) noexcept {
  return (count * sizeof(T) + workspace_alignment - 1) / workspace_alignment * workspace_alignment;
}

/// The allocator type of a workspace, or void if it names none.
template <class T, class = void>
struct allocator_of {
  using type = void;
};
template <class T>
struct allocator_of<T, std::void_t<typename T::allocator_type>> {
  using type = typename T::allocator_type;
};

}  // namespace deferred_shade::detail
