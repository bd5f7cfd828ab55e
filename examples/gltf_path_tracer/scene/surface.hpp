// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "scene/bvh.hpp"
#include "scene/lights.hpp"
#include "scene/motion.hpp"
#include "scene/texture.hpp"
#include "shading/albedo.hpp"

namespace path_tracer {

/// A scene as rays and shaders see it.
struct scene_view {
  bvh_view bvh;
  triangle const* triangles;
  material const* materials;
  texture_view textures;
  light_view lights;
  albedo_tables const* tables;
  camera view;
  vec3 background;
  medium_view medium;
  triangle_motion const* motion;  ///< null: nothing moves
  int octaves;                    ///< of procedural textures, at most
  vec3 origin;                    ///< of coordinates, in those of the file
  bool has_panes;                 ///< thin, smooth glass, which shadow rays pass
};

PT_HD inline vec3 geometric_normal(triangle const& t) {
  return glm::normalize(glm::cross(t.position[1] - t.position[0], t.position[2] - t.position[0]));
}

/// The point that a ray hit, and the frame in which its BSDF works.
struct surface {
  vec3 position;
  vec3 geometric;            ///< normal of the triangle, on the side of the viewer
  real clearance;            ///< see clearance_of
  vec3 tangent, up, normal;  ///< the shading frame
  vec3 wo;                   ///< towards the viewer, in that frame; wo.z > 0
  vec2 uv;
  std::uint32_t material;
  bool front;  ///< the viewer is on the side from which the corners turn left

  PT_HD vec3 to_world(vec3 v) const { return v.x * tangent + v.y * up + v.z * normal; }
  PT_HD vec3 to_local(vec3 v) const {
    return {glm::dot(v, tangent), glm::dot(v, up), glm::dot(v, normal)};
  }
  /// Whether `wi` is on the same side of the triangle as of the shading normal: else light would
  /// leak through, or vanish, where the two normals differ.
  PT_HD bool consistent(vec3 local, vec3 world) const {
    return local.z * glm::dot(world, geometric) > 0;
  }
  PT_HD vec3 start_towards(vec3 world) const {
    return position + (glm::dot(world, geometric) > 0 ? clearance : -clearance) * geometric;
  }
};

/// An orthonormal frame about `n` whose tangent is as near to `hint` as possible. If the hint is
/// degenerate, any frame (by Duff et al., JCGT 2017).
PT_HD inline void set_frame(surface& s, vec3 n, vec3 hint) {
  s.normal = n;
  vec3 const t = hint - n * glm::dot(n, hint);
  real const length2 = glm::dot(t, t), hint2 = glm::dot(hint, hint);
  if (length2 > real(1e-12) * hint2 && length2 < INFINITY) {
    s.tangent = t / std::sqrt(length2);
    if (length2 < real(0.25) * hint2)  // what cancellation has left of n
      s.tangent = glm::normalize(s.tangent - n * glm::dot(n, s.tangent));
  } else {
    real const sign = n.z < 0 ? real(-1) : real(1);
    real const a = -1 / (sign + n.z);
    s.tangent = {1 + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x};
  }
  s.up = glm::cross(n, s.tangent);
}

/// Bends `n` as little as needed for the viewer, in direction `wo`, to see its front.
PT_HD inline vec3 face_viewer(vec3 n, vec3 wo) {
  real const cos_o = glm::dot(n, wo);
  return cos_o > real(1e-3) ? n : glm::normalize(n + (real(1e-3) - cos_o) * wo);
}

/// Bends `n` as little as needed for a mirror to turn the viewer's direction to the side of the
/// geometric normal on which the viewer is: else a mirror would be black at its rim.
PT_HD inline vec3 reflect_above(vec3 n, vec3 geometric, vec3 wo) {
  // Clear of it: the narrowest lobe, of alpha 0.002, has tails.
  real const least = glm::min(real(0.05), real(0.9) * glm::dot(wo, geometric));
  vec3 const reflected = 2 * glm::dot(n, wo) * n - wo;
  real const above = glm::dot(reflected, geometric);
  if (!(above < least)) return n;
  return glm::normalize(wo + glm::normalize(reflected + (least - above) * geometric));
}

/// The derivatives of the position on a triangle by the texture coordinates u and v, up to a
/// positive factor; 0 if these are degenerate.
struct texture_axes {
  vec3 u{0}, v{0};
};
PT_HD inline texture_axes axes_of(triangle const& t) {
  vec3 const e1 = t.position[1] - t.position[0], e2 = t.position[2] - t.position[0];
  vec2 const d1 = t.uv[1] - t.uv[0], d2 = t.uv[2] - t.uv[0];
  real const det = d1.x * d2.y - d1.y * d2.x;
  if (det == 0) return {};
  return {(e1 * d2.y - e2 * d1.y) / det, (e2 * d1.x - e1 * d2.x) / det};
}

/// The tangent space of glTF: x along u, y against v, for which images run downwards.
PT_HD inline vec3 mapped_normal(scene_view const& scene, triangle const& t, material const& m,
                                vec2 uv, vec3 n) {
  texture_axes const axes = axes_of(t);
  if (axes.u == vec3{0} && axes.v == vec3{0}) return n;
  surface frame;
  set_frame(frame, n, axes.u);
  real const side = glm::dot(frame.up, axes.v) > 0 ? real(-1) : real(1);
  vec4 const texel = sample_texture(scene.textures, m.normal_texture, uv);
  vec3 const v = (vec3(texel) * real(2) - real(1)) * vec3{m.normal_scale, m.normal_scale, 1};
  vec3 const bent = v.x * frame.tangent + side * v.y * frame.up + v.z * n;
  return glm::dot(bent, bent) > 0 ? glm::normalize(bent) : n;
}

template <class Set>
PT_HD surface load_surface(scene_view const& scene, loaded_triangle<Set> t, vec2 b,
                           vec3 direction) {
  real const b0 = 1 - b.x - b.y;
  surface s;
  s.position = point_of(t, b);
  s.uv = b0 * t.uv[0] + b.x * t.uv[1] + b.y * t.uv[2];
  s.material = t.material;
  s.geometric = geometric_normal(t);
  s.clearance = clearance_of(t);
  s.front = glm::dot(s.geometric, direction) < 0;
  vec3 n = b0 * t.normal[0] + b.x * t.normal[1] + b.y * t.normal[2];
  n = glm::dot(n, n) > 0 ? glm::normalize(n) : s.geometric;
  if constexpr (Set::template has<effects::normal_maps>) {
    material const& m = scene.materials[t.material];
    if (m.normal_texture != no_texture) n = mapped_normal(scene, t, m, s.uv, n);
  }
  if (!s.front) {
    s.geometric = -s.geometric;
    n = -n;
  }
  n = face_viewer(n, -direction);
  shader const kind = scene.materials[t.material].kind;
  bool const matte = kind == shader_of<effects::matte> || kind == shader_of<effects::emitters> ||
                     kind == shader_of<effects::marble>;
  if (!matte) n = face_viewer(reflect_above(n, s.geometric, -direction), -direction);
  set_frame(s, n, t.position[1] - t.position[0]);
  s.wo = s.to_local(-direction);
  return s;
}

}  // namespace path_tracer
