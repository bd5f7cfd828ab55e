// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shading/bsdf.hpp"

namespace path_tracer {

/// The direction that leaves on the far side of the facet `m`; `cos_t` from fresnel_dielectric.
PT_HD inline vec3 refract_direction(vec3 wo, vec3 m, real eta, real cos_t) {
  return glm::normalize((glm::dot(wo, m) / eta - cos_t) * m - wo / eta);
}

/// A smooth dielectric interface; `eta` is the refractive index of the far side over the near one.
struct bsdf_smooth_glass {
  vec3 color;  ///< tints what goes through, once per interface
  real eta;
  bool thin = false;

  PT_HD bsdf_value value(vec3, vec3) const { return {}; }
  PT_HD bsdf_sample sample(vec3 wo, vec3 u) const {
    real cos_t;
    real const f = fresnel_dielectric(wo.z, eta, cos_t);
    if (u.z < f) return {{-wo.x, -wo.y, wo.z}, vec3{1}, f, true};
    if (thin) return {-wo, color, 1 - f, true, true};
    return {refract_direction(wo, {0, 0, 1}, eta, cos_t), color, 1 - f, true};
  }
};

/// A rough dielectric interface (Walter et al. 2007). A thin one transmits the mirror image of what
/// it reflects, as KHR_materials_transmission has it.
struct bsdf_rough_glass {
  vec3 color;
  real eta;  ///< not 1: there would be no facet normal to a pair of directions
  ggx distribution;
  bool thin = false;

  PT_HD bsdf_value value(vec3 wo, vec3 wi) const {
    bool const reflects = wi.z > 0;
    if (thin && wi.z != 0) return thin_value(wo, {wi.x, wi.y, std::fabs(wi.z)}, reflects);
    vec3 m = glm::normalize(reflects ? wo + wi : wo + eta * wi);
    if (m.z < 0) m = -m;
    real const o_m = glm::dot(wo, m), i_m = glm::dot(wi, m);
    if (!(o_m > 0) || wi.z == 0 || (i_m > 0) != reflects) return {};
    real cos_t;
    real const f = fresnel_dielectric(o_m, eta, cos_t);
    real const root = o_m + eta * i_m;
    // Per solid angle of wi: the visible normals, times what one of them does to the measure.
    real const d = distribution.d(m) / wo.z *
                   (reflects ? real(0.25) * f : (1 - f) * o_m * eta * eta * -i_m / (root * root));
    return {(reflects ? vec3{1} : color) * (d * distribution.g2(wo, wi)), d * distribution.g1(wo)};
  }

  PT_HD bsdf_sample sample(vec3 wo, vec3 u) const {
    vec3 const m = distribution.sample(wo, {u.x, u.y});
    real const o_m = glm::dot(wo, m);
    real cos_t;
    bool const reflects = u.z < fresnel_dielectric(o_m, eta, cos_t);
    if (thin) {
      vec3 const up = 2 * o_m * m - wo;
      if (up.z <= 0) return {};
      return sample_towards(*this, wo, {up.x, up.y, reflects ? up.z : -up.z});
    }
    vec3 const wi = reflects ? 2 * o_m * m - wo : refract_direction(wo, m, eta, cos_t);
    if ((wi.z > 0) != reflects) return {};
    return sample_towards(*this, wo, wi);
  }

 private:
  PT_HD bsdf_value thin_value(vec3 wo, vec3 up, bool reflects) const {
    vec3 const m = glm::normalize(wo + up);
    real cos_t;
    real const f = fresnel_dielectric(glm::dot(wo, m), eta, cos_t);
    real const d = distribution.d(m) / (4 * wo.z) * (reflects ? f : 1 - f);
    return {(reflects ? vec3{1} : color) * (d * distribution.g2(wo, up)), d * distribution.g1(wo)};
  }
};

/// Two materials side by side: `share` of A, the rest B. This mixes glass with the opaque material
/// for a transmission below 1 in glTF.
template <class A, class B>
struct bsdf_mix {
  A a;
  B b;
  real share;

  PT_HD bsdf_value value(vec3 wo, vec3 wi) const {
    bsdf_value v{};
    if (share > 0) v = a.value(wo, wi);
    if (share >= 1) return v;
    bsdf_value const w = b.value(wo, wi);
    return {share * v.f_cos + (1 - share) * w.f_cos, share * v.pdf + (1 - share) * w.pdf};
  }
  PT_HD bsdf_sample sample(vec3 wo, vec3 u) const {
    bool const first = choose(share, u.z);
    bsdf_sample const s = first ? a.sample(wo, u) : b.sample(wo, u);
    // A delta direction belongs to one of the two alone; its share cancels against its probability.
    return s.delta || max_component(s.weight) <= 0 ? s : sample_towards(*this, wo, s.wi);
  }
};

}  // namespace path_tracer
