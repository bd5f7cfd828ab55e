// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "scene/math.hpp"

namespace path_tracer {

// Directions here are unit vectors in a frame whose z axis is the shading normal; both `wo`,
// towards the viewer, and `wi`, towards the light, point away from the surface.

PT_HD inline vec3 polar(real cos_theta, real phi) {
  // Not 1 - cos^2, of which rounding leaves little near the pole.
  real const r = std::sqrt(glm::max(real(0), (1 - cos_theta) * (1 + cos_theta)));
  return {r * std::cos(phi), r * std::sin(phi), cos_theta};
}

/// A direction with density cos(theta) / pi over the upper hemisphere.
PT_HD inline vec3 sample_cosine(vec2 u) {
  real const r = std::sqrt(u.y), phi = 2 * pi * u.x;
  return {r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - u.y)};
}

PT_HD inline real schlick_weight(real cos_theta) {
  real const m = glm::clamp(1 - cos_theta, real(0), real(1));
  return m * m * (m * m) * m;
}

PT_HD inline vec3 schlick(vec3 f0, vec3 f90, real cos_theta) {
  return f0 + (f90 - f0) * schlick_weight(cos_theta);
}

/// Reflectance at normal incidence of a dielectric in air.
PT_HD inline real dielectric_f0(real ior) {
  real const r = (ior - 1) / (ior + 1);
  return r * r;
}

/// The exact reflectance of an interface for unpolarised light (Fresnel). `eta` is the refractive
/// index of the far side over that of the near side. Sets `cos_t` to the cosine on the far side, 0
/// at total reflection. The differences in the usual form cancel for similar indices and at grazing
/// angles. Here they are multiplied out, down to eta - 1, which is exact in float.
PT_HD inline real fresnel_dielectric(real cos_i, real eta, real& cos_t) {
  real const step = (eta - 1) * (eta + 1), cos2 = cos_i * cos_i;
  real const bent2 = step + cos2;  // (eta cos_t)^2
  cos_t = 0;
  if (!(bent2 > 0) || eta == 0) return 1;
  real const bent = std::sqrt(bent2), both = cos_i + bent;
  cos_t = bent / eta;
  real const s = step / (both * both);
  real const ratio = both / (eta * eta * cos_i + bent);
  real const p = s * (1 - (eta * eta + 1) * cos2) * (ratio * ratio);
  return real(0.5) * (s * s + p * p);
}

/// Below this, a microfacet lobe is a mirror, at the resolution of directions in float.
inline constexpr real min_alpha = real(2e-3);

PT_HD inline real alpha_of(real roughness) { return glm::max(roughness * roughness, min_alpha); }

/// The isotropic GGX distribution with Smith's height-correlated masking and shadowing
/// (Walter et al. 2007, Heitz 2014).
struct ggx {
  real alpha;

  PT_HD real d(vec3 m) const {
    real const e = (m.x * m.x + m.y * m.y) / (alpha * alpha) + m.z * m.z;
    return 1 / (pi * alpha * alpha * e * e);
  }
  PT_HD real lambda(vec3 w) const {
    real const tan2 = (w.x * w.x + w.y * w.y) / (w.z * w.z);
    return real(0.5) * (std::sqrt(1 + alpha * alpha * tan2) - 1);
  }
  PT_HD real g1(vec3 w) const { return 1 / (1 + lambda(w)); }
  PT_HD real g2(vec3 wo, vec3 wi) const { return 1 / (1 + lambda(wo) + lambda(wi)); }

  /// A normal visible from `wo`, density g1(wo) d(m) max(0, wo.m) / wo.z (Dupuy and Benyoub 2023).
  PT_HD vec3 sample(vec3 wo, vec2 u) const {
    vec3 const w = glm::normalize(vec3{wo.x * alpha, wo.y * alpha, wo.z});
    vec3 const h = polar((1 - u.y) * (1 + w.z) - w.z, 2 * pi * u.x) + w;
    return glm::normalize(vec3{h.x * alpha, h.y * alpha, glm::max(h.z, real(1e-12))});
  }
};

/// The sheen distribution of Estevez and Kulla, "Production Friendly Microfacet Sheen BRDF" (2017),
/// known as Charlie, with the fit of its Smith masking given there.
struct charlie {
  real alpha;

  PT_HD real d(real cos_m) const {
    real const sin_m = std::sqrt(glm::max(real(0), (1 - cos_m) * (1 + cos_m)));
    return (2 + 1 / alpha) * std::pow(sin_m, 1 / alpha) / (2 * pi);
  }
  PT_HD real lambda(real cos_w) const {
    cos_w = glm::min(cos_w, real(1));  // the cosine of a rounded vector may be larger
    return cos_w < real(0.5) ? std::exp(fit(cos_w)) : std::exp(2 * fit(real(0.5)) - fit(1 - cos_w));
  }
  /// The reflected share f cos(theta_i), for a white lobe. The fit of the masking is valid down to
  /// a cosine of 1e-4; below, it would reflect more light than arrives.
  PT_HD real reflect(vec3 wo, vec3 wi) const {
    real const cos_m = glm::normalize(wo + wi).z;
    real const o = glm::max(wo.z, real(1e-4)), i = glm::max(wi.z, real(1e-4));
    return d(cos_m) * (wi.z / i) / (4 * o * (1 + lambda(o) + lambda(i)));
  }

 private:
  PT_HD real fit(real x) const {
    real const s = (1 - alpha) * (1 - alpha);
    real const a = glm::mix(real(21.5473), real(25.3245), s),
               b = glm::mix(real(3.82987), real(3.32435), s);
    real const c = glm::mix(real(0.19823), real(0.16801), s),
               d = glm::mix(real(-1.97760), real(-1.27393), s);
    real const e = glm::mix(real(-4.32054), real(-4.85967), s);
    return a / (1 + b * std::pow(x, c)) + d * x + e;
  }
};

}  // namespace path_tracer
