// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <deferred_shade/detail/cpu/block_partition.hpp>
#include <deferred_shade/detail/cpu/counting_sort.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/types.hpp>
#include <deferred_shade/workspace.hpp>

namespace deferred_shade::detail {

/// Calls `f(keys, first, size)` for the requests from `begin` to `end`, `Chunk` at a time: their
/// keys, the first of them, and their number.
template <shader_id Shaders, std::size_t Chunk, class Ids, class Function>
void for_each_chunk(Ids const& ids, std::size_t begin, std::size_t end, Function const& f) {
  sort_key<Shaders> keys[Chunk];
  for (std::size_t i = begin; i < end; i += Chunk) {
    auto const first = static_cast<request_index>(i);
    auto const size = static_cast<request_index>((std::min)(Chunk, end - i));
    load_keys<Shaders>(ids, first, size, keys);
    f(keys, first, size);
  }
}

// `Parts` depends on the instructions that a translation unit is compiled for. It is a part of the
// function's name, so that the linker takes no piece of it from another one.
template <shader_id Shaders,
          request_index Parts = are_compared<Shaders> ? 1 : parts_in_turn<Shaders>, class Policy,
          class Ids, class Workspace>
grouping bucket_grouping(host_system, Policy const& exec, request_index n, Ids ids,
                         Workspace& scratch) {
  block_partition const blocks(n, Shaders);
  constexpr shader_id columns = Shaders + 1;
  auto const [permutation, counts, offsets] = scratch.take(
      elements<request_index>(n), elements<std::uint32_t>(blocks.max_count(n, Shaders) * columns),
      elements<request_index>(columns));

  for_each_block(exec, blocks, [=, counts = counts](std::size_t b) {
    key_counts<Shaders, Parts> of_block;
    for_each_chunk<Shaders, are_compared<Shaders> ? 4096 : 512>(
        ids, blocks.begin(b), blocks.end(b),
        [&](auto const* keys, request_index, request_index size) { of_block.add(keys, size); });
    for (shader_id k = 0; k < columns; ++k) counts[b * columns + k] = of_block.of(k);
  });
  scan_columns(blocks, columns, counts, offsets);
  // The first-level cache has room for what lies ahead of so many shaders.
  constexpr cache ahead = Shaders <= 64 ? cache::first_level : cache::second_level;
  for_each_block(exec, blocks, [=, counts = counts, permutation = permutation](std::size_t b) {
    // Few keys at a time: the first-level cache is for the lines that are written.
    for_each_chunk<Shaders, 512>(ids, blocks.begin(b), blocks.end(b),
                                 [&](auto const* keys, request_index first, request_index size) {
                                   place_by_keys<ahead>(keys, size, first, counts + b * columns,
                                                        permutation);
                                 });
  });
  return {permutation, offsets, n};
}

}  // namespace deferred_shade::detail
