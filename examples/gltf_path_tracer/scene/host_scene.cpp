// SPDX-License-Identifier: Apache-2.0
#include "scene/host_scene.hpp"

#include <algorithm>

namespace path_tracer {
namespace {

std::vector<real> srgb_table() {
  std::vector<real> table;
  for (int code = 0; code < 256; ++code)
    table.push_back(srgb_to_linear(static_cast<real>(code) / real(255)));
  return table;
}

}  // namespace

host_scene::host_scene(scene const& s, accuracy_settings const& accuracy)
    : source(s),
      hierarchy(build_bvh(s.triangles, s.motion)),
      lights(s, accuracy.light),
      octaves(static_cast<int>(accuracy.octaves)),
      linear(srgb_table()) {}

scene_view host_scene::view() const {
  texture_view const textures{source.textures.data(), source.texels.data(), linear.data()};
  light_view all_lights = lights.view(source);
  all_lights.textures = textures;
  return {hierarchy.view(),
          source.triangles.data(),
          source.materials.data(),
          textures,
          all_lights,
          &host_albedo_tables(),
          source.view,
          source.background,
          {source.medium_scattering, source.medium_scattering + source.medium_absorption,
           source.medium_anisotropy},
          source.motion.empty() ? nullptr : source.motion.data(),
          octaves,
          source.origin,
          std::any_of(source.materials.begin(), source.materials.end(), [](material const& m) {
            return m.thin && m.kind == shader_of<effects::smooth_glass>;
          })};
}

}  // namespace path_tracer
