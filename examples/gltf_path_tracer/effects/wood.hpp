// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "effects/effect.hpp"
#include "shading/noise.hpp"

namespace path_tracer::effects {

/// Rings of a second colour through polished wood.
struct wood {
  static constexpr char const* name = "wood";
  struct material_part {
    bool is_wood = false;
  };
  static constexpr property<material_part> material_properties[] = {
      word_property("extras/shader", "wood", &material_part::is_wood)};

  template <class Material>
  static bool fits(Material const& m) {
    return m.is_wood;
  }
  template <class Point>
  PT_HD static auto bsdf(Point const& p) {
    real const ring =
        wood_pattern((p.at.position + p.scene.origin) * p.material.pattern_scale, p.scene.octaves);
    return p.plastic(glm::mix(p.color, p.material.second_color, ring));
  }
};

}  // namespace path_tracer::effects
