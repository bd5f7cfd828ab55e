// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "effects/effect.hpp"
#include "shading/bsdf_layers.hpp"

namespace path_tracer {

/// The lobe of KHR_materials_sheen.
struct sheen_lobe {
  vec3 color;
  real roughness;
  albedo_tables const* tables;

  PT_HD bsdf_value value(vec3 wo, vec3 wi) const {
    if (wi.z <= 0) return {};
    return {color * charlie{sheen_alpha(roughness)}.reflect(wo, wi), 1 / (2 * pi)};
  }
  PT_HD vec3 direction(vec3, vec3 u) const { return polar(u.y, 2 * pi * u.x); }
  PT_HD real albedo(real cos_theta) const {
    return max_component(color) * tables->sheen(cos_theta, roughness);
  }
  PT_HD real through(vec3 wo, vec3 wi) const { return 1 - glm::max(albedo(wo.z), albedo(wi.z)); }
};
namespace effects {

/// The fuzz of cloth over a plastic (KHR_materials_sheen).
struct sheen {
  static constexpr char const* name = "sheen";
  struct material_part {
    vec3 sheen_color{0};
    real sheen_roughness = 0;
  };
  static constexpr property<material_part> material_properties[] = {
      color_property("extensions/KHR_materials_sheen/sheenColorFactor", &material_part::sheen_color,
                     0, 1),
      number_property("extensions/KHR_materials_sheen/sheenRoughnessFactor",
                      &material_part::sheen_roughness, 0, 1)};

  template <class Material>
  static bool fits(Material const& m) {
    return max_component(m.sheen_color) > 0;
  }
  template <class Point>
  PT_HD static bsdf_layered<sheen_lobe, bsdf_plastic> bsdf(Point const& p) {
    auto const& m = p.material;
    return {
        {m.sheen_color, m.sheen_roughness, p.scene.tables}, p.plastic(p.color), luminance(p.color)};
  }
};

}  // namespace effects
}  // namespace path_tracer
