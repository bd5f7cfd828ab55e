// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "effects/effect.hpp"
#include "shading/bsdf.hpp"

namespace path_tracer::effects {

/// Surfaces that emit light, besides what they reflect. Paths that hit them collect it, and
/// next-event estimation samples them from all other surfaces. Every shader adds emission, if the
/// set has this effect; that of the effect itself is for matte ones.
struct emitters {
  static constexpr char const* name = "emitters";

  template <class Material>
  static bool in_material(Material const& m) {
    return max_component(m.emission) > 0;
  }
  template <class Material>
  static bool fits(Material const& m) {
    return in_material(m) && m.metallic == 0 && m.specular == 0;
  }
  template <class Scene>
  static void leave_out(Scene& s) {
    for (auto& m : s.materials) m.emission = vec3{0};
  }
  template <class Point>
  PT_HD static bsdf_matte bsdf(Point const& p) {
    return {p.color};
  }
};

}  // namespace path_tracer::effects
