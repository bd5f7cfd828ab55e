// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deferred_shade/config.hpp>  // first: it refuses what is too old

#include <bitset>
#include <cstddef>

#include <deferred_shade/detail/checked_count.hpp>
#include <deferred_shade/detail/counted_at_run_time.hpp>
#include <deferred_shade/detail/cpu/bucket.hpp>
#include <deferred_shade/detail/cpu/compact.hpp>
#include <deferred_shade/detail/cpu/radix_sort.hpp>
#include <deferred_shade/detail/cuda/workspace_bytes.hpp>
#include <deferred_shade/detail/ids.hpp>
#include <deferred_shade/detail/requirements.hpp>
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

/// How `group` groups: by group_by_bucket, the fastest; for up to 65,534 shaders.
struct by_bucket {
  using sizes = detail::table_sizes<8, 15, 32, 128, 511, 65535>;

  /// The bytes of workspace that `group` takes for up to `n` requests and `shaders` shaders.
  template <class Policy>
  static constexpr std::size_t workspace_bytes(Policy const&, std::size_t n, std::size_t shaders) {
    return detail::bucket_bytes(detail::system_of<Policy>{}, n, sizes::with_room_for(shaders));
  }
  template <class Policy, class Count, class Ids, class Workspace>
  grouping operator()(Policy const& exec, Count n, Ids ids, std::size_t shaders,
                      Workspace& scratch) const {
    return sizes::group(shaders, [&](auto size) {
      return deferred_shade::group_by_bucket<decltype(size)::value>(exec, n, ids, scratch);
    });
  }
};

/// How `group` groups: by group_by_radix_sort, for up to 65,534 shaders.
struct by_radix_sort {
  using sizes = detail::table_sizes<15, 255, 65535>;

  /// The bytes of workspace that `group` takes for up to `n` requests and `shaders` shaders.
  template <class Policy>
  static constexpr std::size_t workspace_bytes(Policy const&, std::size_t n, std::size_t shaders) {
    return detail::radix_bytes(detail::system_of<Policy>{}, n, sizes::with_room_for(shaders));
  }
  template <class Policy, class Count, class Ids, class Workspace>
  grouping operator()(Policy const& exec, Count n, Ids ids, std::size_t shaders,
                      Workspace& scratch) const {
    return sizes::group(shaders, [&](auto size) {
      return deferred_shade::group_by_radix_sort<decltype(size)::value>(exec, n, ids, scratch);
    });
  }
};

/// How `group` groups: by group_by_compaction, for up to 254 shaders.
struct by_compaction {
  using sizes = detail::table_sizes<255>;

  /// The bytes of workspace that `group` takes for up to `n` requests and `shaders` shaders.
  template <class Policy>
  static constexpr std::size_t workspace_bytes(Policy const&, std::size_t n, std::size_t shaders) {
    return detail::compact_bytes(detail::system_of<Policy>{}, n, sizes::with_room_for(shaders));
  }
  template <class Policy, class Count, class Ids, class Workspace>
  grouping operator()(Policy const& exec, Count n, Ids ids, std::size_t shaders,
                      Workspace& scratch) const {
    return sizes::group(shaders, [&](auto size) {
      std::bitset<decltype(size)::value> wanted;
      for (std::size_t k = 0; k <= shaders; ++k) wanted.set(k);
      return deferred_shade::group_by_compaction<decltype(size)::value>(exec, n, ids, scratch,
                                                                        wanted);
    });
  }
};

/// Groups requests for kernels or loops of the renderer's own: by shader, and last those that name
/// none. The number of shaders need not be known when the program is compiled.
///
/// - `exec`: as for `shade`. On CUDA, nothing waits for the stream.
/// - `how`: by_bucket, by_radix_sort or by_compaction. The result is the same.
/// - `n`: the number of requests, an integer or a device_count.
/// - `ids`: a random-access iterator over the shader id of each request, as for `shade`.
/// - `shader_count`: requests with ids from 0 to `shader_count` - 1 name a shader.
/// - `scratch`: a workspace. The result lies there, until `scratch` is used again. `reserve(n,
///   shader_count)` is not what this takes: `how.workspace_bytes(exec, n, shader_count)` is, for
///   workspace::reserve_bytes.
///
/// Throws std::invalid_argument if `n` is negative or a pointer is null; std::length_error if `n`
/// exceeds `max_requests`, if `how` has no room for so many shaders or, on a CPU, if a device_count
/// exceeds its maximum; cuda_error if CUDA refuses a launch; and what the workspace's allocator
/// throws.
///
///     auto const groups = ds::group(exec, n, material, materials, scratch);
///     shade_glass<<<blocks, 256, 0, stream>>>(groups.permutation, groups.offsets + glass, paths);
template <class Policy, class Algorithm, class Count, class Ids, class Workspace>
request_groups group(Policy const& exec, Algorithm const& how, Count n, Ids ids,
                     shader_id shader_count, Workspace& scratch) {
  using required = detail::requirements_of_group<Policy, Count, Ids, Workspace>;
  if constexpr (required::met) {
    auto const count = detail::batch_size(detail::system_of<Policy>{}, "group", n);
    detail::check_ids("group", count, ids);
    detail::ids_or_none<Ids> const all(ids, {shader_count});
    return {how(exec, count, all, shader_count, scratch), shader_count};
  } else {
    return {};
  }
}

/// The same, by_bucket.
template <class Policy, class Count, class Ids, class Workspace>
request_groups group(Policy const& exec, Count n, Ids ids, shader_id shader_count,
                     Workspace& scratch) {
  return deferred_shade::group(exec, by_bucket{}, n, ids, shader_count, scratch);
}

}  // namespace deferred_shade
