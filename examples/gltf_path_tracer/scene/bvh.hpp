// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

#include "scene/math.hpp"

namespace path_tracer {

struct ray {
  vec3 origin;
  vec3 direction;  ///< of any length; distances count in multiples of it
  real t_max;      ///< hits lie in (0, t_max)
};

inline constexpr std::uint32_t no_primitive = 0xffffffffu;

struct hit {
  real t = 0;
  vec2 barycentric{0};  ///< weights of the second and third corner
  std::uint32_t primitive = no_primitive;
};

/// An inner node: the boxes of its two children, and references to these. A reference to a leaf has
/// the top bit set, then 3 bits for the number of triangles minus one, then 28 bits for the first
/// triangle.
struct alignas(64) bvh_node {
  real corner[2][2][3];  ///< of each child, the lower and the upper
  std::uint32_t child[2];
};

inline constexpr std::uint32_t leaf_flag = 0x80000000u;
inline constexpr std::uint32_t max_bvh_triangles = 1u << 28;
inline constexpr int max_bvh_depth = 60;  ///< levels of inner nodes; the builder keeps to it

struct bvh_triangle {
  real corner[3][3];
  std::uint32_t primitive;  ///< its number in the scene
};

/// A built hierarchy as rays see it; node 0 is the root.
struct bvh_view {
  bvh_node const* nodes;
  bvh_triangle const* triangles;
};

/// The ray for the watertight test of Woop, Benthin and Wald, JCGT 2013: the largest axis becomes
/// z, and a shear turns the ray into the z axis, of unit length.
class sheared_ray {
 public:
  PT_HD explicit sheared_ray(ray const& r) {
    vec3 const a = glm::abs(r.direction);
    z_ = a.x > a.y ? (a.x > a.z ? 0 : 2) : (a.y > a.z ? 1 : 2);
    x_ = z_ == 2 ? 0 : z_ + 1;
    y_ = x_ == 2 ? 0 : x_ + 1;
    origin_ = {r.origin[x_], r.origin[y_], r.origin[z_]};
    vec3 const d{r.direction[x_], r.direction[y_], r.direction[z_]};
    shear_ = {d.x / d.z, d.y / d.z, 1 / d.z};
  }

  /// Sets `h` to the triangle if it is hit nearer than `h.t`. Returns whether it did.
  PT_HD bool intersect(bvh_triangle const& triangle, hit& h) const {
    vec3 const a = shifted(triangle.corner[0]);
    vec3 const b = shifted(triangle.corner[1]);
    vec3 const c = shifted(triangle.corner[2]);
    vec2 const pa{a.x - shear_.x * a.z, a.y - shear_.y * a.z};
    vec2 const pb{b.x - shear_.x * b.z, b.y - shear_.y * b.z};
    vec2 const pc{c.x - shear_.x * c.z, c.y - shear_.y * c.z};
    real u = pc.x * pb.y - pc.y * pb.x;
    real v = pa.x * pc.y - pa.y * pc.x;
    real w = pb.x * pa.y - pb.y * pa.x;
    if (u == 0 || v == 0 || w == 0) {  // on an edge: the sign needs the exact product
      u = edge(pc, pb);
      v = edge(pa, pc);
      w = edge(pb, pa);
    }
    if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return false;
    real const det = u + v + w;
    if (det == 0) return false;
    real const t = distance(triangle, (u * a.z + v * b.z + w * c.z) / det) * shear_.z;
    if (!(t > 0 && t < h.t)) return false;
    h = {t, {v / det, w / det}, triangle.primitive};
    return true;
  }

