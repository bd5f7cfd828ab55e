// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thrust/system/cpp/execution_policy.h>
#include <stdexcept>
#include <string>
#include <type_traits>

#include <deferred_shade/counts.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/types.hpp>
#include <deferred_shade/workspace.hpp>

namespace deferred_shade {
namespace detail {

template <class T>
inline constexpr bool is_device_count = false;
template <class Integer>
inline constexpr bool is_device_count<device_count<Integer>> = true;

// Thrust's systems for CPUs, cpp, omp and tbb, share a base; so does thrust::seq.
template <class Policy>
std::true_type runs_on_host(thrust::system::detail::sequential::execution_policy<Policy> const&);
std::false_type runs_on_host(...);

}  // namespace detail

/// Runs every request through its shader, exactly once, in the order that `schedule` makes.
///
/// - `exec`: a Thrust execution policy for a CPU, `thrust::cpp::par`, `thrust::omp::par` or
///   `thrust::tbb::par`. Returns when all shaders have run.
/// - `schedule`: one of this library, or any function object that is called with the arguments
///   below, `n` as a request_index.
/// - `n`: the number of requests, an integer or a device_count.
/// - `ids`: a random-access iterator over the shader id of each request, an integer or enumeration
///   of 8 to 32 bits. It is read more than once. An id that the table does not have leaves its
///   request alone.
/// - `scratch`: memory to work in, one workspace per concurrent call. Nothing is allocated once it
///   has seen, or reserved for, as many requests and shaders.
///
/// Within one shader, requests are started in the order of their indices wherever one worker runs
/// them. The library does no arithmetic on the renderer's data: what a shader writes for its own
/// request does not depend on the schedule, the policy, or the number of workers, as long as the
/// compiler makes the same arithmetic of the shader everywhere (docs/guide.md, "What is promised").
///
/// Throws std::invalid_argument where `n` is negative or a pointer is null, std::length_error where
/// `n` exceeds `max_requests` or a device_count its maximum, and what the workspace's allocator
/// throws. No shader has run then, and `scratch` stays usable.
template <class Policy, class Schedule, class Count, class Ids, class... Shaders, class Allocator>
void shade(Policy const& exec, Schedule const& schedule, Count n, Ids ids,
           shader_table<Shaders...> const& shaders, workspace<Allocator>& scratch) {
  static_assert(decltype(detail::runs_on_host(exec))::value,
                "this version runs on Thrust's cpp, omp and tbb policies");
  request_index const count = detail::checked_count("shade", n);
  // Sized by the maximum, so that no later count allocates.
  if constexpr (detail::is_device_count<Count>) scratch.reserve(n.maximum, sizeof...(Shaders));
  if (count == 0) return;
  if constexpr (std::is_pointer_v<Ids>) {
    if (ids == nullptr) {
      throw std::invalid_argument("deferred_shade::shade: ids is null, and n is " +
                                  std::to_string(count));
    }
  }
  schedule(exec, count, ids, shaders, scratch);
}

}  // namespace deferred_shade
