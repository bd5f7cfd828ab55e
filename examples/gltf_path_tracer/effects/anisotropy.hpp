// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "effects/effect.hpp"
#include "shading/bsdf.hpp"

namespace path_tracer {

/// GGX with two roughnesses, along the axes x and y of a frame that is rotated relative to the
/// surface's (Heitz 2014, section 5.3).
struct turned_ggx {
  real alpha_x, alpha_y;
  real cosine, sine;  ///< of the angle from the tangent to the x axis

  PT_HD vec3 turned(vec3 v) const {
    return {cosine * v.x + sine * v.y, cosine * v.y - sine * v.x, v.z};
  }
  PT_HD vec3 turned_back(vec3 v) const {
    return {cosine * v.x - sine * v.y, cosine * v.y + sine * v.x, v.z};
  }
  PT_HD real d(vec3 m) const {
    vec3 const t = turned(m);
    real const x = t.x / alpha_x, y = t.y / alpha_y;
    real const e = x * x + y * y + t.z * t.z;
    return 1 / (pi * alpha_x * alpha_y * e * e);
  }
  PT_HD real lambda(vec3 w) const {
    vec3 const t = turned(w);
    real const x = t.x * alpha_x, y = t.y * alpha_y;
    return real(0.5) * (std::sqrt(1 + (x * x + y * y) / (t.z * t.z)) - 1);
  }
  PT_HD real g1(vec3 w) const { return 1 / (1 + lambda(w)); }
  PT_HD real g2(vec3 wo, vec3 wi) const { return 1 / (1 + lambda(wo) + lambda(wi)); }

  /// A visible normal, see ggx::sample.
  PT_HD vec3 sample(vec3 wo, vec2 u) const {
    vec3 const t = turned(wo);
    vec3 const w = glm::normalize(vec3{t.x * alpha_x, t.y * alpha_y, t.z});
    vec3 const h = polar((1 - u.y) * (1 + w.z) - w.z, 2 * pi * u.x) + w;
    return turned_back(
        glm::normalize(vec3{h.x * alpha_x, h.y * alpha_y, glm::max(h.z, real(1e-12))}));
  }
};

/// The lobe of a brushed surface.
struct brushed_lobe : basic_specular_lobe<turned_ggx> {
  /// The roughness that masks facets towards `w` as this lobe does.
  PT_HD real roughness_from(vec3 w) const {
    vec3 const t = distribution.turned(w);
    real const x = t.x * distribution.alpha_x, y = t.y * distribution.alpha_y;
    real const length2 = t.x * t.x + t.y * t.y;
    return length2 > 0 ? std::sqrt(std::sqrt((x * x + y * y) / length2)) : least_roughness();
  }
  PT_HD real least_roughness() const { return std::sqrt(distribution.alpha_y); }
  PT_HD real most_roughness() const { return std::sqrt(distribution.alpha_x); }
};

namespace effects {

/// Brushed surfaces, which spread light more along one direction (KHR_materials_anisotropy).
struct anisotropy {
  static constexpr char const* name = "anisotropy";
  struct material_part {
    real anisotropy = 0;
    real anisotropy_rotation = 0;  ///< radians, counter-clockwise from the direction of u
  };
  static constexpr property<material_part> material_properties[] = {
      number_property("extensions/KHR_materials_anisotropy/anisotropyStrength",
                      &material_part::anisotropy, 0, 1),
      number_property("extensions/KHR_materials_anisotropy/anisotropyRotation",
                      &material_part::anisotropy_rotation, -1e3, 1e3)};

  template <class Material>
  static bool fits(Material const& m) {
    return m.anisotropy > 0;
  }

  template <class Point>
  PT_HD static basic_plastic<brushed_lobe> bsdf(Point const& p) {
    auto const& m = p.material;
    plastic_terms const terms(p.plastic_parameters(p.color));
    vec2 const u = p.direction_of_u();
    real const c = std::cos(m.anisotropy_rotation),
               s = p.side_of_v() * std::sin(m.anisotropy_rotation);
    real const alpha = terms.lobe.distribution.alpha;
    turned_ggx const distribution{glm::mix(alpha, real(1), m.anisotropy * m.anisotropy), alpha,
                                  c * u.x - s * u.y, s * u.x + c * u.y};
    return {brushed_lobe{{distribution, terms.lobe.f0, terms.lobe.f90}}, terms, p.scene.tables};
  }
};

}  // namespace effects
}  // namespace path_tracer
