// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deferred_shade/config.hpp>  // first: it refuses what is too old

#include <deferred_shade/detail/checked_count.hpp>
#include <deferred_shade/detail/requirements.hpp>
#include <deferred_shade/detail/shader_subset.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/schedule.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/types.hpp>
#include <deferred_shade/workspace.hpp>
#ifdef DEFERRED_SHADE_CHECKED
#include <deferred_shade/detail/expected_ids.hpp>
#ifdef __CUDACC__
#include <deferred_shade/detail/cuda/expected_ids.hpp>
#endif
#endif

namespace deferred_shade {

/// Runs the shader of every request exactly once, in the order that `schedule` makes.
///
/// - `exec`: a Thrust execution policy. With `thrust::cpp::par`, `thrust::omp::par` and
///   `thrust::tbb::par`, the call returns when all shaders have run. With `thrust::cuda::par` or
///   `thrust::cuda::par_nosync`, on any stream, the call is asynchronous: all work goes to that
///   stream, and nothing waits for it. The call can be captured into a CUDA graph if `scratch` is
///   large enough.
/// - `schedule`: one of this library, or any function object that can be called with `exec` and the
///   arguments below. `n` becomes a request_index; on CUDA, a device_count stays one. On CUDA, a
///   table of up to 32 shaders that shader_table::only has made arrives compacted: without gaps,
///   and with ids to match.
/// - `n`: the number of requests, an integer or a device_count. `scratch` is reserved for the
///   maximum of a device_count, whatever the schedule.
/// - `ids`: a random-access iterator over the shader id of each request. An id is an integer or
///   enumeration of 8 to 32 bits, wide enough for the last shader's. Ids are read more than once.
///   Requests whose id is not in the table are skipped.
/// - `scratch`: memory to work in: a workspace, or an `observed` or `tuned` one. Concurrent calls
///   need one each. Nothing is allocated once it has seen, or reserved for, as many requests and
///   shaders.
///
/// A worker starts the requests of one shader in the order of their indices. The library does no
/// arithmetic on the renderer's data: what a shader writes for its own request does not depend on
/// the schedule, the policy or the number of workers, if the compiler makes the same arithmetic of
/// the shader everywhere (docs/guide.md, "What is promised").
///
/// Throws std::invalid_argument if `n` is negative or a pointer is null; std::length_error if `n`
/// exceeds `max_requests` or, on a CPU, a device_count exceeds its maximum; and what the
/// workspace's allocator throws. No shader has run then, and `scratch` stays usable. Throws
/// cuda_error if CUDA refuses a launch.
///
/// If the macro DEFERRED_SHADE_CHECKED is defined, in all files of a program alike, `shade` first
/// looks at all ids, and throws std::invalid_argument if one is of a shader that
/// shader_table::expecting was told not to occur. On CUDA it waits for the stream then, except in a
/// capture, where it does not look.
template <class Policy, class Schedule, class Count, class Ids, class... Shaders, class Workspace>
void shade(Policy const& exec, Schedule const& schedule, Count n, Ids ids,
           shader_table<Shaders...> const& shaders, Workspace& scratch) {
  using required =
      detail::requirements_of_shade<Schedule, Policy, Count, Ids, Workspace, Shaders...>;
  if constexpr (required::met) {
    using system = detail::system_of<Policy>;
    auto const count = detail::batch_size(system{}, "shade", n);
    // Sized by the maximum: no later count allocates.
    if constexpr (detail::is_device_count<Count>) scratch.reserve(n.maximum, sizeof...(Shaders));
    if (detail::maximum_of(count) == 0) return;
    detail::check_ids("shade", count, ids);
#ifdef DEFERRED_SHADE_CHECKED
    detail::check_expected(system{}, exec, count, ids, shaders);
#endif
    detail::run_schedule(system{}, schedule, exec, count, ids, shaders, scratch);
  }
}

}  // namespace deferred_shade
