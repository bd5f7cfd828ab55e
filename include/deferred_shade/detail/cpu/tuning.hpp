// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <deferred_shade/config.hpp>
#include <deferred_shade/types.hpp>

// Every size and threshold of the algorithms for CPUs, with what decided it: measured on a Xeon of
// two cores and an EPYC with AVX2 and AVX-512 (docs/design.md, "Vectors on CPUs" and "Grouping on a
// CPU"; docs/results/cpu.md).

namespace deferred_shade {
namespace detail {

/// Where something is prefetched to: the caches of a core, as the compilers' built-in function
/// counts them.
enum class cache { none, second_level = 2, first_level = 3 };

// Blocks. A worker owns one at a time.
/// Blocks are large enough that a parallel loop over them costs little beside their work.
inline constexpr std::size_t least_block = 16384;
/// More would make the scan over their counters, which one worker does, a part of the time.
inline constexpr std::size_t most_blocks = 1024;
/// A row of counters is at most a sixteenth as long as what it counts: the scan costs no more.
inline constexpr std::size_t requests_per_counter = 16;

// Loops over requests.
/// So few run without a parallel region, which takes five microseconds with OpenMP: as many as the
/// smallest chunk of a segment.
inline constexpr std::size_t serial_requests = 32;
/// TBB's workers take the next chunk that is left: of at most so many requests, and at least so
/// many chunks.
inline constexpr std::size_t largest_chunk = 4096;
inline constexpr std::size_t chunks_by_tbb = 1024;

// Records in vectors. As many are packed at a time as take, with their results, half of a
// first-level cache of 32 KiB, and at most 256: more gain nothing.
inline constexpr std::size_t packed_bytes = 16384;
inline constexpr std::size_t most_packed = 256;

/// A segment of fewer requests is launched in small chunks, for every worker to have some.
inline constexpr std::size_t small_segment = 16384;
inline constexpr std::size_t small_chunk = 32;

/// The keys that are counted at a time if they are compared, and if they are looked at one by one.
inline constexpr std::size_t compared_chunk = 4096;
/// The keys that are put to their places at a time: the first-level cache is for the lines that are
/// written (16 Mi requests of 256 shaders: 1.24 ns each with 4096, 1.14 with 512).
inline constexpr std::size_t place_chunk = 512;
/// How far behind a place is prefetched: two lines; five if eight requests go there at a time
/// (256 shaders in runs of 32: 45 ms became 33).
inline constexpr std::size_t prefetched_bytes = 128;
inline constexpr std::size_t prefetched_bytes_by_eight = 320;

#if DEFERRED_SHADE_HAS_GNU
// No wider than the instructions are: g++ takes wider ones apart byte by byte.
#ifdef __AVX2__
inline constexpr std::size_t vector_bytes = 32;
#else
inline constexpr std::size_t vector_bytes = 16;
#endif
#else
inline constexpr std::size_t vector_bytes = 0;  // no vector types
#endif

}  // namespace detail

/// What schedules ask on a CPU. A renderer that knows better derives from it and says so for a
/// call: see `tuned`.
struct cpu_tuning {
  /// Requests in a tile of local_sort_then_dispatch: their ids and indices, 25 KiB, fit in the
  /// first- and second-level cache of a core.
  static constexpr request_index tile = 8192;

  /// A tile whose neighbours name the same shader in stretches of so many on average is run as it
  /// lies: there is little to gain from sorting it.
  static constexpr request_index long_stretch = 64;

  /// Whether keys are counted by comparing vectors of `bytes` keys with every shader in turn. For
  /// few shaders that is less work than a look at each key (11 shaders: 0.10 ns a request, not
  /// 0.34).
  static constexpr bool compares_keys(shader_id shaders, std::size_t bytes) {
    return shaders <= bytes;
  }

  /// The parts of a sequence that are counted by turns. Neighbours often are the same, and one
  /// increment waits for the other (mean run 8: 1.5 ns a request became 0.9); but the counters are
  /// to stay in the first-level cache.
  static constexpr request_index counted_parts(shader_id shaders) { return shaders < 512 ? 8 : 1; }

  /// Whether local_sort_then_dispatch sorts tiles by counting; else by the bitonic network. More
  /// counters than this would not fit in 64 KiB of a worker's stack, and a tile has few requests of
  /// each shader then.
  static constexpr bool counts_tiles(shader_id shaders) { return shaders < 1024; }

  /// Where places of a bucket are prefetched to. The first-level cache has room for what lies ahead
  /// of 64 shaders: 0.83 ns a request instead of 1.10 with 11. It overflows with 255.
  static constexpr detail::cache ahead_of_places(shader_id shaders) {
    return shaders <= 64 ? detail::cache::first_level : detail::cache::second_level;
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
