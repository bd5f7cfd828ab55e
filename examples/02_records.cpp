// SPDX-License-Identifier: Apache-2.0
// Record shaders: pure functions from a request to a result. The table names the source of requests
// and the sink of results once, for all its shaders.
#include <thrust/execution_policy.h>
#include <thrust/iterator/transform_iterator.h>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <deferred_shade/deferred_shade.hpp>
#include <vector>

namespace ds = deferred_shade;

namespace {

struct hit {
  float cosine;  // between the surface normal and the light
  std::uint16_t material;
};

struct matte {
  float albedo;
  float operator()(hit const& h) const { return albedo * std::max(h.cosine, 0.0F); }
};

struct glossy {
  float exponent;
  float operator()(hit const& h) const { return std::pow(std::max(h.cosine, 0.0F), exponent); }
};

}  // namespace

int main() {
  std::vector<hit> hits;
  for (int i = 0; i < 1000; ++i) {
    hits.push_back({std::cos(0.01F * static_cast<float>(i)), static_cast<std::uint16_t>(i % 3)});
  }
  std::vector<float> radiance(hits.size());

  // The ids are read where they are, in the renderer's own hit records.
  auto const ids =
      thrust::make_transform_iterator(hits.data(), [](hit const& h) { return h.material; });
  auto const shaders =
      ds::record_shaders(hits.data(), radiance.data(), matte{0.8F}, matte{0.2F}, glossy{20});

  ds::workspace scratch{thrust::device};
  ds::shade(thrust::device, ds::local_sort_then_dispatch<>{}, hits.size(), ids, shaders, scratch);

  float sum = 0;
  for (float const r : radiance) sum += r;
  std::printf("mean radiance %.4f\n", sum / static_cast<float>(radiance.size()));
  for (std::size_t i = 0; i < hits.size(); ++i) {
    float const expected = i % 3 == 0   ? matte{0.8F}(hits[i])
                           : i % 3 == 1 ? matte{0.2F}(hits[i])
                                        : glossy{20}(hits[i]);
    if (radiance[i] != expected) return 1;
  }
  return 0;
}
