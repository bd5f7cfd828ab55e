// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <deferred_shade/config.hpp>
#include <deferred_shade/types.hpp>

// Every size and threshold of the CUDA algorithms, and what decided it. Unless a line says
// otherwise, it was measured on an H200 (docs/design.md, "CUDA"; docs/results/h200-*.md). Needs no
// CUDA compiler: a workspace on the host asks for sizes as well.

namespace deferred_shade {

/// How a GPU groups a batch into buckets.
enum class bucket_algorithm {
  lanes,       ///< each shader has a lane of every warp: up to 32 shaders
  counters,    ///< a thread block has counters in shared memory: up to 511 shaders
  radix_sort,  ///< CUB's sort of (id, index) pairs: any number
};

/// How a GPU runs local_sort_then_dispatch.
enum class tile_algorithm {
  staged,   ///< records pass through shared memory: tables that common_records allows
  dense,    ///< small sorted tiles, run by a switch: up to 63 shaders
  rows,     ///< large sorted tiles, run in rows of 32 requests of one shader: up to 255 shaders
  bitonic,  ///< a bitonic sort of 256 requests, run by a switch: any number
};

namespace detail {

/// The threads of a warp, on every GPU of NVIDIA.
inline constexpr std::uint32_t warp_size = 32;

// Buckets. Each thread has 16 requests: two words hold their four-bit ids, and the tile is large
// enough to write each shader's requests in runs.
inline constexpr std::uint32_t bucket_threads = 256;
inline constexpr std::uint32_t bucket_items = 16;
inline constexpr std::uint32_t bucket_warps = bucket_threads / warp_size;
inline constexpr std::uint32_t bucket_tile = bucket_threads * bucket_items;

/// Whether a thread counts its requests in registers. Ids have four bits then, and one id is for
/// requests without a shader. 16 Mi requests of 11 shaders take 45 us instead of 55.
DEFERRED_SHADE_HOST_DEVICE constexpr bool counts_in_registers(shader_id shaders) {
  return shaders < 16;
}

/// Thread blocks of the place kernel on one multiprocessor: as many as registers allow without
/// spilling.
DEFERRED_SHADE_HOST_DEVICE constexpr std::uint32_t place_blocks(shader_id shaders) {
  return detail::counts_in_registers(shaders) ? 6 : 4;
}
/// The same for tables whose counters lie in shared memory.
inline constexpr std::uint32_t counter_place_blocks = 3;

/// Threads that scan the counts of one shader: the largest block, because a batch has only as many
/// such blocks as shaders.
inline constexpr std::uint32_t bucket_scan_threads = 1024;

/// A window is 32 tiles, 128 Ki requests: as many as fit in the second-level cache with what they
/// load and store. Half the size was 2 to 5 % slower at 8 Mi requests, twice the size 4 to 9 %
/// slower with random ids.
inline constexpr std::uint32_t window_tiles = 32;
inline constexpr std::uint32_t window_size = window_tiles * bucket_tile;

/// Moved arrays: a warp has so many rows of 32 places. Small elements need several rows, for enough
/// loads to be under way. With large ones, more places are under way than the second-level cache
/// holds, and neighbours that share a sector do not meet there.
inline constexpr std::uint32_t moved_threads = 256;
constexpr std::uint32_t moved_rows(std::size_t bytes) { return bytes < 32 ? 4 : 1; }

/// Threads per block of kernels that only copy or fill: any number does.
inline constexpr std::uint32_t copy_threads = 256;

/// The most threads per block in a launch of one shader, unless the shader sets another number. The
/// warps of a larger block wait longer for its last one before the next block takes its place.
inline constexpr int explicit_threads = 256;

/// The most bytes of a record that passes through shared memory: of larger ones, a multiprocessor
/// holds too few.
inline constexpr std::size_t largest_staged_record = 128;

/// The most shaders of a table that is staged. With more, a tile that fits in shared memory has too
/// few requests of each shader to fill its rows.
inline constexpr shader_id most_staged_shaders = 16;

}  // namespace detail

/// The choices of schedules on a GPU. A renderer may derive from it and change them for a call: see
/// `tuned`.
struct cuda_tuning {
  /// The algorithm of group_by_bucket for a table.
  static constexpr bucket_algorithm bucket(shader_id shaders) {
    if (shaders <= 32) return bucket_algorithm::lanes;      // a warp has as many lanes
    if (shaders <= 511) return bucket_algorithm::counters;  // shared memory has as many counters
    return bucket_algorithm::radix_sort;
  }

  /// The algorithm of local_sort_then_dispatch for a table. `records`: the table can be staged.
  static constexpr tile_algorithm tile(shader_id shaders, bool records) {
    if (shaders > 255) return tile_algorithm::bitonic;
    if (records) return tile_algorithm::staged;
    // Up to 8 index shaders are assumed to be short. Six simple shaders at random take 1.24 times
    // the oracle's time in dense tiles, 1.45 times in rows. Eleven moderate ones take 849 us, and
    // 266 us in windows.
    return shaders <= 8 ? tile_algorithm::dense : tile_algorithm::rows;
  }

  /// Whether window_sort_then_dispatch runs windows. Otherwise it groups the whole batch by
  /// buckets.
  static constexpr bool windows(shader_id shaders) { return shaders <= 32; }

  /// Threads per block of the switch over requests that are not grouped. The warps of a large block
  /// run the same shaders at about the same time, and share their instructions. Few index shaders
  /// are assumed to be short: small blocks make room for the next one sooner (six simple shaders:
  /// 1.47 instead of 1.52 times the oracle's time).
  static constexpr std::uint32_t switch_threads(shader_id shaders, bool records) {
    return shaders <= 8 && !records ? 128 : 256;
  }
  /// The same over a grouping.
  static constexpr std::uint32_t grouped_switch_threads = 256;

  /// Rows: the tile is the largest of which a multiprocessor holds two. All warps of a block then
  /// run the same shader at nearly the same time.
  static constexpr std::uint32_t tile_threads = 512;
  static constexpr std::uint32_t tile_items = 8;

  /// Dense tiles: one request for each thread, or four if the whole batch then runs at once.
  static constexpr std::uint32_t dense_threads = 256;
  static constexpr std::uint32_t dense_items = 4;

  /// Staged tiles: rows are full if each shader has many requests in a tile. For small tables,
  /// small tiles are enough, and more of them run at once: some load, some shade, some store.
  static constexpr std::uint32_t staged_threads(shader_id shaders) {
    return shaders <= 8 ? 128 : 512;
  }
  /// Requests for each thread, by the bytes that a request takes in shared memory.
  static constexpr std::uint32_t staged_items(std::size_t bytes) {
    return bytes > 16 ? static_cast<std::uint32_t>(128 / bytes) : 8;
  }

  /// Windows: the more shaders a table has, the more often blocks of a multiprocessor run different
  /// ones, and the larger blocks should be. With few shaders, smaller blocks fill it better.
  static constexpr std::uint32_t window_threads(shader_id shaders) {
    if (shaders <= 8) return 256;
    return shaders <= 16 ? 512 : 768;
  }
};

namespace detail {

template <class Workspace, class = void>
struct find_cuda_tuning {
  using type = cuda_tuning;
};
template <class Workspace>
struct find_cuda_tuning<Workspace, std::void_t<typename Workspace::tuning_type::cuda>> {
  using type = typename Workspace::tuning_type::cuda;
};
/// The tuning that a workspace carries: see `tuned`.
template <class Workspace>
using cuda_tuning_of = typename find_cuda_tuning<Workspace>::type;

}  // namespace detail
}  // namespace deferred_shade
