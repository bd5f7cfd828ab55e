// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

#include <deferred_shade/grouping/tile.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade {

/// Sorts and shades tile by tile: a tile is as many requests as one core's cache (or one
/// multiprocessor) holds, and one worker owns it. One launch, and no memory but the worker's own.
///
/// `Sort` is `counting`, the default, or `bitonic`.
template <class Sort = counting>
struct local_sort_then_dispatch;

/// A stable counting sort inside the tile, then one loop per shader over its requests.
template <>
struct local_sort_then_dispatch<counting> {
  template <class Policy, class Ids, class... Shaders, class Workspace>
  void operator()(Policy const& exec, request_index n, Ids ids,
                  shader_table<Shaders...> const& shaders, Workspace&) const {
    detail::for_each_tile<counting::tile>(
        exec, n, [ids, &shaders](request_index first, request_index size) {
          detail::sorted_tile<sizeof...(Shaders), counting::tile> tile;
          detail::counting_sort(ids, first, size, tile);
          shaders.for_each([&](auto id, auto const& shader) {
            for (std::uint32_t p = tile.offsets[id]; p < tile.offsets[id + 1]; ++p) {
              shader(first + tile.order[p]);
            }
          });
        });
  }
};

/// A bitonic sort inside the tile, then the switch. Schedule 7 of Hoberock et al., HPG 2009.
template <>
struct local_sort_then_dispatch<bitonic> {
  template <class Policy, class Ids, class... Shaders, class Workspace>
  void operator()(Policy const& exec, request_index n, Ids ids,
                  shader_table<Shaders...> const& shaders, Workspace&) const {
    // A key is the shader above the position in the tile, so that equal shaders keep their order.
    constexpr std::uint32_t tile = bitonic::tile;
    static_assert(sizeof...(Shaders) < 0xffffffffU / tile,
                  "a shader and a position fit in 32 bits");
    detail::for_each_tile<tile>(exec, n, [ids, &shaders](request_index first, request_index size) {
      std::uint32_t keys[tile];
      for (request_index i = 0; i < size; ++i) {
        keys[i] = shader_of(ids, first + i, sizeof...(Shaders)) * tile + i;
      }
      std::fill(keys + size, keys + tile, 0xffffffffU);
      detail::bitonic_sort(keys);
      for (request_index i = 0; i < size; ++i) shaders.run(keys[i] / tile, first + keys[i] % tile);
    });
  }
};

}  // namespace deferred_shade
