// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <deferred_shade/deferred_shade.hpp>

// Both translation units instantiate the library, with the same types and with types of their own.
struct add {
  int* results;
  int value;
  void operator()(deferred_shade::request_index i) const { results[i] += value; }
};

template <class Policy, class Schedule>
int shade_sum(Policy const& exec, Schedule const& schedule) {
  namespace ds = deferred_shade;
  std::array<std::uint8_t, 5> const ids{0, 1, 0, 2, 1};
  std::array<int, 5> results{};
  ds::shader_table const shaders{add{results.data(), 1}, add{results.data(), 10}};
  ds::workspace scratch{exec};
  ds::shade(exec, schedule, ids.size(), ids.data(), shaders, scratch);
  int sum = 0;
  for (int result : results) sum += result;
  return sum;
}
