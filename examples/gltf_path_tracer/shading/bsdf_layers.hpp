// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shading/bsdf.hpp"

namespace path_tracer {

/// A lobe on top of a material. The material gets the share through(wo, wi) of the light, which the
/// lobe leaves.
template <class Lobe, class Base>
struct bsdf_layered {
  Lobe lobe;
  Base base;
  real base_albedo;  ///< a guess, for the choice of what to sample

  PT_HD bsdf_value value(vec3 wo, vec3 wi) const {
    if (wi.z <= 0) return {};
    real const e = lobe.albedo(wo.z);
    real const p = lobe_share(e);
    bsdf_value const top = lobe.value(wo, wi);
    bsdf_value const below = base.value(wo, wi);
    return {top.f_cos + lobe.through(wo, wi) * below.f_cos, p * top.pdf + (1 - p) * below.pdf};
  }
  PT_HD bsdf_sample sample(vec3 wo, vec3 u) const {
    bool const top = choose(lobe_share(lobe.albedo(wo.z)), u.z);
    if (top) return sample_towards(*this, wo, lobe.direction(wo, u));
    bsdf_sample const below = base.sample(wo, u);
    return below.pdf > 0 ? sample_towards(*this, wo, below.wi) : below;
  }

 private:
  PT_HD real lobe_share(real e) const {
    return e > 0 ? e / (e + (1 - e) * glm::max(base_albedo, real(0.05))) : real(0);
  }
};

}  // namespace path_tracer
