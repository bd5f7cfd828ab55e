// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deferred_shade/deferred_shade.hpp>

/// What was `template <class Material> __global__ void shade(Arrays arrays)`: the parameters of the
/// kernel are members, and the number of its thread is the index of a request.
template <class Material, class Arrays>
struct shade_kernel {
  Arrays arrays;  // pointers, copied into the kernel
  DEFERRED_SHADE_HOST_DEVICE void operator()(deferred_shade::request_index i) const {
    Material{}(arrays, i);
  }
};

/// The table of these materials. The position of a type in the list is its id.
template <class... Materials, class Arrays>
auto table_of(Arrays const& arrays) {
  return deferred_shade::shader_table{shade_kernel<Materials, Arrays>{arrays}...};
}
