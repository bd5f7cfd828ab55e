// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "effects/effect.hpp"

namespace path_tracer::effects {

/// Images for colour, roughness, metal and emission.
struct textures {
  static constexpr char const* name = "textures";
  struct material_part {
    std::int32_t base_color_texture = no_texture;
    std::int32_t metallic_roughness_texture = no_texture;
    std::int32_t emissive_texture = no_texture;
    vec3 mean_emissive{1};  ///< over the texels of that
  };

  template <class Material>
  static bool in_material(Material const& m) {
    return m.base_color_texture != no_texture || m.metallic_roughness_texture != no_texture ||
           m.emissive_texture != no_texture;
  }
};

/// Images that bend the shading normal.
struct normal_maps {
  static constexpr char const* name = "normal-maps";
  struct material_part {
    std::int32_t normal_texture = no_texture;
    real normal_scale = 1;
  };

  template <class Material>
  static bool in_material(Material const& m) {
    return m.normal_texture != no_texture;
  }
};

}  // namespace path_tracer::effects
