// SPDX-License-Identifier: Apache-2.0
#include "scene/bvh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "bvh_support.hpp"
#include "catch.hpp"

using namespace path_tracer;

namespace {

/// Distance to a triangle in double (Moeller and Trumbore 1997), infinity for a miss; `margin` is
/// how far the hit is from the nearest edge, in barycentric units, negative outside.
double distance(triangle const& t, ray const& r, double& margin) {
  glm::dvec3 const a(t.position[0]), e1 = glm::dvec3(t.position[1]) - a,
                                     e2 = glm::dvec3(t.position[2]) - a;
  glm::dvec3 const d(r.direction), s = glm::dvec3(r.origin) - a, p = glm::cross(d, e2);
  double const det = glm::dot(e1, p);
  margin = -1;
  if (det == 0) return std::numeric_limits<double>::infinity();
  double const u = glm::dot(s, p) / det, v = glm::dot(d, glm::cross(s, e1)) / det;
  double const x = glm::dot(e2, glm::cross(s, e1)) / det;
  margin = std::min({u, v, 1 - u - v});
  return margin >= 0 && x > 0 ? x : std::numeric_limits<double>::infinity();
}

/// Compares closest_hit and any_hit with all triangles in double; a ray that comes within 1e-4 of
/// an edge may go either way. Returns how many rays were decided.
int check_against_all(std::vector<triangle> const& triangles, numbers& n, int rays) {
  bvh const tree = build_bvh(triangles);
  int decided = 0;
  for (int i = 0; i < rays; ++i) {
    ray const r{n.in_cube() * 3.0f - 1.0f, n.on_sphere(), INFINITY};
    double best = std::numeric_limits<double>::infinity();
    bool close_call = false;
    for (triangle const& t : triangles) {
      double margin;
      best = std::min(best, distance(t, r, margin));
      close_call = close_call || std::abs(margin) < 1e-4;
    }
    if (close_call) continue;
    ++decided;
    hit const h = closest_hit(tree.view(), r);
    REQUIRE((h.primitive != no_primitive) == std::isfinite(best));
    REQUIRE(any_hit(tree.view(), r) == std::isfinite(best));
    if (!std::isfinite(best)) continue;
    REQUIRE_THAT(double{h.t}, WithinAbs(best, 1e-4 * (1 + best)));
    double margin;
    REQUIRE_THAT(distance(triangles[h.primitive], r, margin), WithinAbs(best, 1e-4 * (1 + best)));
    // The point by its weights is the point along the ray.
    triangle const& t = triangles[h.primitive];
    vec3 const p = (1 - h.barycentric.x - h.barycentric.y) * t.position[0] +
                   h.barycentric.x * t.position[1] + h.barycentric.y * t.position[2];
    REQUIRE(glm::length(p - (r.origin + h.t * r.direction)) < 1e-4f * (1 + h.t));
    REQUIRE_FALSE(any_hit(tree.view(), {r.origin, r.direction, h.t * 0.999f}));
    REQUIRE(any_hit(tree.view(), {r.origin, r.direction * 2.0f, h.t * 0.501f}));
  }
  return decided;
}

}  // namespace

TEST_CASE("the hierarchy finds what a loop over all triangles finds", "[bvh]") {
  auto const seed = GENERATE(1u, 2u, 3u);
  auto const count = GENERATE(1, 2, 3, 17, 300);
  CAPTURE(seed, count);
  numbers n(seed);
  std::vector<triangle> const triangles = soup(n, count, count > 100 ? 0.2f : 0.8f);
  check_structure(triangles);
  CHECK(check_against_all(triangles, n, 1500) > 1000);
}

TEST_CASE("a scene without triangles is never hit", "[bvh]") {
  bvh const tree = build_bvh({});
  CHECK(closest_hit(tree.view(), {{0, 0, 0}, {0, 0, 1}, INFINITY}).primitive == no_primitive);
  CHECK_FALSE(any_hit(tree.view(), {{0, 0, 0}, {1, 0, 0}, INFINITY}));
}

TEST_CASE("the same input gives the same hierarchy", "[bvh]") {
  numbers n(6);
  std::vector<triangle> const triangles = soup(n, 1000, 0.1f);
  bvh const a = build_bvh(triangles), b = build_bvh(triangles);
  REQUIRE(a.triangles.size() == b.triangles.size());
  bool same = a.nodes.size() == b.nodes.size();
  for (std::size_t i = 0; i < a.triangles.size(); ++i)
    same = same && a.triangles[i].primitive == b.triangles[i].primitive;
  CHECK(same);
}
