// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>
#include <type_traits>

#include <deferred_shade/config.hpp>
#include <deferred_shade/detail/checked_count.hpp>
#include <deferred_shade/detail/fail.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade::detail {

template <class Policy, class... T>
inline constexpr bool can_move = has_system<Policy> && (is_copied_by_bytes<T> && ... && true);

/// What `gather` and `scatter` ask of their arguments.
template <class Policy, class... T>
void check_moved(std::string const& caller, request_order order, moved<T>... arrays) {
  static_cast<void>(requirements_of_exec<Policy>());
  static_assert((is_copied_by_bytes<T> && ... && true),
                "deferred_shade: elements of a moved array must be trivially copyable; specialise "
                "is_copied_by_bytes for a type whose copy constructor only copies its bytes");
  detail::checked_maximum(caller, order.n);
  if (order.n.maximum == 0) return;
  if (order.permutation == nullptr || ((arrays.from == nullptr || arrays.to == nullptr) || ...)) {
    detail::fail<std::invalid_argument>("deferred_shade::" + caller +
                                        ": the permutation or an array is null");
  }
  if (!((arrays.from != arrays.to) && ...)) {  // clang warns of == for a single array
    detail::fail<std::invalid_argument>("deferred_shade::" + caller +
                                        ": an array must not be moved to itself; keep it twice");
  }
}

}  // namespace deferred_shade::detail
