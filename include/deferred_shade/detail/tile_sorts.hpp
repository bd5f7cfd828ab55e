// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <deferred_shade/config.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade {

/// Sorts a tile with a stable counting sort: see local_sort_then_dispatch.
struct counting {};

/// Sorts a tile with a bitonic sorting network: see local_sort_then_dispatch.
struct bitonic {
  /// Requests in a tile, a power of two: the thread block of Hoberock et al., HPG 2009.
  static constexpr request_index tile = 256;
};

namespace detail {

/// A key to sort a tile by: the shader above the position in the tile. Requests of one shader keep
/// their order. The largest number is no key.
template <shader_id Shaders>
DEFERRED_SHADE_HOST_DEVICE constexpr std::uint32_t bitonic_key(shader_id shader,
                                                               request_index position) {
  static_assert(
      Shaders < 0xffffffffU / bitonic::tile,
      "deferred_shade: a shader and a position in a tile must fit in 32 bits; take fewer shaders");
  return shader * bitonic::tile + position;
}

}  // namespace detail
}  // namespace deferred_shade
