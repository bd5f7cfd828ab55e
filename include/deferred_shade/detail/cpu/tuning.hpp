// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <deferred_shade/config.hpp>
#include <deferred_shade/types.hpp>

// Every size and threshold of the algorithms for CPUs, and what decided it. Measured on a Xeon of
// two cores and an EPYC with AVX2 and AVX-512 (docs/design.md, "Vectors on CPUs" and "Grouping on a
// CPU"; docs/results/cpu.md).

namespace deferred_shade {

/// The cache of a core to prefetch into, by the numbers of __builtin_prefetch.
enum class cache_level { none, second_level = 2, first_level = 3 };

namespace detail {

// Blocks. A worker owns one at a time.
/// Requests in a block, at least: a parallel loop over blocks then costs little beside their work.
inline constexpr std::size_t least_block = 16384;
/// Blocks in a batch, at most: with more, the scan over their counters, which one worker does,
/// takes noticeable time.
inline constexpr std::size_t most_blocks = 1024;
/// Requests of a block for each of its counters, at least: it bounds the cost of the scan.
inline constexpr std::size_t requests_per_counter = 16;

// Loops over requests.
/// Up to this many requests run without a parallel region, which takes five microseconds with
/// OpenMP. As many as the smallest chunk of a segment.
inline constexpr std::size_t serial_requests = 32;
/// TBB's workers take the next chunk that is left. A chunk has at most this many requests, and a
/// large batch about this many chunks or more.
inline constexpr std::size_t largest_chunk = 4096;
inline constexpr std::size_t chunks_by_tbb = 1024;

// Records in vectors. Those that are packed together take, with their results, at most half of a
// first-level cache of 32 KiB. They are at most 256: more gain nothing.
inline constexpr std::size_t packed_bytes = 16384;
inline constexpr std::size_t most_packed = 256;

/// A segment of fewer requests is launched in small chunks, to give every worker some.
inline constexpr std::size_t small_segment = 16384;
inline constexpr std::size_t small_chunk = 32;

/// Items that a worker of depth_first takes at a time.
inline constexpr std::size_t items_at_a_time = 64;

/// The places of an order whose elements are moved at a time: their part of the permutation takes
/// half of a first-level cache of 32 KiB.
inline constexpr std::size_t moved_chunk = 4096;

/// Keys that are counted at a time by comparing vectors.
inline constexpr std::size_t compared_chunk = 4096;
/// Keys that are counted one by one, or put to their places, at a time: the first-level cache is
/// for the lines that are written (16 Mi requests of 256 shaders: 1.24 ns each with 4096, 1.14 ns
/// with 512).
inline constexpr std::size_t place_chunk = 512;
/// How far behind a place to prefetch: two cache lines; five if eight requests go there at a time
/// (256 shaders in runs of 32: 33 ms instead of 45).
inline constexpr std::size_t prefetched_bytes = 128;
inline constexpr std::size_t prefetched_bytes_by_eight = 320;

#if DEFERRED_SHADE_HAS_GNU
// No wider than the instruction set: g++ takes wider vectors apart byte by byte.
#ifdef __AVX2__
inline constexpr std::size_t vector_bytes = 32;
#else
inline constexpr std::size_t vector_bytes = 16;
#endif
#else
inline constexpr std::size_t vector_bytes = 0;  // no vector types
#endif

}  // namespace detail

/// The choices of schedules on a CPU. A renderer may derive from it and change them for a call: see
/// `tuned`.
struct cpu_tuning {
  /// Requests in a tile of local_sort_then_dispatch. Their ids and indices, 25 KiB, fit in the
  /// first- and second-level cache of a core.
  static constexpr request_index tile = 8192;

  /// Slots that a worker of a loop uses, at most. With 256 bytes in each they fill a second-level
  /// cache of 1 MiB.
  static constexpr request_index slots_of_worker = 4096;

  /// A tile whose stretches of equal ids have at least this many requests on average is not sorted:
  /// there is little to gain.
  static constexpr request_index long_stretch = 64;

  /// Whether keys are counted by comparing vectors of `bytes` keys with every shader in turn. For
  /// few shaders that is less work than counting keys one by one (11 shaders: 0.10 ns a request
  /// instead of 0.34 ns).
  static constexpr bool compares_keys(shader_id shaders, std::size_t bytes) {
    return shaders <= bytes;
  }

  /// The parts of a sequence that are counted in turns. Neighbours are often the same, and an
  /// increment then waits for the one before (mean run 8: 0.9 ns a request instead of 1.5 ns). But
  /// the counters of all parts should stay in the first-level cache.
  static constexpr request_index counted_parts(shader_id shaders) { return shaders < 512 ? 8 : 1; }

  /// Whether local_sort_then_dispatch sorts tiles by counting; else by the bitonic network. With
  /// more shaders, the counters would not fit in 64 KiB of a worker's stack, and a tile has few
  /// requests of each shader.
  static constexpr bool counts_tiles(shader_id shaders) { return shaders < 1024; }

  /// The cache into which the places of buckets are prefetched. The first-level cache has room for
  /// 64 shaders (11 shaders: 0.83 ns a request instead of 1.10 ns). It overflows with 255.
  static constexpr cache_level ahead_of_places(shader_id shaders) {
    return shaders <= 64 ? cache_level::first_level : cache_level::second_level;
  }
};

namespace detail {

template <class Workspace, class = void>
struct find_cpu_tuning {
  using type = cpu_tuning;
};
template <class Workspace>
struct find_cpu_tuning<Workspace, std::void_t<typename Workspace::tuning_type::cpu>> {
  using type = typename Workspace::tuning_type::cpu;
};
/// The tuning that a workspace carries: see `tuned`.
template <class Workspace>
using cpu_tuning_of = typename find_cpu_tuning<Workspace>::type;

}  // namespace detail
}  // namespace deferred_shade
