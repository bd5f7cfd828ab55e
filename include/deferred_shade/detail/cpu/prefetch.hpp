// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <type_traits>

#include <deferred_shade/config.hpp>
#include <deferred_shade/detail/cpu/tuning.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade::detail {

/// Prefetches the cache line of pointer[i], to be read or written. Does nothing if `pointer` is not
/// a pointer. The address need not be valid. Always a read prefetch: write prefetches cannot target
/// the second-level cache.
template <cache_level To, class Pointer>
void prefetch([[maybe_unused]] Pointer const& pointer, [[maybe_unused]] request_index i) noexcept {
#if DEFERRED_SHADE_HAS_GNU
  if constexpr (To != cache_level::none && std::is_pointer_v<Pointer> &&
                std::is_object_v<std::remove_pointer_t<Pointer>>) {
    auto const address = reinterpret_cast<std::uintptr_t>(pointer) + sizeof(*pointer) * i;
    __builtin_prefetch(reinterpret_cast<void const*>(address), 0, static_cast<int>(To));
  }
#endif
}

}  // namespace deferred_shade::detail
