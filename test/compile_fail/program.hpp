// SPDX-License-Identifier: Apache-2.0
// Covers detail/requirements.hpp.
#pragma once

#include <thrust/system/cpp/execution_policy.h>
#include <cstddef>
#include <cstdint>
#include <deferred_shade/deferred_shade.hpp>
#include <utility>
#include <vector>

// What the programs of this folder have in common: a call that is right except for one argument.

namespace ds = deferred_shade;

struct mark {
  float* out;
  DEFERRED_SHADE_HOST_DEVICE void operator()(ds::request_index i) const { out[i] = 1; }
};

template <int Id>
struct numbered {
  void operator()(ds::request_index) const {}
};
template <int... Ids>
auto table_of(std::integer_sequence<int, Ids...>) {
  return ds::shader_table{numbered<Ids>{}...};
}

struct hit {
  float a, b;
};
struct color {
  float value;
};
struct matte {
  DEFERRED_SHADE_HOST_DEVICE color operator()(hit const& h) const { return {h.a * h.b}; }
};
