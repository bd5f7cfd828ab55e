// SPDX-License-Identifier: Apache-2.0
#pragma once

// Random triangles and a look into a hierarchy, for the tests of the latter.

#include <algorithm>
#include <cmath>
#include <vector>

#include "catch.hpp"
#include "scene/bvh_builder.hpp"
#include "shading/random.hpp"

namespace path_tracer {

/// Numbers from a seed, one after the other.
class numbers {
 public:
  explicit numbers(std::uint64_t seed) : stream_(seed, 0, 0) {}
  float uniform() { return stream_.pair(next_++).x; }
  vec3 in_cube() {
    float const x = uniform(), y = uniform();
    return {x, y, uniform()};
  }
  vec3 on_sphere() {
    float const z = 2 * uniform() - 1, phi = 2 * pi * uniform();
    float const r = std::sqrt(std::max(0.0f, 1 - z * z));
    return {r * std::cos(phi), r * std::sin(phi), z};
  }

 private:
  random_stream stream_;
  std::uint32_t next_ = 0;
};

inline triangle make_triangle(vec3 a, vec3 b, vec3 c) {
  triangle t{};
  t.position[0] = a;
  t.position[1] = b;
  t.position[2] = c;
  return t;
}

inline std::vector<triangle> soup(numbers& n, int count, float size) {
  std::vector<triangle> triangles;
  for (int i = 0; i < count; ++i) {
    vec3 const p = n.in_cube();
    vec3 const q = p + size * n.on_sphere();
    triangles.push_back(make_triangle(p, q, p + size * n.on_sphere()));
  }
  return triangles;
}

/// The most inner nodes from the root to a leaf, and whether every triangle is in one leaf.
inline int depth_below(bvh const& tree, std::uint32_t reference, std::vector<int>& seen) {
  if ((reference & leaf_flag) != 0) {
    std::uint32_t const first = reference & (max_bvh_triangles - 1);
    for (std::uint32_t i = first; i <= first + ((reference >> 28) & 7u); ++i)
      ++seen[tree.triangles[i].primitive];
    return 0;
  }
  int deepest = 0;
  bvh_node const& node = tree.nodes[reference];
  for (int k = 0; k < 2; ++k)
    if (node.corner[k][0][0] <= node.corner[k][1][0])  // else there is no such child
      deepest = std::max(deepest, depth_below(tree, node.child[k], seen));
  return 1 + deepest;
}

inline void check_structure(std::vector<triangle> const& triangles) {
  bvh const tree = build_bvh(triangles);
  std::vector<int> seen(triangles.size());
  CHECK(depth_below(tree, 0, seen) <= max_bvh_depth);
  CHECK(std::all_of(seen.begin(), seen.end(), [](int n) { return n == 1; }));
}

}  // namespace path_tracer
