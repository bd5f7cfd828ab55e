// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstring>

#include <deferred_shade/config.hpp>

namespace deferred_shade::detail {

/// The address of `object`, even if its type overloads the operator &.
template <class T>
DEFERRED_SHADE_HOST_DEVICE constexpr T* address_of(T& object) noexcept {
  return __builtin_addressof(object);  // std::addressof is not a device function
}

/// The bits of `from` as another type. (Compilers keep the result of their builtin in registers.)
template <class To, class From>
DEFERRED_SHADE_HOST_DEVICE To bits_as(From const& from) noexcept {
  static_assert(sizeof(To) == sizeof(From),
                "deferred_shade: bits must be taken as a type of the same size");
#if DEFERRED_SHADE_HAS_GNU
  return __builtin_bit_cast(To, from);
#else
  To to;
  std::memcpy(static_cast<void*>(detail::address_of(to)), detail::address_of(from), sizeof(To));
  return to;
#endif
}

}  // namespace deferred_shade::detail
