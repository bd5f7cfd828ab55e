// SPDX-License-Identifier: Apache-2.0
#pragma once

// Scenes built in code, for the tests of the renderer.

#include <algorithm>
#include <cmath>
#include <cstring>

#include "app/render.hpp"

namespace path_tracer {

inline void add_quad(scene& s, vec3 corner, vec3 e1, vec3 e2, std::uint32_t material) {
  vec3 const n = glm::normalize(glm::cross(e1, e2));
  vec3 const p[4] = {corner, corner + e1, corner + e1 + e2, corner + e2};
  vec2 const uv[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (int k = 0; k < 2; ++k) {
    triangle t{};
    int const index[3] = {0, k + 1, k + 2};
    for (int j = 0; j < 3; ++j) {
      t.position[j] = p[index[j]];
      t.normal[j] = n;
      t.uv[j] = uv[index[j]];
    }
    t.material = material;
    s.triangles.push_back(t);
  }
}

/// A box of half size `h` about `c` whose faces look inwards (or outwards).
inline void add_box(scene& s, vec3 c, vec3 h, std::uint32_t material, bool inwards) {
  for (int axis = 0; axis < 3; ++axis)
    for (float const side : {-1.0f, 1.0f}) {
      vec3 a{0}, b{0}, corner = c - h;
      a[(axis + 1) % 3] = 2 * h[(axis + 1) % 3];
      b[(axis + 2) % 3] = 2 * h[(axis + 2) % 3];
      if (side > 0) corner[axis] += 2 * h[axis];
      bool const swap = (side > 0) == inwards;
      add_quad(s, corner, swap ? b : a, swap ? a : b, material);
    }
}

inline scene box_of(material const& m) {
  scene s;
  s.materials = {m};
  add_box(s, {0, 0, 0}, vec3{1}, 0, true);
  s.view.tan_half_yfov = 0.7f;
  return s;
}

/// The material of room() that runs the shader of an effect.
template <class Effect>
material& of_shader(scene& s) {
  return s.materials[number_of<Effect>];
}

/// A room with an object of each kind, a lamp, a hole to the sky and all three punctual lights.
inline scene room() {
  scene s;
  s.materials.resize(shader_count);
  for (int k = 0; k < shader_count; ++k) {
    material& m = s.materials[static_cast<std::size_t>(k)];
    m.kind = static_cast<shader>(k);
    m.base_color = {0.9f, 0.4f + 0.05f * static_cast<float>(k), 0.3f};
    m.roughness = 0.3f;
    m.two_sided = true;
    m.clearcoat = 1;
    m.clearcoat_roughness = 0.1f;
    m.sheen_color = {0.5f, 0.6f, 0.7f};
    m.sheen_roughness = 0.5f;
    m.transmission = m.kind == shader_of<effects::rough_glass> ? 0.8f : 1;
    m.second_color = {0.1f, 0.05f, 0};
    m.pattern_scale = 3;
    m.thickness = 1;
    m.attenuation_color = {0.9f, 0.5f, 0.2f};
    m.attenuation_distance = 0.3f;
    effects::absorption::prepare(m);
    m.dispersion = 2;
    m.iridescence = 0.9f;
    effects::iridescence::prepare(m);
    m.anisotropy = 0.8f;
    m.anisotropy_rotation = 0.5f;
  }
  of_shader<effects::metal>(s).metallic = 1;
  of_shader<effects::emitters>(s).emission = {9, 8, 7};
  // A texture of 2 x 2, for colour, for roughness and metal, and for normals.
  s.texels = {0xff2040ffu, 0xff80ff20u, 0xffff8040u, 0xffc0c0c0u, 0xffff8080u, 0xffe06070u};
  s.textures.resize(2);
  s.textures[0].width = s.textures[0].height = 2;
  s.textures[0].srgb = true;
  s.textures[1].width = 2;
  s.textures[1].height = 1;
  s.textures[1].offset = 4;
  of_shader<effects::matte>(s).base_color_texture = 0;
  of_shader<effects::plastic>(s).metallic_roughness_texture = 1;
  of_shader<effects::plastic>(s).normal_texture = 1;
  add_box(s, {0, 0, 0}, {3, 2, 3}, number_of<effects::matte>, true);
  s.triangles.resize(s.triangles.size() - 2);  // open at the front
  int place = 0;
  for (std::uint32_t k = 0; k + 1 < shader_count; ++k) {
    if (k == number_of<effects::matte> || k == number_of<effects::emitters> ||
        k == number_of<effects::medium>)
      continue;
    float const x = -2.5f + 0.53f * static_cast<float>(place), z = place % 2 == 0 ? -0.2f : 0.2f;
    add_box(s, {x, -1 + 0.15f * static_cast<float>(place++ % 3), z}, vec3{0.24f}, k, false);
  }
  add_quad(s, {-0.5f, 1.9f, -0.5f}, {1, 0, 0}, {0, 0, 1}, number_of<effects::emitters>);
  for (int k = 0; k < 3; ++k) {
    punctual_light light;
    light.kind = static_cast<punctual_light::type>(k);
    light.position = {static_cast<float>(k) - 1, 1, 1};
    light.direction = glm::normalize(vec3{0.1f, -1, -0.3f});
    light.intensity = vec3{1.0f + static_cast<float>(k)};
    s.lights.push_back(light);
  }
  s.background = {0.2f, 0.3f, 0.4f};
  s.medium_scattering = {0.01f, 0.02f, 0.03f};
  s.medium_absorption = {0.01f, 0.01f, 0};
  s.medium_anisotropy = 0.3f;
  s.sky = {2, 2, {vec3{0}, vec3{0.1f, 0.2f, 0.3f}, vec3{1}, vec3{3, 2, 1}}};
  s.view.position = {0, 0, 5};
  return s;
}

inline render_settings small(std::uint32_t samples, std::uint32_t depth,
                             std::string const& backend = "cpp") {
  render_settings settings;
  settings.width = 48;
  settings.height = 27;
  settings.samples = samples;
  settings.max_depth = depth;
  settings.backend = backend;
  return settings;
}

inline bool same_bits(render_result const& a, render_result const& b) {
  return a.pixels.size() == b.pixels.size() && a.rays == b.rays &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(vec3)) == 0;
}

/// The mean over the picture, and how far it may be off (five standard errors, over the pixels).
inline glm::dvec2 mean_and_error(render_result const& r, int channel = 1) {
  double sum = 0, squares = 0;
  for (vec3 const& p : r.pixels) {
    double const v = double{p[channel]};
    sum += v;
    squares += v * v;
  }
  auto const n = static_cast<double>(r.pixels.size());
  double const mean = sum / n;
  return {mean, 5 * std::sqrt(std::max(squares / n - mean * mean, 0.0) / n) + 1e-5};
}

}  // namespace path_tracer
