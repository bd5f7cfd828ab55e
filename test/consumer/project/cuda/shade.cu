// SPDX-License-Identifier: Apache-2.0
#include <thrust/device_vector.h>
#include <thrust/host_vector.h>
#include <thrust/system/cuda/execution_policy.h>
#include <cstdint>
#include <deferred_shade/deferred_shade.hpp>

#include "renderer.hpp"

namespace ds = deferred_shade;

struct scale {
  float const* in;
  float* out;
  float factor;
  DEFERRED_SHADE_HOST_DEVICE void operator()(ds::request_index i) const { out[i] = factor * in[i]; }
};

int shade_batch(renderer& r, int n) {
  thrust::host_vector<float> in(n);
  thrust::host_vector<std::uint8_t> ids(n);
  for (int i = 0; i < n; ++i) {
    in[i] = static_cast<float>(i);
    ids[i] = static_cast<std::uint8_t>(i % 3);
  }
  thrust::device_vector<float> const device_in = in;
  thrust::device_vector<std::uint8_t> const device_ids = ids;
  thrust::device_vector<float> device_out(n, -1.0f);

  float const* const from = device_in.data().get();
  float* const to = device_out.data().get();
  ds::shader_table const shaders{scale{from, to, 2.0f}, scale{from, to, 3.0f}};
  ds::shade(thrust::cuda::par, ds::sort_then_dispatch<>{}, n, device_ids.data().get(), shaders,
            r.scratch);

  thrust::host_vector<float> const out = device_out;
  int right = 0;
  for (int i = 0; i < n; ++i) {
    right += out[i] == (i % 3 == 0 ? 2.0f * in[i] : i % 3 == 1 ? 3.0f * in[i] : -1.0f);
  }
  return right;
}
