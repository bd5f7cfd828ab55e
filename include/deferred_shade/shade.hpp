// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>
#include <type_traits>

#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/types.hpp>
#include <deferred_shade/workspace.hpp>

namespace deferred_shade {
namespace detail {

/// `n` as a count of requests; throws what `shade` promises.
template <class Integer>
request_index checked_count(Integer n) {
  static_assert(std::is_integral_v<Integer> && !std::is_same_v<Integer, bool>,
                "n is an integer or a device_count");
  if constexpr (std::is_signed_v<Integer>) {
    if (n < 0) {
      throw std::invalid_argument("deferred_shade::shade: n is " + std::to_string(n) +
                                  ", and a number of requests is not negative");
    }
  }
  if (static_cast<std::make_unsigned_t<Integer>>(n) > max_requests) {
    throw std::length_error("deferred_shade::shade: n is " + std::to_string(n) +
                            ", and a wave holds at most " + std::to_string(max_requests) +
                            " requests: their indices have 32 bits");
  }
  return static_cast<request_index>(n);
}

template <class Integer>
request_index checked_count(device_count<Integer> n) {
  if (n.pointer == nullptr) {
    throw std::invalid_argument("deferred_shade::shade: the pointer of device_count is null");
  }
  request_index const maximum = checked_count(n.maximum);
  request_index const count = checked_count(*n.pointer);
  if (count > maximum) {
    throw std::length_error("deferred_shade::shade: device_count points at " +
                            std::to_string(count) + " requests, above its maximum of " +
                            std::to_string(maximum));
  }
  return count;
}

}  // namespace detail

/// Runs every request through its shader, exactly once, in the order that `schedule` makes.
///
/// - `exec`: a Thrust execution policy, `thrust::cpp::par`, `thrust::omp::par` or
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
/// them. The library does no arithmetic on the renderer's data: what a shader writes for a request
/// does not depend on the schedule, the policy, or the number of workers.
///
/// Throws std::invalid_argument where `n` is negative or a pointer is null, std::length_error where
/// `n` exceeds `max_requests` or a device_count its maximum, and what the workspace's allocator
/// throws. No shader has run then, and `scratch` stays usable.
template <class Policy, class Schedule, class Count, class Ids, class... Shaders, class Allocator>
void shade(Policy const& exec, Schedule const& schedule, Count n, Ids ids,
           shader_table<Shaders...> const& shaders, workspace<Allocator>& scratch) {
  request_index const count = detail::checked_count(n);
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
