// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <type_traits>

#include <deferred_shade/config.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade::detail {

/// Brings what lies at pointer[i] near to this core, or the place for what will be written there.
/// Knows pointers only; the address need not be valid.
template <bool Write, class Pointer>
void prefetch(Pointer const& pointer, request_index i) noexcept {
#if DEFERRED_SHADE_HAS_GNU
  if constexpr (std::is_pointer_v<Pointer>) {
    using record = std::remove_pointer_t<Pointer>;
    if constexpr (std::is_object_v<record>) {
      auto const address = reinterpret_cast<std::uintptr_t>(pointer) + sizeof(record) * i;
      __builtin_prefetch(reinterpret_cast<void const*>(address), Write, 2);
    }
  }
#endif
  static_cast<void>(pointer);
  static_cast<void>(i);
}

}  // namespace deferred_shade::detail
