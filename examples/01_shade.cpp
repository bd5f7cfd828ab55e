// SPDX-License-Identifier: Apache-2.0
#include <thrust/execution_policy.h>
#include <cstdint>
#include <cstdio>
#include <deferred_shade/deferred_shade.hpp>
#include <vector>

namespace ds = deferred_shade;

int main() {
  std::vector<std::uint8_t> const material{0, 1, 0, 255, 1, 0};  // 255: this path has ended
  std::vector<float> radiance(material.size(), 0.0F);

  auto const matte = [out = radiance.data()](ds::request_index i) { out[i] = 0.5F; };
  auto const glass = [out = radiance.data()](ds::request_index i) { out[i] = 0.9F; };
  ds::shader_table const shaders{matte, glass};  // the id of a shader is its position

  ds::workspace scratch{thrust::device};  // keep it: once warm, nothing allocates
  ds::shade(thrust::device, ds::bucket_then_dispatch<>{}, material.size(), material.data(), shaders,
            scratch);

  for (float const r : radiance) std::printf("%.1f ", r);  // 0.5 0.9 0.5 0.0 0.9 0.5
  std::printf("\n");
  return radiance == std::vector<float>{0.5F, 0.9F, 0.5F, 0.0F, 0.9F, 0.5F} ? 0 : 1;
}
