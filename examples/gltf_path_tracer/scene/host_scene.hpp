// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/bvh_builder.hpp"
#include "scene/lights.hpp"
#include "scene/scene.hpp"
#include "scene/surface.hpp"

namespace path_tracer {

/// A scene and what rendering adds to it, in host memory. The scene must outlive it.
struct host_scene {
  explicit host_scene(scene const& s, accuracy_settings const& accuracy = {});
  /// What rays and shaders see, where they run on the host.
  scene_view view() const;

  scene const& source;
  bvh hierarchy;
  light_list lights;
  int octaves;
  std::vector<real> linear;  ///< values of the 256 sRGB codes
};

}  // namespace path_tracer
