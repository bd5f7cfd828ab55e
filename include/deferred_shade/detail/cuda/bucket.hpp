// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deferred_shade/detail/cuda/large_bucket.hpp>
#include <deferred_shade/detail/cuda/launch.hpp>
#include <deferred_shade/detail/cuda/radix_sort.hpp>
#include <deferred_shade/detail/cuda/small_bucket.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/types.hpp>

// Every tile counts its shaders; a scan over the counts of all tiles, shader by shader, turns them
// into places; every tile is sorted in shared memory and each shader's requests are written next to
// those of the tile before. Tiles run in the order in which they lie, so that what is written at
// one time lies together in memory.

namespace deferred_shade::detail {

/// The largest table that a warp has a lane for each shader of.
inline constexpr shader_id most_small_buckets = warp_size;

/// The largest table that a thread block has counters for in shared memory; larger ones are sorted.
inline constexpr shader_id most_large_buckets = 511;

template <shader_id Shaders, class Policy, class Count, class Ids, class Workspace>
grouping bucket_grouping(cuda_system, Policy const& exec, Count n, Ids ids, Workspace& scratch) {
  if constexpr (Shaders <= most_small_buckets) {
    return small_bucket_grouping<Shaders>(stream_of(exec), n, ids, scratch);
  } else if constexpr (Shaders <= most_large_buckets) {
    return large_bucket_grouping<Shaders>(stream_of(exec), n, ids, scratch);
  } else {
    return radix_grouping<Shaders>(cuda_system{}, exec, n, ids, scratch);
  }
}

}  // namespace deferred_shade::detail
