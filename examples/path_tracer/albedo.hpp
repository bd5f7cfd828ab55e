// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "microfacet.hpp"

namespace path_tracer {

/// Charlie's alpha; not below 0.08, where the distribution and its fitted masking would reflect
/// more than they receive.
PT_HD inline float sheen_alpha(float roughness) { return glm::max(roughness * roughness, 0.08f); }

/// Directional albedos of the lobes that lie on top of a material, over the cosine of a direction
/// and the perceptual roughness; bilinear in the square roots of both.
struct albedo_tables {
  static constexpr int cosines = 64;
  static constexpr int roughnesses = 33;

  vec2 ggx_table[roughnesses][cosines];     ///< x F0 + y F90 is what a GGX lobe reflects
  vec2 ggx_mean_table[roughnesses];         ///< its cosine-weighted mean over the hemisphere
  float sheen_table[roughnesses][cosines];  ///< what a white sheen lobe reflects

  PT_HD vec2 ggx(float cos_theta, float roughness) const {
    return lookup(ggx_table, cos_theta, roughness);
  }
  PT_HD float sheen(float cos_theta, float roughness) const {
    return lookup(sheen_table, cos_theta, roughness);
  }
  PT_HD vec2 ggx_mean(float roughness) const {
    place const r = locate(std::sqrt(roughness), roughnesses);
    return glm::mix(ggx_mean_table[r.index], ggx_mean_table[r.index + 1], r.fraction);
  }

 private:
  struct place {
    int index;
    float fraction;
  };
  PT_HD static place locate(float x, int count) {
    float const scaled = glm::clamp(x, 0.0f, 1.0f) * static_cast<float>(count - 1);
    int const index = glm::min(static_cast<int>(scaled), count - 2);
    return {index, scaled - static_cast<float>(index)};
  }
  template <class T>
  PT_HD static T lookup(T const (&table)[roughnesses][cosines], float cos_theta, float roughness) {
    place const c = locate(std::sqrt(glm::max(cos_theta, 0.0f)), cosines);
    place const r = locate(std::sqrt(roughness), roughnesses);
    T const* const low = table[r.index] + c.index;
    T const* const high = table[r.index + 1] + c.index;
    return glm::mix(glm::mix(low[0], low[1], c.fraction), glm::mix(high[0], high[1], c.fraction),
                    r.fraction);
  }
};

/// The tables, computed at the first call (some tens of milliseconds).
albedo_tables const& host_albedo_tables();

}  // namespace path_tracer
