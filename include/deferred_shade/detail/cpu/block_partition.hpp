// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>

#include <deferred_shade/detail/cpu/parallel_for.hpp>
#include <deferred_shade/detail/cpu/tuning.hpp>

namespace deferred_shade::detail {

static_assert(
    sizeof(std::size_t) >= 8,
    "deferred_shade: std::size_t must have 64 bits, in which sizes of batches are computed; "
    "compile for a 64-bit target");

/// A batch of n requests, cut into blocks of equal size, except for the last one. One worker owns a
/// block at a time.
///
/// Each block has a row of `shaders` + 1 counters: at most one for every 16 requests of the block.
/// There are never more than 1024 blocks. Their size is a multiple of `granule`: with 64, blocks of
/// one array share no cache line.
class block_partition {
 public:
  constexpr block_partition(std::size_t n, std::size_t shaders, std::size_t granule = 64) noexcept
      : n_(n),
        size_(multiple_of(granule,
                          (std::max)(least_size(shaders), (n + most_blocks - 1) / most_blocks))),
        count_((n + size_ - 1) / size_) {}

  /// An upper bound of count(), for any granule, that does not fall when n grows. Arrays are
  /// allocated for it.
  static constexpr std::size_t max_count(std::size_t n, std::size_t shaders) noexcept {
    std::size_t const least = least_size(shaders);
    return (std::min)(most_blocks, (n + least - 1) / least);
  }

  /// An upper bound of (max_count(n, s) + 1) * (s + 1), for any s up to `shaders`. Tables of more
  /// than 1023 shaders have larger blocks, with about n / 16 counters and one row at most.
  static constexpr std::size_t max_counters(std::size_t n, std::size_t shaders) noexcept {
    std::size_t const few = (std::min)(shaders, least_block / requests_per_counter - 1);
    return (max_count(n, 0) + 1) * (few + 2) +
           (shaders > few ? n / requests_per_counter + 2 * shaders + 4 : 0);
  }

  constexpr std::size_t size() const noexcept { return size_; }
  constexpr std::size_t count() const noexcept { return count_; }
  constexpr std::size_t begin(std::size_t block) const noexcept { return block * size_; }
  constexpr std::size_t end(std::size_t block) const noexcept {
    return (std::min)(n_, (block + 1) * size_);
  }

 private:
  static constexpr std::size_t multiple_of(std::size_t granule, std::size_t x) noexcept {
    return (x + granule - 1) / granule * granule;
  }
  static constexpr std::size_t least_size(std::size_t shaders) noexcept {
    return multiple_of(64, (std::max)(least_block, requests_per_counter * (shaders + 1)));
  }

  std::size_t n_;
  std::size_t size_;
  std::size_t count_;
};

/// Calls `f(block)` for every block, spread over the workers of `exec`.
template <class Policy, class Function>
void for_each_block(Policy const& exec, block_partition const& blocks, Function f) {
  detail::parallel_for(exec, blocks.count(), f);
}

/// Turns counts into places, for elements ordered by column, then by block.
/// `counts[b * columns + k]` is the number of elements of column k in block b, and becomes the
/// position of the first of them. `offsets[k]` becomes the position of the first element of column
/// k.
inline void scan_columns(block_partition const& blocks, std::uint32_t columns,
                         std::uint32_t* counts, std::uint32_t* offsets) {
  std::fill_n(offsets, columns, 0U);
  for (std::size_t b = 0; b < blocks.count(); ++b) {
    std::uint32_t const* const row = counts + b * columns;
    for (std::uint32_t k = 0; k < columns; ++k) offsets[k] += row[k];
  }
  std::exclusive_scan(offsets, offsets + columns, offsets, 0U);
  // `offsets[k]` grows as each block takes its share, up to the start of column k + 1.
  for (std::size_t b = 0; b < blocks.count(); ++b) {
    std::uint32_t* const row = counts + b * columns;
    for (std::uint32_t k = 0; k < columns; ++k) {
      std::uint32_t const count = row[k];
      row[k] = offsets[k];
      offsets[k] += count;
    }
  }
  std::copy_backward(offsets, offsets + columns - 1, offsets + columns);
  offsets[0] = 0;
}

}  // namespace deferred_shade::detail
