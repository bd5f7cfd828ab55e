// SPDX-License-Identifier: Apache-2.0
#include <thrust/execution_policy.h>
#include <cstdint>
#include <cstdio>
#include <deferred_shade/deferred_shade.hpp>
#include <vector>

namespace ds = deferred_shade;

struct scale {
  float const* in;
  float* out;
  float factor;
  DEFERRED_SHADE_HOST_DEVICE void operator()(ds::request_index i) const { out[i] = factor * in[i]; }
};

int main() {
  int const n = 1000;
  std::vector<float> in(n), out(n, -1.0f);
  std::vector<std::uint8_t> ids(n);
  for (int i = 0; i < n; ++i) {
    in[i] = static_cast<float>(i);
    ids[i] = static_cast<std::uint8_t>(i % 3);
  }
  ds::shader_table shaders{scale{in.data(), out.data(), 2.0f}, scale{in.data(), out.data(), 3.0f}};
  ds::workspace scratch{thrust::device};
  ds::shade(thrust::device, ds::sort_then_dispatch<>{}, n, ids.data(), shaders, scratch);
  for (int i = 0; i < n; ++i) {
    float const expected = i % 3 == 0 ? 2.0f * in[i] : i % 3 == 1 ? 3.0f * in[i] : -1.0f;
    if (out[i] != expected) {
      std::printf("request %d gave %g instead of %g\n", i, double(out[i]), double(expected));
      return 1;
    }
  }
  return 0;
}
