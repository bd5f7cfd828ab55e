// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "effects/effect.hpp"
#include "shading/bsdf_layers.hpp"

namespace path_tracer {

/// The lobe of KHR_materials_clearcoat: a dielectric of F0 0.04, scaled by its factor.
struct coat_lobe {
  real factor, roughness;
  albedo_tables const* tables;

  PT_HD bsdf_value value(vec3 wo, vec3 wi) const { return lobe().value(wo, wi); }
  PT_HD vec3 direction(vec3 wo, vec3 u) const { return lobe().direction(wo, u); }
  PT_HD real albedo(real cos_theta) const {
    vec2 const e = tables->ggx(cos_theta, roughness);
    return factor * (real(0.04) * e.x + e.y);
  }
  /// What is not reflected by Fresnel's term of the viewer, as the extension has it: not
  /// reciprocal.
  PT_HD real through(vec3 wo, vec3) const {
    return 1 - factor * (real(0.04) + real(0.96) * schlick_weight(wo.z));
  }

 private:
  PT_HD specular_lobe lobe() const {
    return {{alpha_of(roughness)}, vec3{real(0.04) * factor}, vec3{factor}};
  }
};
namespace effects {

/// A clear varnish over a plastic or a metal (KHR_materials_clearcoat).
struct clearcoat {
  static constexpr char const* name = "clearcoat";
  struct material_part {
    real clearcoat = 0, clearcoat_roughness = 0;
  };
  static constexpr property<material_part> material_properties[] = {
      number_property("extensions/KHR_materials_clearcoat/clearcoatFactor",
                      &material_part::clearcoat, 0, 1),
      number_property("extensions/KHR_materials_clearcoat/clearcoatRoughnessFactor",
                      &material_part::clearcoat_roughness, 0, 1)};

  template <class Material>
  static bool fits(Material const& m) {
    return m.clearcoat > 0;
  }
  template <class Point>
  PT_HD static bsdf_layered<coat_lobe, bsdf_plastic> bsdf(Point const& p) {
    auto const& m = p.material;
    return {{m.clearcoat, m.clearcoat_roughness, p.scene.tables},
            p.plastic(p.color),
            luminance(p.color)};
  }
};

}  // namespace effects
}  // namespace path_tracer
