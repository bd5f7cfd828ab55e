// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <deferred_shade/detail/cpu/counting_sort.hpp>
#include <deferred_shade/detail/cpu/parallel_for.hpp>
#include <deferred_shade/detail/cpu/segment.hpp>
#include <deferred_shade/detail/cpu/tuning.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/detail/tile_sorts.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade::detail {

/// Calls `f(first, size)` for every tile of `n` requests, spread over the workers of `exec`.
template <request_index Tile, class Policy, class Function>
void for_each_tile(Policy const& exec, request_index n, Function f) {
  std::size_t const tiles = (std::size_t{n} + Tile - 1) / Tile;
  detail::parallel_for(exec, tiles, [n, f](std::size_t t) {
    auto const first = static_cast<request_index>(t * Tile);
    f(first, (std::min)(Tile, n - first));
  });
}

/// The requests of one tile in the order of their shaders. Those of shader k are
/// `order[offsets[k]]` to `order[offsets[k + 1] - 1]`, as distances from the first request of the
/// tile.
template <shader_id Shaders, request_index Tile>
struct sorted_tile {
  static_assert(Tile <= 65536, "deferred_shade: a position in a tile must fit in 16 bits");
  std::uint16_t order[Tile];
  std::uint32_t offsets[Shaders + 2];
};

/// Sorts the `size` requests from `first` on by a stable counting sort. Not inlined: its stack
/// frame is gone when shaders run.
template <class Tuning, shader_id Shaders, request_index Tile, class Ids>
DEFERRED_SHADE_NOINLINE void counting_sort(Ids const& ids, request_index first, request_index size,
                                           sorted_tile<Shaders, Tile>& result) {
  sort_key<Shaders> keys[Tile];
  detail::load_keys<Shaders>(ids, first, size, keys);
  key_counts<Shaders, Tuning::counted_parts(Shaders), compared_bytes<Shaders, Tuning>> counts;
  counts.add(keys, size);
  // `next[k]` is `offsets[k + 1]`: when all requests are placed, it is where those of shader k end.
  std::uint32_t* const next = result.offsets + 1;
  result.offsets[0] = next[0] = 0;
  for (shader_id k = 0; k < Shaders; ++k) next[k + 1] = next[k] + counts.of(k);
  if (detail::quarters_same(keys, size) >= 3) {
    detail::place_by_keys<cache_level::none>(keys, size, std::uint16_t{0}, next, result.order);
  } else {
    counts.place(keys, size, std::uint16_t{0}, next, result.order);
  }
}

/// The end of the stretch of requests from `begin` on that name the same shader, at most `end`.
template <class Ids>
request_index end_of_stretch(Ids const& ids, request_index begin, request_index end,
                             shader_id none) {
  constexpr request_index step = 32;  // at a time, in a loop that compilers vectorise
  shader_id const id = detail::shader_of(ids, begin, none);
  for (; end - begin >= step; begin += step) {
    Ids const here = detail::ids_from(ids, begin);
    shader_id differences = 0;
    for (request_index i = 0; i < step; ++i) differences |= detail::shader_of(here, i, none) ^ id;
    if (differences != 0) break;
  }
  while (begin < end && detail::shader_of(ids, begin, none) == id) ++begin;
  return begin;
}

/// Runs a tile unsorted if neighbours mostly name the same shader: sorting gains little then.
/// Returns whether it did.
template <class Tuning, class Ids, class... Shaders>
bool run_long_stretches(Ids const& ids, request_index first, request_index size,
                        shader_table<Shaders...> const& shaders) {
  constexpr shader_id none = sizeof...(Shaders);
  constexpr request_index long_stretch = Tuning::long_stretch;
  request_index const end = first + size;
  request_index ends[Tuning::tile / long_stretch + 1], stretches = 0;
  for (request_index begin = first; begin < end; begin = ends[stretches++]) {
    if (stretches > size / long_stretch) return false;
    ends[stretches] = detail::end_of_stretch(ids, begin, end, none);
  }
  for (request_index k = 0, begin = first; k < stretches; begin = ends[k++]) {
    shaders.visit(detail::shader_of(ids, begin, none), [&](auto const& shader) {
      detail::run_segment(
          shader, ends[k] - begin,
          [begin](std::size_t j) { return begin + static_cast<request_index>(j); },
          [](std::size_t) {});
    });
  }
  return true;
}

