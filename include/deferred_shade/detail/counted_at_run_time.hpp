// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thrust/iterator/transform_iterator.h>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <type_traits>

#include <deferred_shade/config.hpp>
#include <deferred_shade/detail/fail.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/types.hpp>

// Groupings are compiled for a number of shaders. If only the running program knows the number, one
// of a few sizes is taken that is large enough; the segments behind the last shader are empty.

namespace deferred_shade::detail {

/// An id of a table of `shaders`, or `shaders` itself: requests that name no shader get a segment.
struct id_or_none {
  shader_id shaders;

  template <class Id>
  DEFERRED_SHADE_HOST_DEVICE shader_id operator()(Id const& value) const {
    auto const id = static_cast<shader_id>(value);
    return id < shaders ? id : shaders;
  }
};

template <class Ids>
using ids_or_none = thrust::transform_iterator<id_or_none, Ids, shader_id, shader_id>;

/// The numbers of segments that an algorithm is compiled for, in ascending order.
template <shader_id... Sizes>
struct table_sizes {
  static constexpr std::size_t values[sizeof...(Sizes)] = {Sizes...};
  static constexpr std::size_t largest = values[sizeof...(Sizes) - 1];

  /// The first one that has room for `shaders` shaders and the requests that name none; the largest
  /// if none has.
  static constexpr std::size_t with_room_for(std::size_t shaders) {
    for (std::size_t const size : values) {
      if (shaders < size) return size;
    }
    return largest;
  }

  /// Calls `f(size)`, a std::integral_constant, with that one. Throws std::length_error if none has
  /// room.
  template <class Function>
  static grouping group(std::size_t shaders, Function const& f) {
    if (shaders >= largest) {
      detail::fail<std::length_error>(
          "deferred_shade::group: shader_count is " + std::to_string(shaders) +
          ", and this algorithm has room for at most " + std::to_string(largest - 1) + " shaders");
    }
    std::size_t const wanted = with_room_for(shaders);
    grouping result{};
    static_cast<void>(
        ((wanted == Sizes && (result = f(std::integral_constant<shader_id, Sizes>{}), true)) ||
         ...));
    return result;
  }
};

}  // namespace deferred_shade::detail
