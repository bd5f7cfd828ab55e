// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "effects/effects.hpp"
#include "scene/math.hpp"

namespace path_tracer {

/// The id of a finished path. It is outside the table, and the library skips the request.
inline constexpr std::uint8_t finished = 255;

/// A surface by the parameters of glTF 2.0; colours are linear.
struct basic_material {
  shader kind = shader_of<effects::matte>;
  vec3 base_color{real(0.8)};
  real metallic = 0;
  real roughness = 1;  ///< perceptual; alpha = roughness^2
  real ior = real(1.5);
  real transmission = 0;
  bool thin = false;  ///< glass without an inside: a pane, which does not bend light
  real specular = 1;  ///< KHR_materials_specular
  vec3 specular_color{1};
  vec3 emission{0};        ///< radiance: emissiveFactor * emissiveStrength; a texture scales it
  bool two_sided = false;  ///< emits from both sides; every surface is visible from both
  vec3 second_color{0};    ///< procedural shaders: the vein or the dark ring
  real pattern_scale = 1;  ///< procedural shaders: cycles per unit of world space length
};
struct material : basic_material, material_parts<all_effects> {};

/// One triangle: positions, shading normals and texture coordinates of its corners, world space.
struct triangle {
  vec3 position[3];
  vec3 normal[3];
  vec2 uv[3];
  std::uint32_t material;
};

/// 8-bit texels, row 0 on top as glTF has it; the loader converts colour to linear on lookup.
struct texture {
  std::uint32_t width = 0, height = 0;
  std::uint32_t offset = 0;  ///< first texel in scene::texels
  bool srgb = false;
  std::uint8_t wrap_s = 0, wrap_t = 0;  ///< 0 repeat, 1 clamp to edge, 2 mirrored repeat
  bool nearest = false;                 ///< else bilinear
};

struct punctual_light {
  enum class type : std::uint8_t { point, spot, directional } kind = type::point;
  vec3 position{0};
  vec3 direction{0, 0, -1};  ///< the way the light travels
  vec3 intensity{0};  ///< W/sr per channel (candela scale, linear RGB); directional: irradiance
  real range = 0;     ///< 0: unlimited
  real cos_inner = 1, cos_outer = 0;
};

/// A pinhole camera; `right`, `up`, `forward` are orthonormal.
struct basic_camera {
  vec3 position{0};
  vec3 right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, -1};
  real tan_half_yfov = real(0.5);
  real ortho_height = 0;  ///< half height of an orthographic view; 0 for a perspective one
};
struct camera : basic_camera, camera_parts<all_effects> {};

/// A scene as the loader leaves it: host memory, flat, all instances expanded.
struct scene : scene_parts<all_effects> {
  std::vector<triangle> triangles;
  std::vector<material> materials;
  std::vector<std::string> material_names;  ///< as the file has them; may be shorter
  std::vector<texture> textures;
  std::vector<std::uint32_t> texels;  ///< RGBA8, red in the lowest byte
  std::vector<punctual_light> lights;
  std::vector<std::string> light_names;  ///< as the file has them; may be shorter
  camera view;
  vec3 background{0};
  vec3 origin{0};                     ///< where the file has the origin of these coordinates
  std::vector<std::string> warnings;  ///< what the file asks for and the renderer leaves out
};

}  // namespace path_tracer
