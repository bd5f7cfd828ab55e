// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <type_traits>

#include "scene/bvh.hpp"
#include "scene/scene.hpp"
#include "shading/path.hpp"
#include "shading/path_draws.hpp"

namespace path_tracer {

/// A point between `open` and `close`, at a time in [0, 1). Despite rounding, it stays in the box
/// of the two.
PT_HD inline vec3 moved(vec3 open, vec3 close, real time) {
  return glm::clamp(open + time * (close - open), glm::min(open, close), glm::max(open, close));
}

PT_HD inline triangle triangle_at(triangle t, triangle_motion const& m, real time) {
  for (int k = 0; k < 3; ++k) {
    t.position[k] = moved(t.position[k], m.position[k], time);
    t.normal[k] = t.normal[k] + time * (m.normal[k] - t.normal[k]);
  }
  return t;
}

/// How far from a point of a triangle, along the normal, a ray must start to miss that triangle at
/// any angle: the rounding error along the normal of coordinates as large as those of its corners.
/// The extent of the triangle does not count where rays are of float, see sheared_ray and point_of.
PT_HD inline real clearance_of(triangle const& t) {
  vec3 const e1 = t.position[1] - t.position[0], e2 = t.position[2] - t.position[0];
  vec3 const normal = glm::abs(glm::normalize(glm::cross(e1, e2)));
  vec3 const reach =
      glm::max(glm::abs(t.position[0]), glm::max(glm::abs(t.position[1]), glm::abs(t.position[2])));
  real clearance = 2 * epsilon * glm::dot(normal, reach);
  if constexpr (sizeof(real) == sizeof(double)) {
    vec3 const extent = glm::max(glm::max(glm::abs(e1), glm::abs(e2)), glm::abs(e2 - e1));
    clearance += 16 * epsilon * max_component(extent);
  }
  return clearance;
}

/// A point of a triangle by the weights of its second and third corner, rounded once: the last
/// digits of large edges do not move it off the plane.
PT_HD inline vec3 point_of(triangle const& t, vec2 b) {
  glm::dvec3 const p(t.position[0]);
  return vec3(p + double{b.x} * (glm::dvec3(t.position[1]) - p) +
              double{b.y} * (glm::dvec3(t.position[2]) - p));
}

/// Triangle number `primitive` at a time if `Set` has motion blur; else as it lies in memory.
template <class Set>
using loaded_triangle =
    std::conditional_t<Set::template has<effects::motion_blur>, triangle, triangle const&>;
template <class Set>
PT_HD loaded_triangle<Set> load_triangle(triangle const* triangles, triangle_motion const* motion,
                                         std::uint32_t primitive, real time) {
  if constexpr (Set::template has<effects::motion_blur>) {
    if (motion != nullptr) return triangle_at(triangles[primitive], motion[primitive], time);
  }
  return triangles[primitive];
}

/// The area of a triangle in memory, divided by its area at the moment of `t`. The former gives the
/// probability of picking a light, the latter the density of its points.
template <class Set>
PT_HD real area_ratio(triangle const* triangles, triangle_motion const* motion,
                      std::uint32_t primitive, triangle const& t) {
  if constexpr (Set::template has<effects::motion_blur>) {
    auto const area = [](triangle const& of) {
      return glm::length(
          glm::cross(of.position[1] - of.position[0], of.position[2] - of.position[0]));
    };
    if (motion != nullptr) return area(triangles[primitive]) / area(t);
  }
  return 1;
}

/// The triangles of a hierarchy at a time, for traverse.
struct moving_triangles {
  bvh_triangle const* triangles;
  triangle_motion const* motion;
  real time;

  PT_HD bvh_triangle operator[](std::uint32_t i) const {
    bvh_triangle t = triangles[i];
    for (int k = 0; k < 3; ++k) {
      real const(&c)[3] = t.corner[k];
      vec3 const p = moved({c[0], c[1], c[2]}, motion[t.primitive].position[k], time);
      for (int axis = 0; axis < 3; ++axis) t.corner[k][axis] = p[axis];
    }
    return t;
  }
};

/// The moment at which a path sees the scene, in [0, 1) of the time that the shutter is open.
template <class Set>
PT_HD real time_of(basic_batch const& batch, std::uint32_t i) {
  if constexpr (Set::template has<effects::motion_blur>)
    return batch.random(i).pair(path_draw::time).x;
  return 0;
}

/// The nearest hit, or the first, of a scene that may move; see traverse.
template <class Set, bool AnyHit>
PT_HD hit find_hit(bvh_view const& bvh, triangle_motion const* motion, ray const& r, real time) {
  if constexpr (Set::template has<effects::motion_blur>) {
    if (motion != nullptr)
      return traverse<AnyHit>(bvh, moving_triangles{bvh.triangles, motion, time}, r);
  }
  return traverse<AnyHit>(bvh, bvh.triangles, r);
}

}  // namespace path_tracer
