// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thrust/device_vector.h>
#include <thrust/host_vector.h>
#include <cstdint>
#include <cstdio>
#include <deferred_shade/deferred_shade.hpp>

struct add {
  int* results;
  int value;
  DEFERRED_SHADE_HOST_DEVICE void operator()(deferred_shade::request_index i) const {
    results[i] += value;
  }
};

/// Shades five requests where `exec` runs; whether the sum of their results is right.
template <class Policy, class Schedule>
bool shade_sum(Policy const& exec, Schedule const& schedule) {
  namespace ds = deferred_shade;
  std::uint8_t const list[] = {0, 1, 0, 2, 1};
  thrust::device_vector<std::uint8_t> const ids(list, list + 5);
  thrust::device_vector<int> results(ids.size(), 0);
  int* const first = thrust::raw_pointer_cast(results.data());
  ds::shader_table const shaders{add{first, 1}, add{first, 10}};
  ds::workspace scratch{exec};
  ds::shade(exec, schedule, ids.size(), thrust::raw_pointer_cast(ids.data()), shaders, scratch);
  thrust::host_vector<int> const host_results = results;
  int sum = 0;
  for (int const result : host_results) sum += result;
  std::printf("%d, expected 22\n", sum);
  return sum == 22;
}
