// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "effects/effect.hpp"
#include "scene/environment_map.hpp"

namespace path_tracer::effects {

/// Light from all directions, from a picture: "environment" in the `extras` of a scene names an
/// equirectangular .hdr file beside the scene's. Light samples prefer its bright parts.
struct environment {
  static constexpr char const* name = "environment";
  struct scene_part {
    std::string environment_file;
    real environment_intensity = 1;
    real environment_rotation = 0;  ///< radians about y, counter-clockwise seen from above
    environment_map sky;
  };
  static constexpr property<scene_part> scene_properties[] = {
      text_property("extras/environment", &scene_part::environment_file),
      number_property("extras/environment_intensity", &scene_part::environment_intensity, 0, 1e30),
      number_property("extras/environment_rotation", &scene_part::environment_rotation, -1e3, 1e3)};

  template <class Scene>
  static bool in_scene(Scene const& s) {
    return !s.sky.texels.empty();
  }
  template <class Scene>
  static std::string callers(Scene const& s) {
    return "the environment \"" + s.environment_file + "\"";
  }
  template <class Scene>
  static void load(Scene& s, std::string const& folder) {
    if (!s.environment_file.empty())
      s.sky = load_environment(folder + s.environment_file, s.environment_intensity);
  }
};

}  // namespace path_tracer::effects
