// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <deferred_shade/detail/cpu/block_partition.hpp>
#include <deferred_shade/detail/cpu/counting_sort.hpp>
#include <deferred_shade/detail/cpu/tuning.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/types.hpp>
#include <deferred_shade/workspace.hpp>

namespace deferred_shade::detail {

/// Calls `f(keys, first, size)` for the requests from `begin` to `end`, `Chunk` at a time, with
/// their keys, the index of the first one, and their number.
template <shader_id Shaders, std::size_t Chunk, class Ids, class Function>
void for_each_chunk(Ids const& ids, std::size_t begin, std::size_t end, Function const& f) {
  sort_key<Shaders> keys[Chunk];
  for (std::size_t i = begin; i < end; i += Chunk) {
    auto const first = static_cast<request_index>(i);
    auto const size = static_cast<request_index>((std::min)(Chunk, end - i));
    detail::load_keys<Shaders>(ids, first, size, keys);
    f(keys, first, size);
  }
}

constexpr std::size_t bucket_bytes(host_system, std::size_t n, std::size_t shaders) {
  return detail::array_bytes<request_index>(n) +
         detail::array_bytes<std::uint32_t>(block_partition::max_counters(n, shaders)) +
         detail::array_bytes<request_index>(shaders + 1);
}

/// Counts the keys of the requests from `begin` to `end`. Large tables are counted in `counts`
/// itself, because a worker's stack may be small.
template <shader_id Shaders, request_index Parts, std::size_t VectorBytes, class Ids>
void count_block(Ids const& ids, std::size_t begin, std::size_t end, std::uint32_t* counts) {
  if constexpr (Parts == 1 && VectorBytes == 0) {
    std::fill_n(counts, Shaders + 1, 0U);
    detail::for_each_chunk<Shaders, place_chunk>(
        ids, begin, end, [&](auto const* keys, request_index, request_index size) {
          for (request_index i = 0; i < size; ++i) ++counts[keys[i]];
        });
  } else {
    key_counts<Shaders, Parts, VectorBytes> of_block;
    detail::for_each_chunk<Shaders, VectorBytes != 0 ? compared_chunk : place_chunk>(
        ids, begin, end,
        [&](auto const* keys, request_index, request_index size) { of_block.add(keys, size); });
    for (shader_id k = 0; k <= Shaders; ++k) counts[k] = of_block.of(k);
  }
}

template <shader_id Shaders, class Policy, class Ids, class Workspace>
grouping bucket_grouping(host_system, Policy const& exec, request_index n, Ids ids,
                         Workspace& scratch) {
  using tuning = cpu_tuning_of<Workspace>;
  constexpr std::size_t compared = compared_bytes<Shaders, tuning>;
  constexpr request_index parts = compared != 0 ? 1 : tuning::counted_parts(Shaders);
  block_partition const blocks(n, Shaders);
  constexpr shader_id columns = Shaders + 1;
  auto const [permutation, counts, offsets] = scratch.take(
      elements<request_index>(n), elements<std::uint32_t>(blocks.max_count(n, Shaders) * columns),
      elements<request_index>(columns));

  detail::for_each_block(exec, blocks, [=, counts = counts](std::size_t b) {
    detail::count_block<Shaders, parts, compared>(ids, blocks.begin(b), blocks.end(b),
                                                  counts + b * columns);
  });
  detail::scan_columns(blocks, columns, counts, offsets);
  detail::for_each_block(exec, blocks,
                         [=, counts = counts, permutation = permutation](std::size_t b) {
                           detail::for_each_chunk<Shaders, place_chunk>(
                               ids, blocks.begin(b), blocks.end(b),
                               [&](auto const* keys, request_index first, request_index size) {
                                 detail::place_by_keys<tuning::ahead_of_places(Shaders)>(
                                     keys, size, first, counts + b * columns, permutation);
                               });
                         });
  return {permutation, offsets, n};
}

}  // namespace deferred_shade::detail
