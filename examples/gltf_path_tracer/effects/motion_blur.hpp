// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "effects/effect.hpp"

namespace path_tracer {

/// The corners of a triangle when the shutter closes. In between, they move in straight lines. (For
/// a rotation that is a chord: keep the shutter short.)
struct triangle_motion {
  vec3 position[3];
  vec3 normal[3];
};

namespace effects {

/// Animated nodes, seen through a shutter that is open from `shutter_open` to `shutter_close`, in
/// seconds of the animation: `extras` of the camera. Every path has its own moment. Animations of a
/// node's translation, rotation and scale count.
struct motion_blur {
  static constexpr char const* name = "motion-blur";
  struct camera_part {
    real shutter_open = 0, shutter_close = 0;
  };
  struct scene_part {
    std::vector<triangle_motion> motion;  ///< of each triangle; empty: nothing moves
  };
  static constexpr property<camera_part> camera_properties[] = {
      number_property("extras/shutter_open", &camera_part::shutter_open, 0, 1e6),
      number_property("extras/shutter_close", &camera_part::shutter_close, 0, 1e6)};

  template <class Scene>
  static bool in_scene(Scene const& s) {
    return !s.motion.empty();
  }
};

}  // namespace effects
}  // namespace path_tracer
