// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "effects/effect.hpp"
#include "shading/bsdf.hpp"

// The plain opaque materials: glTF's metallic-roughness model, and its special cases in which one
// of its two terms is 0.
namespace path_tracer::effects {

/// A conductor.
struct metal {
  static constexpr char const* name = "metal";

  template <class Material>
  static bool fits(Material const& m) {
    return m.metallic >= metal_from && m.metallic_roughness_texture < 0;
  }
  template <class Point>
  PT_HD static bsdf_metal bsdf(Point const& p) {
    auto const parameters = p.plastic_parameters(p.color);
    return {{{alpha_of(parameters.roughness)}, p.color, vec3{1}}};
  }
};

/// Diffuse reflection alone.
struct matte {
  static constexpr char const* name = "matte";

  template <class Material>
  static bool fits(Material const& m) {
    return m.metallic == 0 && m.specular == 0;
  }
  template <class Point>
  PT_HD static bsdf_matte bsdf(Point const& p) {
    return {p.color};
  }
};

/// The whole metallic-roughness model, for materials that no other shader fits.
struct plastic {
  static constexpr char const* name = "plastic";

  template <class Material>
  static bool fits(Material const&) {
    return true;
  }
  template <class Point>
  PT_HD static bsdf_plastic bsdf(Point const& p) {
    return p.plastic(p.color);
  }
};

}  // namespace path_tracer::effects
