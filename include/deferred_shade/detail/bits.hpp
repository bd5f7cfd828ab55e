// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstring>

#include <deferred_shade/config.hpp>

namespace deferred_shade::detail {

/// The bits of `from` as another type. (Compilers keep what their builtin makes in registers.)
template <class To, class From>
DEFERRED_SHADE_HOST_DEVICE To bits_as(From const& from) noexcept {
  static_assert(sizeof(To) == sizeof(From));
#if DEFERRED_SHADE_HAS_GNU
  return __builtin_bit_cast(To, from);
#else
  To to;
  std::memcpy(static_cast<void*>(&to), &from, sizeof(To));
  return to;
#endif
}

}  // namespace deferred_shade::detail
