// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "effects/effect.hpp"
#include "shading/bsdf.hpp"
#include "shading/noise.hpp"

namespace path_tracer::effects {

/// Veins of a second colour through a matte stone.
struct marble {
  static constexpr char const* name = "marble";
  struct material_part {
    bool is_marble = false;
  };
  static constexpr property<material_part> material_properties[] = {
      word_property("extras/shader", "marble", &material_part::is_marble)};

  template <class Material>
  static bool fits(Material const& m) {
    return m.is_marble;
  }
  template <class Point>
  PT_HD static bsdf_matte bsdf(Point const& p) {
    real const vein = marble_pattern((p.at.position + p.scene.origin) * p.material.pattern_scale,
                                     p.scene.octaves);
    return {glm::mix(p.color, p.material.second_color, vein)};
  }
};

}  // namespace path_tracer::effects
