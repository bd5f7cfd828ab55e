// SPDX-License-Identifier: Apache-2.0
#include "shading/albedo.hpp"

#include <memory>

namespace path_tracer {
namespace {

vec3 direction_at(real cos_theta) { return {std::sqrt(1 - cos_theta * cos_theta), 0, cos_theta}; }

/// Over `count` visible normals: the mean of G2 / G1, split by Schlick's weight.
vec2 integrate_ggx(vec3 wo, real alpha, int count) {
  ggx const distribution{alpha};
  glm::dvec2 sum{0};
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) {
      vec2 const u{
          (static_cast<real>(i) + real(0.5)) / static_cast<real>(2 * count),  // half: symmetry
          (static_cast<real>(j) + real(0.5)) / static_cast<real>(count)};
      vec3 const m = distribution.sample(wo, u);
      real const o_m = glm::dot(wo, m);
      vec3 const wi = 2 * o_m * m - wo;
      if (wi.z <= 0) continue;
      double const g = distribution.g2(wo, wi) / distribution.g1(wo);
      double const w = schlick_weight(o_m);
      sum += glm::dvec2{g * (1 - w), g * w};
    }
  return vec2(sum / double(count * count));
}

real integrate_sheen(vec3 wo, real alpha, int count) {
  charlie const distribution{alpha};
  double sum = 0;
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j)
      sum += distribution.reflect(
          wo, polar((static_cast<real>(j) + real(0.5)) / static_cast<real>(count),
                    pi * (static_cast<real>(i) + real(0.5)) / static_cast<real>(count)));
  return static_cast<real>(sum * 2 * double{pi} / (count * count));
}

std::unique_ptr<albedo_tables> compute() {
  auto tables = std::make_unique<albedo_tables>();
  constexpr int cosines = albedo_tables::cosines, roughnesses = albedo_tables::roughnesses;
  for (int r = 0; r < roughnesses; ++r) {
    real const root_r = static_cast<real>(r) / (roughnesses - 1), roughness = root_r * root_r;
    glm::dvec2 mean{0};
    for (int c = 0; c < cosines; ++c) {
      real const root = static_cast<real>(c) / (cosines - 1);
      vec3 const wo = direction_at(glm::max(root * root, real(1e-7)));
      tables->ggx_table[r][c] = integrate_ggx(wo, alpha_of(roughness), 24);
      tables->sheen_table[r][c] = integrate_sheen(wo, sheen_alpha(roughness), 24);
    }
    constexpr int steps = 2048;  // of the table's own interpolation, so that energy adds up to 1
    for (int k = 0; k < steps; ++k) {
      real const cos_theta = (static_cast<real>(k) + real(0.5)) / steps;
      tables->ggx_mean_table[r] = tables->ggx_table[r][0];
      mean += glm::dvec2(tables->ggx(cos_theta, roughness)) * (2.0 * double{cos_theta} / steps);
    }
    tables->ggx_mean_table[r] = vec2(mean);
  }
  return tables;
}

}  // namespace

albedo_tables const& host_albedo_tables() {
  static std::unique_ptr<albedo_tables> const tables = compute();
  return *tables;
}

}  // namespace path_tracer
