// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shading/microfacet.hpp"

namespace path_tracer {

/// Charlie's alpha, at least 0.08: below that, the distribution and its fitted masking reflect more
/// than they receive.
PT_HD inline real sheen_alpha(real roughness) {
  return glm::max(roughness * roughness, real(0.08));
}

/// Directional albedos of the lobes that lie on top of a material, over the cosine of a direction
/// and the perceptual roughness; bilinear in the square roots of both.
struct albedo_tables {
  static constexpr int cosines = 64;
  static constexpr int roughnesses = 33;

  vec2 ggx_table[roughnesses][cosines];    ///< x F0 + y F90 is what a GGX lobe reflects
  vec2 ggx_mean_table[roughnesses];        ///< its cosine-weighted mean over the hemisphere
  real sheen_table[roughnesses][cosines];  ///< what a white sheen lobe reflects

  PT_HD vec2 ggx(real cos_theta, real roughness) const {
    return lookup(ggx_table, cos_theta, roughness);
  }
  PT_HD real sheen(real cos_theta, real roughness) const {
    return lookup(sheen_table, cos_theta, roughness);
  }
  PT_HD vec2 ggx_mean(real roughness) const {
    place const r = locate(std::sqrt(roughness), roughnesses);
    return glm::mix(ggx_mean_table[r.index], ggx_mean_table[r.index + 1], r.fraction);
  }

 private:
  struct place {
    int index;
    real fraction;
  };
  PT_HD static place locate(real x, int count) {
    real const scaled = glm::clamp(x, real(0), real(1)) * static_cast<real>(count - 1);
    int const index = glm::min(static_cast<int>(scaled), count - 2);
    return {index, scaled - static_cast<real>(index)};
  }
  template <class T>
  PT_HD static T lookup(T const (&table)[roughnesses][cosines], real cos_theta, real roughness) {
    place const c = locate(std::sqrt(glm::max(cos_theta, real(0))), cosines);
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
