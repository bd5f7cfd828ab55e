// SPDX-License-Identifier: Apache-2.0
#pragma once

// Closed meshes, moved scenes and random numbers from a printed seed, for the tests of hard cases.

#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "bvh_support.hpp"
#include "scene/motion.hpp"

namespace path_tracer {

/// Numbers in double from a seed: full resolution, zero among them once in 2^53.
class fine_numbers {
 public:
  explicit fine_numbers(std::uint64_t seed) : state_(seed) {}
  double uniform() {
    state_ += 0x9e3779b97f4a7c15u;
    return static_cast<double>(mix_bits(state_) >> 11) * 0x1p-53;
  }
  /// From `low` to `high`, uniform in the logarithm.
  double over_decades(double low, double high) { return low * std::pow(high / low, uniform()); }
  glm::dvec3 on_sphere() {
    double const z = 2 * uniform() - 1, phi = 2 * std::acos(-1.0) * uniform();
    double const r = std::sqrt(std::max(0.0, 1 - z * z));
    return {r * std::cos(phi), r * std::sin(phi), z};
  }
  std::size_t below(std::size_t count) {
    return std::min(static_cast<std::size_t>(uniform() * static_cast<double>(count)), count - 1);
  }

 private:
  std::uint64_t state_;
};

/// A sphere of triangles that share their corners bit by bit, outside on the left: an icosahedron
/// whose edges were halved so many times.
inline std::vector<triangle> ball(glm::dvec3 centre, double radius, int halvings,
                                  std::uint32_t material = 0) {
  double const g = (1 + std::sqrt(5.0)) / 2;
  std::vector<glm::dvec3> points = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                                    {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                                    {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
  std::vector<glm::ivec3> faces = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                   {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                   {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                   {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int k = 0; k < halvings; ++k) {
    std::map<std::pair<int, int>, int> middles;
    auto const middle = [&](int a, int b) {
      auto const [at, is_new] =
          middles.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<int>(points.size()));
      if (is_new)
        points.push_back(points[static_cast<std::size_t>(a)] + points[static_cast<std::size_t>(b)]);
      points[static_cast<std::size_t>(at->second)] =
          glm::normalize(points[static_cast<std::size_t>(at->second)]);
      return at->second;
    };
    for (glm::dvec3& p : points) p = glm::normalize(p);
    std::vector<glm::ivec3> finer;
    for (glm::ivec3 const f : faces) {
      int const ab = middle(f.x, f.y), bc = middle(f.y, f.z), ca = middle(f.z, f.x);
      finer.insert(finer.end(), {{f.x, ab, ca}, {ab, f.y, bc}, {ca, bc, f.z}, {ab, bc, ca}});
    }
    faces = finer;
  }
  std::vector<triangle> triangles;
  for (glm::ivec3 const f : faces) {
    triangle t{};
    for (int k = 0; k < 3; ++k) {
      t.normal[k] = vec3(glm::normalize(points[static_cast<std::size_t>(f[k])]));
      t.position[k] =
          vec3(centre + radius * glm::normalize(points[static_cast<std::size_t>(f[k])]));
    }
    t.material = material;
    triangles.push_back(t);
  }
  return triangles;
}

/// A cube of side 2 `half` about `centre` whose faces are fans of slivers, down to 1 : 2^20, and of
/// triangles without area; faces share the corners on their common edges bit by bit.
inline std::vector<triangle> sliver_cube(glm::dvec3 centre, double half) {
  std::vector<double> places;
  for (int k = 20; k >= 0; --k) places.push_back(-1 + std::ldexp(1.0, -k));
  places.front() = -1;
  for (int k = 1; k <= 20; ++k) places.push_back(1 - std::ldexp(1.0, -k));
  places.back() = 1;
  std::vector<triangle> triangles;
  for (int axis = 0; axis < 3; ++axis)
    for (double const side : {-1.0, 1.0}) {
      std::vector<vec3> rim;
      auto const add = [&](double u, double v) {
        glm::dvec3 p;
        p[axis] = side;
        p[(axis + 1) % 3] = u;
        p[(axis + 2) % 3] = v;
        rim.push_back(vec3(centre + half * p));
      };
      std::size_t const last = places.size() - 1;
      for (std::size_t k = 0; k < last; ++k) add(places[k], -1);
      for (std::size_t k = 0; k < last; ++k) add(1, places[k]);
      for (std::size_t k = last; k > 0; --k) add(places[k], 1);
      for (std::size_t k = last; k > 0; --k) add(-1, places[k]);
      for (std::size_t k = 1; k + 1 < rim.size(); ++k)
        triangles.push_back(make_triangle(rim[0], rim[k], rim[k + 1]));
    }
  return triangles;
}

/// A point of a triangle, with weights that are uniform over its area.
inline vec2 place_on(fine_numbers& n) {
  double const root = std::sqrt(n.uniform()), u = n.uniform();
  return {static_cast<float>(root * (1 - u)), static_cast<float>(root * u)};
}

inline bvh_triangle stored(triangle const& t) {
  bvh_triangle result{};
  for (int k = 0; k < 3; ++k)
    for (int axis = 0; axis < 3; ++axis) result.corner[k][axis] = t.position[k][axis];
  return result;
}

inline scene moved_by(scene s, glm::dvec3 by) {
  for (triangle& t : s.triangles)
    for (vec3& p : t.position) p = vec3(glm::dvec3(p) + by);
  for (punctual_light& l : s.lights) l.position = vec3(glm::dvec3(l.position) + by);
  s.view.position = vec3(glm::dvec3(s.view.position) + by);
  return s;
}

}  // namespace path_tracer
