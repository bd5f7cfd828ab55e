// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "effects/effect.hpp"
#include "shading/path_draws.hpp"

namespace path_tracer::effects {

/// A thin lens in place of the pinhole: `aperture_radius` and `focus_distance` in the `extras` of
/// a perspective camera. What lies at that distance along the camera's axis is sharp.
struct depth_of_field {
  static constexpr char const* name = "depth-of-field";
  struct camera_part {
    real aperture_radius = 0;
    real focus_distance = 1;
  };
  static constexpr property<camera_part> camera_properties[] = {
      number_property("extras/aperture_radius", &camera_part::aperture_radius, 0, 1e6),
      number_property("extras/focus_distance", &camera_part::focus_distance, 1e-6, 1e9)};

  template <class Camera>
  static bool in_camera(Camera const& c) {
    return c.aperture_radius > 0 && c.ortho_height == 0;
  }

  template <class Camera, class Random, class Ray>
  PT_HD static void camera_ray(Camera const& view, Random const& random, Ray& r) {
    if (!(view.aperture_radius > 0) || view.ortho_height > 0) return;
    vec2 const u = random.pair(path_draw::lens);
    real const radius = view.aperture_radius * std::sqrt(u.x), phi = 2 * pi * u.y;
    vec3 const aside = radius * (std::cos(phi) * view.right + std::sin(phi) * view.up);
    vec3 const focus = r.direction * (view.focus_distance / glm::dot(r.direction, view.forward));
    r.origin += aside;
    r.direction = glm::normalize(focus - aside);
  }
};

}  // namespace path_tracer::effects
