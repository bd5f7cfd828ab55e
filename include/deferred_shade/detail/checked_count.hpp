// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>
#include <type_traits>

#include <deferred_shade/detail/fail.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade::detail {

template <class T>
inline constexpr bool is_device_count = false;
template <class Integer>
inline constexpr bool is_device_count<device_count<Integer>> = true;

/// `n` as a count of requests, for the function that `caller` names. Throws std::invalid_argument
/// if `n` is negative, std::length_error if it exceeds `max_requests`.
template <class Integer>
request_index checked_count(std::string const& caller, Integer n) {
  static_assert(std::is_integral_v<Integer> && !std::is_same_v<Integer, bool>,
                "deferred_shade: n must be an integer or a device_count");
  if constexpr (std::is_signed_v<Integer>) {
    if (n < 0) {
      detail::fail<std::invalid_argument>("deferred_shade::" + caller + ": n is " +
                                          std::to_string(n) +
                                          ", and a number of requests is not negative");
    }
  }
  if (static_cast<std::make_unsigned_t<Integer>>(n) > max_requests) {
    detail::fail<std::length_error>("deferred_shade::" + caller + ": n is " + std::to_string(n) +
                                    ", and a batch holds at most " + std::to_string(max_requests) +
                                    " requests: their indices have 32 bits");
  }
  return static_cast<request_index>(n);
}

/// The maximum of `n`. Throws std::invalid_argument if its pointer is null, std::length_error if
/// the maximum exceeds `max_requests`.
template <class Integer>
request_index checked_maximum(std::string const& caller, device_count<Integer> n) {
  if (n.pointer == nullptr) {
    detail::fail<std::invalid_argument>("deferred_shade::" + caller +
                                        ": the pointer of device_count is null");
  }
  return detail::checked_count(caller, n.maximum);
}

/// The count that `n` points at. Throws what checked_maximum and checked_count throw, and
/// std::length_error if the count exceeds its maximum.
template <class Integer>
request_index checked_count(std::string const& caller, device_count<Integer> n) {
  request_index const maximum = detail::checked_maximum(caller, n);
  request_index const count = detail::checked_count(caller, *n.pointer);
  if (count > maximum) {
    detail::fail<std::length_error>("deferred_shade::" + caller + ": device_count points at " +
                                    std::to_string(count) + " requests, above its maximum of " +
                                    std::to_string(maximum));
  }
  return count;
}

/// `n` as an algorithm gets it: the number itself if the host can see it, else a device_count.
/// Throws what checked_count and checked_maximum throw.
template <class System, class Count>
auto batch_size(System, std::string const& caller, Count n) {
  if constexpr (is_device_count<Count> && std::is_same_v<System, cuda_system>) {
    detail::checked_maximum(caller, n);
    return n;
  } else {
    return detail::checked_count(caller, n);
  }
}

/// Throws std::invalid_argument if the ids of a batch that may have requests are a null pointer.
template <class Count, class Ids>
void check_ids([[maybe_unused]] std::string const& caller, [[maybe_unused]] Count n,
               [[maybe_unused]] Ids const& ids) {
  if constexpr (std::is_pointer_v<Ids>) {
    if (ids == nullptr && detail::maximum_of(n) != 0) {
      detail::fail<std::invalid_argument>("deferred_shade::" + caller +
                                          ": ids is null, and n is not 0");
    }
  }
}

}  // namespace deferred_shade::detail
