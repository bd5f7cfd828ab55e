// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>

#include <deferred_shade/detail/cpu/block_partition.hpp>
#include <deferred_shade/detail/cpu/counting_sort.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/types.hpp>
#include <deferred_shade/workspace.hpp>

namespace deferred_shade::detail {

/// Keys and the indices that are sorted with them.
template <class Key>
struct key_pairs {
  Key* keys;
  request_index* indices;
};

/// One pass of a radix sort: puts `size` pairs in the order of one byte of their keys, stably.
template <class Key>
void sort_by_byte(key_pairs<Key> from, key_pairs<Key> to, std::size_t size, int byte) {
  auto const digit = [byte](Key key) { return static_cast<std::size_t>(key >> 8 * byte & 0xff); };
  std::uint32_t next[257] = {};
  for (std::size_t i = 0; i < size; ++i) ++next[digit(from.keys[i]) + 1];
  std::partial_sum(next, next + 257, next);
  for (std::size_t i = 0; i < size; ++i) {
    std::uint32_t const place = next[digit(from.keys[i])]++;
    to.keys[place] = from.keys[i];
    to.indices[place] = from.indices[i];
  }
}

/// The bytes that hold the keys 0 to `largest`; each takes a pass.
constexpr int radix_passes(std::uint32_t largest) {
  return largest <= 0xff ? 1 : largest <= 0xffff ? 2 : largest <= 0xffffff ? 3 : 4;
}

/// Makes sorted pairs of the `size` requests from `first` on, in `sorted`. `other` is a buffer of
/// the same size.
template <shader_id Shaders, class Key, class Ids>
void sort_block(Ids const& ids, request_index first, std::size_t size, key_pairs<Key> sorted,
                key_pairs<Key> other) {
  constexpr int passes = detail::radix_passes(Shaders);
  key_pairs<Key> from = passes % 2 == 0 ? sorted : other;
  key_pairs<Key> to = passes % 2 == 0 ? other : sorted;
  detail::load_keys<Shaders>(detail::ids_from(ids, first), size, from.keys);
  std::iota(from.indices, from.indices + size, first);
  for (int byte = 0; byte < passes; ++byte) {
    detail::sort_by_byte(from, to, size, byte);
    std::swap(from, to);
  }
}

/// row[k] becomes the number of keys that are k.
template <shader_id Shaders, class Key>
void count_runs(Key const* keys, std::size_t size, std::uint32_t* row) {
  Key const* run = keys;
  for (shader_id k = 0; k <= Shaders; ++k) {
    auto const end = std::upper_bound<Key const*>(run, keys + size, static_cast<Key>(k));
    row[k] = static_cast<std::uint32_t>(end - run);
    run = end;
  }
}

constexpr std::size_t radix_bytes(host_system, std::size_t n, std::size_t shaders) {
  std::size_t const key = shaders <= 0xff ? 1 : shaders <= 0xffff ? 2 : 4;
  return 3 * detail::array_bytes<request_index>(n) + 2 * detail::array_bytes<std::byte>(n * key) +
         detail::array_bytes<std::uint32_t>(block_partition::max_counters(n, shaders)) +
         detail::array_bytes<request_index>(shaders + 1);
}

template <shader_id Shaders, class Policy, class Ids, class Workspace>
grouping radix_grouping(host_system, Policy const& exec, request_index n, Ids ids,
                        Workspace& scratch) {
  using key = sort_key<Shaders>;
  block_partition const blocks(n, Shaders);
  constexpr shader_id columns = Shaders + 1;
  auto const [permutation, keys, indices, other_keys, other_indices, counts, offsets] =
      scratch.take(elements<request_index>(n), elements<key>(n), elements<request_index>(n),
                   elements<key>(n), elements<request_index>(n),
                   elements<std::uint32_t>(blocks.max_count(n, Shaders) * columns),
                   elements<request_index>(columns));
  key_pairs<key> const sorted{keys, indices};
  key_pairs<key> const other{other_keys, other_indices};

  detail::for_each_block(exec, blocks, [=, counts = counts](std::size_t b) {
    std::size_t const begin = blocks.begin(b);
    std::size_t const size = blocks.end(b) - begin;
    key* const first = sorted.keys + begin;
    detail::sort_block<Shaders>(ids, static_cast<request_index>(begin), size,
                                key_pairs<key>{first, sorted.indices + begin},
                                key_pairs<key>{other.keys + begin, other.indices + begin});
    detail::count_runs<Shaders>(first, size, counts + b * columns);
  });
  detail::scan_columns(blocks, columns, counts, offsets);
  detail::for_each_block(
      exec, blocks,
      [=, permutation = permutation, counts = counts, offsets = offsets](std::size_t b) {
        std::uint32_t const* const row = counts + b * columns;
        request_index const* run = sorted.indices + blocks.begin(b);
        for (shader_id k = 0; k < Shaders; ++k) {
          // The run ends where the next block's begins, or at the end of the segment.
          std::uint32_t const end = b + 1 < blocks.count() ? row[columns + k] : offsets[k + 1];
          std::copy_n(run, end - row[k], permutation + row[k]);
          run += end - row[k];
        }
      });
  return {permutation, offsets, n};
}

}  // namespace deferred_shade::detail
