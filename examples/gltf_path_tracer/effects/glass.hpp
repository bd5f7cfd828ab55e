// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "effects/effect.hpp"
#include "shading/bsdf_glass.hpp"

namespace path_tracer::effects {

/// Whether a material transmits light (KHR_materials_transmission).
template <class Material>
bool is_glass(Material const& m) {
  return m.transmission > 0 && m.metallic < metal_from;
}

/// The share of the glass among the facets of a material. What is not metal transmits that much of
/// its light; `rest` becomes what is beside the glass.
template <class Material>
PT_HD real share_of_glass(Material const& m, plastic_parameters& rest) {
  real const share = m.transmission * (1 - rest.metallic);
  rest.metallic = share < 1 ? glm::min(rest.metallic / (1 - share), real(1)) : real(0);
  return share;
}

/// A perfectly smooth dielectric interface. Below this roughness, a GGX lobe (alpha < 0.0009) is
/// narrower than a pixel.
struct smooth_glass {
  static constexpr char const* name = "smooth-glass";
  static constexpr real below = real(0.03);
  using path_state = real;  ///< the length of a path from its last scattering to its last pane

  template <class Material>
  static bool fits(Material const& m) {
    return is_glass(m) && m.roughness < below;
  }
  template <class Material>
  static void prepare(Material& m) {
    m.roughness = 0;
  }
  template <class Point>
  PT_HD static bsdf_mix<bsdf_smooth_glass, bsdf_plastic> bsdf(Point const& p) {
    auto rest = p.plastic_parameters(p.color);
    real const share = share_of_glass(p.material, rest);
    return {{p.color, p.eta(), p.material.thin}, {rest, p.scene.tables}, share};
  }
  /// The share of light that goes straight through a pane.
  template <class Point>
  PT_HD static vec3 straight(Point const& p) {
    auto rest = p.plastic_parameters(p.color);
    real cos_t;
    real const f = fresnel_dielectric(p.at.wo.z, p.eta(), cos_t);
    return share_of_glass(p.material, rest) * (1 - f) * p.color;
  }
};

/// A dielectric interface with a GGX lobe.
struct rough_glass {
  static constexpr char const* name = "rough-glass";

  template <class Material>
  static bool fits(Material const& m) {
    return is_glass(m);
  }
  template <class Point>
  PT_HD static bsdf_mix<bsdf_rough_glass, bsdf_plastic> bsdf(Point const& p) {
    auto rest = p.plastic_parameters(p.color);
    real const share = share_of_glass(p.material, rest);
    return {{p.color, p.eta(), {alpha_of(rest.roughness)}, p.material.thin},
            {rest, p.scene.tables},
            share};
  }
};

/// Whether a shader is one of the two.
template <class Effect>
inline constexpr bool is_glass_shader =
    std::is_same_v<Effect, smooth_glass> || std::is_same_v<Effect, rough_glass>;

}  // namespace path_tracer::effects
