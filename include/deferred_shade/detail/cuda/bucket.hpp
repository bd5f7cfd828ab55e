// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deferred_shade/detail/cuda/architectures.hpp>
#include <deferred_shade/detail/cuda/counter_bucket.hpp>
#include <deferred_shade/detail/cuda/lane_bucket.hpp>
#include <deferred_shade/detail/cuda/launch.hpp>
#include <deferred_shade/detail/cuda/radix_sort.hpp>
#include <deferred_shade/detail/cuda/tuning.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/types.hpp>

// A kernel counts the shaders of every tile. A scan over the counts of all tiles, shader by shader,
// turns them into places. A kernel sorts every tile in shared memory, and writes each shader's
// requests next to those of the tile before. Tiles run in memory order: writes of about the same
// time lie together in memory.

namespace deferred_shade::detail {
inline namespace DEFERRED_SHADE_ARCHITECTURES {

template <shader_id Shaders, class Policy, class Count, class Ids, class Workspace>
grouping bucket_grouping(cuda_system, Policy const& exec, Count n, Ids ids, Workspace& scratch) {
  constexpr bucket_algorithm algorithm = cuda_tuning_of<Workspace>::bucket(Shaders);
  if constexpr (algorithm == bucket_algorithm::lanes) {
    static_assert(
        Shaders <= warp_size,
        "deferred_shade: cuda_tuning::bucket must not choose lanes for more than 32 shaders");
    return detail::lane_bucket_grouping<Shaders>(detail::stream_of(exec), n, ids, scratch);
  } else if constexpr (algorithm == bucket_algorithm::counters) {
    static_assert(
        Shaders <= 511,
        "deferred_shade: cuda_tuning::bucket must not choose counters for more than 511 shaders");
    return detail::counter_bucket_grouping<Shaders>(detail::stream_of(exec), n, ids, scratch);
  } else {
    return detail::radix_grouping<Shaders>(cuda_system{}, exec, n, ids, scratch);
  }
}

}  // namespace DEFERRED_SHADE_ARCHITECTURES
}  // namespace deferred_shade::detail
