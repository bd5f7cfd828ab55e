// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "effects/effect.hpp"
#include "shading/bsdf.hpp"

namespace path_tracer::effects {

/// Surfaces that emit light. Paths that hit them collect it, and next-event estimation samples them
/// from all other surfaces. Apart from the emission, they are matte.
struct emitters {
  static constexpr char const* name = "emitters";

  template <class Material>
  static bool fits(Material const& m) {
    return max_component(m.emission) > 0;
  }
  template <class Point>
  PT_HD static bsdf_matte bsdf(Point const& p) {
    return {p.color};
  }
};

}  // namespace path_tracer::effects