/// Sorts `Size` keys, a power of two, by Batcher's bitonic network ("Sorting networks and their
/// applications", AFIPS 1968). It makes the same comparisons for every input: lanes never diverge.
template <std::size_t Size>
void bitonic_sort(std::uint32_t (&keys)[Size]) {
  static_assert((Size & (Size - 1)) == 0,
                "deferred_shade: a bitonic network must have a power of two of keys");
  for (std::size_t run = 2; run <= Size; run *= 2) {
    for (std::size_t distance = run / 2; distance > 0; distance /= 2) {
      for (std::size_t base = 0; base < Size; base += 2 * distance) {
        bool const ascending = (base & run) == 0;
        for (std::size_t i = base; i < base + distance; ++i) {
          std::uint32_t const low = (std::min)(keys[i], keys[i + distance]);
          std::uint32_t const high = (std::max)(keys[i], keys[i + distance]);
          keys[i] = ascending ? low : high;
          keys[i + distance] = ascending ? high : low;
        }
      }
    }
  }
}

/// Sorts every tile by the network and runs its requests by a switch.
template <class Policy, class Ids, class... Shaders, class Workspace>
void run_tiles(host_system, bitonic, Policy const& exec, request_index n, Ids ids,
               shader_table<Shaders...> const& shaders, Workspace const&) {
  detail::for_each_tile<bitonic::tile>(
      exec, n, [ids, &shaders](request_index first, request_index size) {
        std::uint32_t keys[bitonic::tile];
        for (request_index i = 0; i < size; ++i) {
          keys[i] = detail::bitonic_key<sizeof...(Shaders)>(
              detail::shader_of(ids, first + i, sizeof...(Shaders)), i);
        }
        std::fill(keys + size, keys + bitonic::tile, 0xffffffffU);
        detail::bitonic_sort(keys);
        for (request_index i = 0; i < size; ++i) {
          shaders.run(keys[i] / bitonic::tile, first + keys[i] % bitonic::tile);
        }
      });
}

/// Sorts every tile by counting and runs its requests shader by shader.
template <class Tuning, class Policy, class Ids, class... Shaders>
void run_counted_tiles(Policy const& exec, request_index n, Ids ids,
                       shader_table<Shaders...> const& shaders) {
  detail::for_each_tile<Tuning::tile>(
      exec, n, [n, ids, &shaders](request_index first, request_index size) {
        if (detail::run_long_stretches<Tuning>(ids, first, size, shaders)) return;
        sorted_tile<sizeof...(Shaders), Tuning::tile> tile;
        detail::counting_sort<Tuning>(ids, first, size, tile);
        // Prefetches the next tile, which mostly is the same worker's, in memory order.
        std::size_t next = std::size_t{first} + size;
        shaders.for_each([&](auto id, auto const& shader) {
          std::uint16_t const* const order = tile.order + tile.offsets[id];
          std::size_t const count = tile.offsets[id + 1] - tile.offsets[id];
          detail::run_segment(
              shader, count, [=](std::size_t j) { return first + order[j]; },
              [n, next, &shaders](std::size_t j) {
                if (next + j >= n) return;
                detail::prefetch_records(
                    shaders.template get<shader_table<Shaders...>::first_id()>(),
                    static_cast<request_index>(next + j));
              });
          next += count;
        });
      });
}

/// Runs every tile by the sort that tuning chooses.
template <class Policy, class Ids, class... Shaders, class Workspace>
void run_tiles(host_system here, counting, Policy const& exec, request_index n, Ids ids,
               shader_table<Shaders...> const& shaders, Workspace const& scratch) {
  using tuning = cpu_tuning_of<Workspace>;
  if constexpr (tuning::counts_tiles(sizeof...(Shaders))) {
    detail::run_counted_tiles<tuning>(exec, n, ids, shaders);
  } else {
    detail::run_tiles(here, bitonic{}, exec, n, ids, shaders, scratch);
  }
}

/// On a CPU, windows are the tiles, for tables of any size. They take no workspace.
constexpr std::size_t window_bytes(host_system, std::size_t, std::size_t) { return 0; }

template <class Workspace>
constexpr bool has_windows(host_system, shader_id) {
  return true;
}

template <class Policy, class Ids, class... Shaders, class Workspace>
void run_windows(host_system here, Policy const& exec, request_index n, Ids ids,
                 shader_table<Shaders...> const& shaders, Workspace& scratch) {
  [[maybe_unused]] auto const dispatched = scratch.begin_phase({"dispatch"});
  detail::run_tiles(here, counting{}, exec, n, ids, shaders, scratch);
}

}  // namespace deferred_shade::detail
