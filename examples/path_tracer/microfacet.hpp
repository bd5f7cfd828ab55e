// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "math.hpp"

namespace path_tracer {

// Directions here are unit vectors in a frame whose z axis is the shading normal; both `wo`,
// towards the viewer, and `wi`, towards the light, point away from the surface.

PT_HD inline vec3 polar(float cos_theta, float phi) {
  // Not 1 - cos^2, of which rounding leaves little near the pole.
  float const r = std::sqrt(glm::max(0.0f, (1 - cos_theta) * (1 + cos_theta)));
  return {r * std::cos(phi), r * std::sin(phi), cos_theta};
}

/// A direction with density cos(theta) / pi over the upper hemisphere.
PT_HD inline vec3 sample_cosine(vec2 u) {
  float const r = std::sqrt(u.y), phi = 2 * pi * u.x;
  return {r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - u.y)};
}

PT_HD inline float schlick_weight(float cos_theta) {
  float const m = glm::clamp(1 - cos_theta, 0.0f, 1.0f);
  return m * m * (m * m) * m;
}

PT_HD inline vec3 schlick(vec3 f0, vec3 f90, float cos_theta) {
  return f0 + (f90 - f0) * schlick_weight(cos_theta);
}

/// Reflectance at normal incidence of a dielectric in air.
PT_HD inline float dielectric_f0(float ior) {
  float const r = (ior - 1) / (ior + 1);
  return r * r;
}

/// What an interface reflects of unpolarised light, exactly (Fresnel); `eta` is the refractive
/// index of the far side over that of the near side. `cos_t` becomes the cosine on the far side, 0
/// at total reflection.
/// The differences in the usual form cancel for indices that are nearly alike and at grazing
/// angles; here they are multiplied out, down to eta - 1, which float has exactly.
PT_HD inline float fresnel_dielectric(float cos_i, float eta, float& cos_t) {
  float const step = (eta - 1) * (eta + 1), cos2 = cos_i * cos_i;
  float const bent2 = step + cos2;  // (eta cos_t)^2
  cos_t = 0;
  if (!(bent2 > 0) || eta == 0) return 1;
  float const bent = std::sqrt(bent2), both = cos_i + bent;
  cos_t = bent / eta;
  float const s = step / (both * both);
  float const ratio = both / (eta * eta * cos_i + bent);
  float const p = s * (1 - (eta * eta + 1) * cos2) * (ratio * ratio);
  return 0.5f * (s * s + p * p);
}

/// Below this a microfacet lobe is a mirror at the resolution of float directions.
inline constexpr float min_alpha = 2e-3f;

PT_HD inline float alpha_of(float roughness) { return glm::max(roughness * roughness, min_alpha); }

/// The isotropic GGX distribution with Smith's height-correlated masking and shadowing
/// (Walter et al. 2007, Heitz 2014).
struct ggx {
  float alpha;

  PT_HD float d(vec3 m) const {
    float const e = (m.x * m.x + m.y * m.y) / (alpha * alpha) + m.z * m.z;
    return 1 / (pi * alpha * alpha * e * e);
  }
  PT_HD float lambda(vec3 w) const {
    float const tan2 = (w.x * w.x + w.y * w.y) / (w.z * w.z);
    return 0.5f * (std::sqrt(1 + alpha * alpha * tan2) - 1);
  }
  PT_HD float g1(vec3 w) const { return 1 / (1 + lambda(w)); }
  PT_HD float g2(vec3 wo, vec3 wi) const { return 1 / (1 + lambda(wo) + lambda(wi)); }

  /// A normal visible from `wo`, density g1(wo) d(m) max(0, wo.m) / wo.z (Dupuy and Benyoub 2023).
  PT_HD vec3 sample(vec3 wo, vec2 u) const {
    vec3 const w = glm::normalize(vec3{wo.x * alpha, wo.y * alpha, wo.z});
    vec3 const h = polar((1 - u.y) * (1 + w.z) - w.z, 2 * pi * u.x) + w;
    return glm::normalize(vec3{h.x * alpha, h.y * alpha, glm::max(h.z, 1e-12f)});
  }
};

/// The sheen distribution of Estevez and Kulla, "Production Friendly Microfacet Sheen BRDF" (2017),
/// known as Charlie, with the fit of its Smith masking given there.
struct charlie {
  float alpha;

  PT_HD float d(float cos_m) const {
    float const sin_m = std::sqrt(glm::max(0.0f, 1 - cos_m * cos_m));
    return (2 + 1 / alpha) * std::pow(sin_m, 1 / alpha) / (2 * pi);
  }
  PT_HD float lambda(float cos_w) const {
    return cos_w < 0.5f ? std::exp(fit(cos_w)) : std::exp(2 * fit(0.5f) - fit(1 - cos_w));
  }
  /// The reflected share f cos(theta_i), for a white lobe. The fit of the masking holds to a cosine
  /// of 1e-4; below that it would give back more light than there is.
  PT_HD float reflect(vec3 wo, vec3 wi) const {
    float const cos_m = glm::normalize(wo + wi).z;
    float const o = glm::max(wo.z, 1e-4f), i = glm::max(wi.z, 1e-4f);
    return d(cos_m) * (wi.z / i) / (4 * o * (1 + lambda(o) + lambda(i)));
  }

 private:
  PT_HD float fit(float x) const {
    float const s = (1 - alpha) * (1 - alpha);
    float const a = glm::mix(21.5473f, 25.3245f, s), b = glm::mix(3.82987f, 3.32435f, s);
    float const c = glm::mix(0.19823f, 0.16801f, s), d = glm::mix(-1.97760f, -1.27393f, s);
    float const e = glm::mix(-4.32054f, -4.85967f, s);
    return a / (1 + b * std::pow(x, c)) + d * x + e;
  }
};

}  // namespace path_tracer
