// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "effects/effect.hpp"

namespace path_tracer {

/// Where the corners of a triangle are when the shutter closes; in between they move in a straight
/// line. (For a rotation that is a chord: keep the shutter short.)
struct triangle_motion {
  vec3 position[3];
  vec3 normal[3];
};

namespace effects {

/// Nodes that a file animates, seen through a shutter that is open from `shutter_open` to
/// `shutter_close`, seconds of the animation, by `extras` of the camera. Every path has a moment of
/// its own. Of the animations, those of a node's translation, rotation and scale count.
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
