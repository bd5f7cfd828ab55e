// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <type_traits>
#include <utility>

namespace deferred_shade::detail {

/// Whether this type is one of shader ids.
template <class Id>
inline constexpr bool is_id =
    sizeof(Id) <= sizeof(std::uint32_t) &&
    !std::is_volatile_v<Id> && std::disjunction_v<std::is_integral<Id>, std::is_enum<Id>>;

/// The largest id that the type has; none is negative.
template <class Id>
constexpr std::uint64_t largest_id() {
  if constexpr (std::is_enum_v<Id>) {
    return detail::largest_id<std::underlying_type_t<Id>>();
  } else {
    return static_cast<std::uint64_t>((std::numeric_limits<Id>::max)());
  }
}

/// std::iterator_traits, which does not compile for void pointers.
struct no_iterator {};
template <class T>
using traits_of_ids = std::conditional_t<
    std::is_pointer_v<T> && !std::is_object_v<std::remove_pointer_t<T>>, no_iterator,
    std::iterator_traits<std::conditional_t<std::is_void_v<std::remove_pointer_t<T>>, int*, T>>>;

/// Whether ids[i] can be read.
template <class Ids, class = void>
inline constexpr bool has_ids = false;
template <class Ids>
inline constexpr bool has_ids<
    Ids, std::void_t<decltype(static_cast<typename traits_of_ids<Ids>::value_type>(
                         std::declval<Ids const&>()[std::declval<
                             typename traits_of_ids<Ids>::difference_type const&>()])),
                     decltype(std::declval<Ids const&>() +
                              std::declval<typename traits_of_ids<Ids>::difference_type>())>> =
    true;

template <class Ids>
constexpr bool are_ids() {
  if constexpr (has_ids<Ids>) {
    return is_id<typename traits_of_ids<Ids>::value_type>;
  } else {
    return true;
  }
}

/// What the library asks of an iterator of ids. Every function that takes one checks this first. If
/// it is not met, nothing else is compiled: the first error is the only one. (Assertions come last
/// in a class, because clang stops at them.)
template <class Ids>
struct requirements_of_ids {
  static constexpr bool met = has_ids<Ids> && are_ids<Ids>();
  using value = std::bool_constant<met>;  // makes clang compute it here

  static_assert(has_ids<Ids>,
                "deferred_shade: ids must be a random-access iterator over shader ids; pass "
                "ids.data() or ids.begin() of a container");
  static_assert(are_ids<Ids>(),
                "deferred_shade: a shader id must be an integer or an enumeration of at most 32 "
                "bits, and not volatile; pass an iterator over such a type");
};

/// The largest id that an iterator gives.
template <class Ids>
constexpr std::uint64_t largest_id_of() {
  return detail::largest_id<std::remove_cv_t<typename traits_of_ids<Ids>::value_type>>();
}

/// Which of the ids 0 to `Size` - 1 a list has, how many these are, and whether it has no other id.
/// Uses loops, because clang limits folds to 256 operands.
template <std::size_t Size>
struct listed_ids {
  bool has[Size] = {};
  std::size_t count = 0;
  bool fit = true;

  template <std::uint32_t... Ids>
  static constexpr listed_ids of() {
    listed_ids result;
    std::uint32_t const list[] = {Ids..., 0};
    for (std::size_t j = 0; j < sizeof...(Ids); ++j) {
      std::uint32_t const id = list[j];
      if (id >= Size) {
        result.fit = false;
      } else if (!result.has[id]) {
        result.has[id] = true;
        ++result.count;
      }
    }
    return result;
  }
};

}  // namespace deferred_shade::detail
