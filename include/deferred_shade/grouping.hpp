// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deferred_shade/config.hpp>  // first: it refuses what is too old

#include <bitset>

#include <deferred_shade/detail/cpu/bucket.hpp>
#include <deferred_shade/detail/cpu/compact.hpp>
#include <deferred_shade/detail/cpu/radix_sort.hpp>
#include <deferred_shade/detail/ids.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/types.hpp>
#ifdef __CUDACC__
#include <deferred_shade/detail/cuda/bucket.hpp>
#include <deferred_shade/detail/cuda/compact.hpp>
#include <deferred_shade/detail/cuda/radix_sort.hpp>
#endif

namespace deferred_shade {

/// Groups requests by one parallel, stable counting sort. Every block counts its shaders. A scan
/// over the counts gives each block its place in each segment. The block writes its requests there.
/// Reads the ids twice and writes the permutation once. On CUDA, tables of more than 511 shaders go
/// to group_by_radix_sort.
///
/// `ids` is a random-access iterator of `n` ids; `n` is a request_index, or on CUDA a device_count.
/// The result lives in `scratch` until its next use.
template <shader_id Shaders, class Policy, class Count, class Ids, class Workspace>
grouping group_by_bucket(Policy const& exec, Count n, Ids ids, Workspace& scratch) {
  if constexpr (detail::requirements_of_ids<Ids>::met) {
    [[maybe_unused]] auto const grouped = scratch.begin_phase({"group"});
    return detail::bucket_grouping<Shaders>(detail::system_of<Policy>{}, exec, n, ids, scratch);
  } else {
    return {};
  }
}

/// Groups requests by a radix sort of (id, index) pairs. CUDA uses CUB's sort; a CPU sorts by one
/// byte in each pass. Keys are no wider than the table needs: 255 shaders take a single pass.
///
/// On a CPU, the worker that owns a block sorts it. A scan over the lengths of the runs gives each
/// run its place, and the worker copies it there. (Thrust's own sort is not used: it allocates in
/// every call, merges block by block, takes 512 KiB of stack for keys of two bytes, and does not
/// compile without exceptions.)
///
/// `ids` is a random-access iterator of `n` ids; `n` is a request_index, or on CUDA a device_count.
/// The result lives in `scratch` until its next use.
template <shader_id Shaders, class Policy, class Count, class Ids, class Workspace>
grouping group_by_radix_sort(Policy const& exec, Count n, Ids ids, Workspace& scratch) {
  if constexpr (detail::requirements_of_ids<Ids>::met) {
    [[maybe_unused]] auto const grouped = scratch.begin_phase({"group"});
    return detail::radix_grouping<Shaders>(detail::system_of<Policy>{}, exec, n, ids, scratch);
  } else {
    return {};
  }
}

/// Groups requests by one stream compaction per shader, "select, scan, scatter" (Hoberock, Lu, Jia
/// and Hart, "Stream Compaction for Deferred Shading", HPG 2009, section 4.1). On a CPU, every
/// block counts the requests of the shader, a scan over the counts gives each block its place, and
/// the block copies its requests there. On CUDA, CUB's DeviceSelect does that. Reads the ids once
/// (CUDA) or twice (CPU) for each shader: the work grows with n * shaders.
///
/// `ids` is a random-access iterator of `n` ids; `n` is a request_index, or on CUDA a device_count.
/// The result lies in memory of `scratch`, until its next use. Only `wanted` shaders are compacted;
/// the segments of the others are empty. Throws what `scratch` throws, and cuda_error if CUDA
/// refuses.
template <shader_id Shaders, class Policy, class Count, class Ids, class Workspace>
grouping group_by_compaction(Policy const& exec, Count n, Ids ids, Workspace& scratch,
                             std::bitset<Shaders> const& wanted = std::bitset<Shaders>().set()) {
  if constexpr (detail::requirements_of_ids<Ids>::met) {
    [[maybe_unused]] auto const grouped = scratch.begin_phase({"group"});
    return detail::compact_grouping<Shaders>(detail::system_of<Policy>{}, exec, n, ids, scratch,
                                             wanted);
  } else {
    return {};
  }
}

}  // namespace deferred_shade
