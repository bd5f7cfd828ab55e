// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>

#include <deferred_shade/detail/checked_count.hpp>
#include <deferred_shade/detail/cpu/parallel_for.hpp>
#include <deferred_shade/detail/cpu/tuning.hpp>
#include <deferred_shade/detail/moved.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade::detail {

/// Moves the elements at the places from `begin` to `end` of an order. (Not inline: g++ would warn
/// of places that arrays of a known length do not have.)
template <bool Scatter, class T>
DEFERRED_SHADE_NOINLINE void move_elements(request_index const* permutation, std::size_t begin,
                                           std::size_t end, moved<T> array) {
  for (std::size_t p = begin; p < end; ++p) {
    std::size_t const i = permutation[p];
    T const* const from = array.from + (Scatter ? p : i);
    T* const to = array.to + (Scatter ? i : p);
    std::memcpy(static_cast<void*>(to), static_cast<void const*>(from), sizeof(T));
  }
}

/// Array by array for some places at a time: their part of the permutation stays in the cache.
template <bool Scatter, class Policy, class... T>
void move_arrays(host_system, Policy const& exec, request_order order, moved<T>... arrays) {
  std::size_t const n = detail::checked_count(Scatter ? "scatter" : "gather", order.n);
  std::size_t const chunks = (n + moved_chunk - 1) / moved_chunk;
  detail::parallel_for(exec, chunks, [=](std::size_t c) {
    std::size_t const begin = c * moved_chunk;
    std::size_t const end = (std::min)(n, begin + moved_chunk);
    (detail::move_elements<Scatter>(order.permutation, begin, end, arrays), ...);
  });
}

}  // namespace deferred_shade::detail
