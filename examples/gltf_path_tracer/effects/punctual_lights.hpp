// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "effects/effect.hpp"

namespace path_tracer::effects {

/// Point, spot and directional lights (KHR_lights_punctual), by next-event estimation.
struct punctual_lights {
  static constexpr char const* name = "punctual-lights";

  template <class Scene>
  static bool in_scene(Scene const& s) {
    return !s.lights.empty();
  }
  template <class Scene>
  static std::string callers(Scene const& s) {
    return some_of("light", 0, s.light_names, s.lights.size());
  }
  template <class Scene>
  static void leave_out(Scene& s) {
    s.lights.clear();
    s.light_names.clear();
  }
};

}  // namespace path_tracer::effects
