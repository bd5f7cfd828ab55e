// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "effects/effect.hpp"
#include "effects/glass.hpp"

namespace path_tracer::effects {

/// Glass that absorbs light (KHR_materials_volume): exp(-extinction * length), Beer and Lambert's
/// law. It applies to path segments that end at the inner side of glass, not to those that end at
/// an object inside the glass.
struct absorption {
  static constexpr char const* name = "absorption";
  struct material_part {
    real thickness = 0;  ///< 0: the surface has no inside
    vec3 attenuation_color{1};
    real attenuation_distance = 0;  ///< after which white light has that colour; 0: never
    vec3 extinction{0};             ///< per unit of length in the world
  };
  static constexpr property<material_part> material_properties[] = {
      number_property("extensions/KHR_materials_volume/thicknessFactor", &material_part::thickness,
                      0, 1e30),
      color_property("extensions/KHR_materials_volume/attenuationColor",
                     &material_part::attenuation_color, 0, 1),
      number_property("extensions/KHR_materials_volume/attenuationDistance",
                      &material_part::attenuation_distance, 1e-6, 1e30)};

  template <class Material>
  static void prepare(Material& m) {
    m.extinction = vec3{0};
    if (m.thickness > 0 && m.attenuation_distance > 0)
      for (int k = 0; k < 3; ++k)
        m.extinction[k] =
            -std::log(glm::max(m.attenuation_color[k], real(1e-30))) / m.attenuation_distance;
  }
  template <class Material>
  static bool in_material(Material const& m) {
    return is_glass(m) && max_component(m.extinction) > 0;
  }

  template <class Batch, class Point>
  PT_HD static void at_glass(Batch const& batch, std::uint32_t i, Point& p) {
    if (p.at.front || p.material.extinction == vec3{0}) return;
    real const length = glm::length(p.at.position - batch.origin[i]);
    batch.throughput[i] *= glm::exp(p.material.extinction * -length);
  }
};

}  // namespace path_tracer::effects