 private:
  /// The distance to the plane of a triangle, along z. By float's digits alone, it would be off by
  /// those of the triangle's extent, and rays that start on a large triangle would meet it.
  /// `about` is that distance without the last digits: it counts where the plane is seen edge-on.
  PT_HD real distance(bvh_triangle const& triangle, real about) const {
    if constexpr (sizeof(real) < sizeof(double)) {
      glm::dvec3 corner[3];
      for (int k = 0; k < 3; ++k) {
        real const* const p = triangle.corner[k];
        corner[k] = glm::dvec3(p[x_], p[y_], p[z_]) - glm::dvec3(origin_);
      }
      glm::dvec3 const n = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
      double const slope = n.x * double{shear_.x} + n.y * double{shear_.y} + n.z;
      if (slope == 0) return about;
      double const low = glm::min(corner[0].z, glm::min(corner[1].z, corner[2].z));
      double const high = glm::max(corner[0].z, glm::max(corner[1].z, corner[2].z));
      return static_cast<real>(glm::clamp(glm::dot(n, corner[0]) / slope, low, high));
    } else {
      return about;
    }
  }
  PT_HD vec3 shifted(real const* p) const {
    return {p[x_] - origin_.x, p[y_] - origin_.y, p[z_] - origin_.z};
  }
  /// With the sign of the exact value.
  PT_HD static real edge(vec2 p, vec2 q) {
    if constexpr (sizeof(real) < sizeof(double)) {
      return static_cast<real>(double{p.x} * double{q.y} - double{p.y} * double{q.x});
    } else {  // Kahan's: the rounding of one product, found by fma
      real const product = p.y * q.x;
      return std::fma(p.x, q.y, -product) - std::fma(p.y, q.x, -product);
    }
  }

  vec3 origin_, shear_;
  int x_, y_, z_;
};

/// 1 / x; for 0, infinity with its sign, as in IEEE 754.
PT_HD inline real inverse_of(real x) { return x == 0 ? std::copysign(real(INFINITY), x) : 1 / x; }

/// A ray for the slab test.
class slab_ray {
 public:
  PT_HD explicit slab_ray(ray const& r) {
    for (int k = 0; k < 3; ++k) {
      origin_[k] = r.origin[k];
      inverse_[k] = inverse_of(r.direction[k]);
      entry_[k] = inverse_[k] < 0 ? 1 : 0;
    }
  }
  /// Where the ray enters a box, or infinity. Never misses a box that it touches: the far distance
  /// is rounded up by the bound of Ize, JCGT 2013, and a NaN (0 times infinity) constrains nothing.
  PT_HD real enter(real const (&corner)[2][3], real t_max) const {
    real first = 0, last = t_max;
    for (int k = 0; k < 3; ++k) {
      real const t0 = (corner[entry_[k]][k] - origin_[k]) * inverse_[k];
      real const t1 = (corner[1 - entry_[k]][k] - origin_[k]) * inverse_[k] * (1 + 3 * epsilon);
      first = t0 > first ? t0 : first;
      last = t1 < last ? t1 : last;
    }
    return first <= last ? first : INFINITY;
  }

 private:
  real origin_[3], inverse_[3];
  int entry_[3];  // which corner of a box is met first, per axis
};

/// The nearest hit of a ray, or with AnyHit the first one found; `primitive` marks a miss.
/// `triangles[i]` are those of the hierarchy, inside the boxes of its nodes.
template <bool AnyHit, class Triangles>
PT_HD hit traverse(bvh_view const& bvh, Triangles const& triangles, ray const& r) {
  std::uint32_t stack[max_bvh_depth + 1];  // each level leaves one child behind at most
  real entry[max_bvh_depth + 1];           // where the ray enters it
  int size = 0;
  sheared_ray const sheared{r};
  slab_ray const slabs{r};
  hit h{};
  h.t = r.t_max;
  std::uint32_t at = 0;
  for (;;) {
    if (at & leaf_flag) {
      std::uint32_t const first = at & (max_bvh_triangles - 1);
      std::uint32_t const last = first + ((at >> 28) & 7u);
      for (std::uint32_t i = first; i <= last; ++i)
        if (sheared.intersect(triangles[i], h) && AnyHit) return h;
    } else {
      bvh_node const& node = bvh.nodes[at];
      real const t0 = slabs.enter(node.corner[0], h.t);
      real const t1 = slabs.enter(node.corner[1], h.t);
      bool const second_first = t1 < t0;
      real const nearer = second_first ? t1 : t0, farther = second_first ? t0 : t1;
      if (nearer < INFINITY) {
        at = node.child[second_first ? 1 : 0];
        if (farther < INFINITY) {
          stack[size] = node.child[second_first ? 0 : 1];
          entry[size++] = farther;
        }
        continue;
      }
    }
    do {
      if (size == 0) return h;
      at = stack[--size];
    } while (entry[size] > h.t);
  }
}

PT_HD inline hit closest_hit(bvh_view const& bvh, ray const& r) {
  return traverse<false>(bvh, bvh.triangles, r);
}

PT_HD inline bool any_hit(bvh_view const& bvh, ray const& r) {
  return traverse<true>(bvh, bvh.triangles, r).primitive != no_primitive;
}

}  // namespace path_tracer
