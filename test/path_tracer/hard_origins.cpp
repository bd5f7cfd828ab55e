// SPDX-License-Identifier: Apache-2.0
// Rays that start on a surface do not meet it again, at any size, place and angle.
#include <cmath>
#include <vector>

#include "hard_support.hpp"
#include "scene/surface.hpp"

using namespace path_tracer;

namespace {

/// A direction at a grazing angle over a plane, the cosine from 1e-6 to 1 uniform in its logarithm.
glm::dvec3 grazing(glm::dvec3 normal, fine_numbers& n) {
  double const c = n.over_decades(1e-6, 1);
  glm::dvec3 aside = n.on_sphere();
  aside = glm::normalize(aside - glm::dot(aside, normal) * normal);
  return glm::normalize(c * normal + std::sqrt((1 - c) * (1 + c)) * aside);
}

/// The surface at a random point of a triangle, seen from a random side.
surface at_random(scene_view const& view, triangle const& t, fine_numbers& n) {
  return load_surface<every_effect>(view, t, place_on(n), vec3(n.on_sphere()));
}

}  // namespace

TEST_CASE("no secondary ray meets the triangle that it starts on", "[hard]") {
  // 10^7 rays, from triangles of size 1e-4 to 1e6, up to 1e6 away, on both sides.
  std::uint64_t const seed = 651;
  fine_numbers n(seed);
  material const plain;
  scene_view view{};
  view.materials = &plain;
  int rays = 0, met = 0;
  while (rays < 10000000) {
    double const size = n.over_decades(1e-4, 1e6);
    glm::dvec3 const centre = n.over_decades(1e-3, 1e6) * n.on_sphere();
    if (glm::length(centre) > 1e5 * size) continue;  // float has no such triangle
    triangle t{};
    for (vec3& p : t.position) p = vec3(centre + size * n.on_sphere());
    glm::dvec3 const a(t.position[0]),
        cross = glm::cross(glm::dvec3(t.position[1]) - a, glm::dvec3(t.position[2]) - a);
    if (glm::length(cross) < 0.01 * size * size) continue;
    bvh_triangle const same = stored(t);
    for (int k = 0; k < 100; ++k, ++rays) {
      surface const s = at_random(view, t, n);
      glm::dvec3 const side = glm::normalize(cross) *
                              (glm::dot(cross, glm::dvec3(s.geometric)) > 0 ? 1.0 : -1.0) *
                              (k % 2 == 0 ? 1.0 : -1.0);
      vec3 const direction(grazing(side, n));
      if (glm::dot(direction, s.geometric) * (k % 2 == 0 ? 1.0f : -1.0f) <= 0) continue;
      hit h;
      h.t = INFINITY;
      met += sheared_ray({s.start_towards(direction), direction, INFINITY}).intersect(same, h);
    }
  }
  CAPTURE(seed);
  CHECK(met == 0);
}

TEST_CASE("a point near the origin of a huge tilted plane starts rays off it", "[hard]") {
  std::uint64_t const seed = 652;
  fine_numbers n(seed);
  material const plain;
  scene_view view{};
  view.materials = &plain;
  for (double const size : {1e2, 1e4, 1e6}) {
    int met = 0;
    for (int i = 0; i < 100000; ++i) {
      glm::dvec3 const normal = n.on_sphere(),
                       u = glm::normalize(glm::cross(normal, n.on_sphere())),
                       v = glm::cross(normal, u);
      triangle const t =
          make_triangle(vec3(-size * u - size * v), vec3(size * u - size * v), vec3(size * v));
      vec2 const near{float(0.25 + 1e-6 * n.uniform()), float(0.5 + 1e-6 * n.uniform())};
      surface const s = load_surface<every_effect>(view, t, near, vec3(-normal));
      vec3 const direction(grazing(normal, n));
      if (glm::dot(direction, s.geometric) <= 0) continue;
      hit h;
      h.t = INFINITY;
      met += sheared_ray({s.start_towards(direction), direction, INFINITY}).intersect(stored(t), h);
    }
    CAPTURE(seed, size);
    CHECK(met == 0);
  }
}

TEST_CASE("rays that leave a convex mesh meet nothing", "[hard]") {
  std::uint64_t const seed = 653;
  fine_numbers n(seed);
  material const plain;
  scene_view view{};
  view.materials = &plain;
  for (double const radius : {1e-4, 1.0, 1e6})
    for (double const away : {0.0, 1.0, 1e3}) {
      auto const triangles = ball(away * radius * glm::dvec3(1, -0.5, 0.25), radius, 1);
      bvh const tree = build_bvh(triangles);
      int met = 0;
      for (int i = 0; i < 100000; ++i) {
        triangle const& t = triangles[n.below(triangles.size())];
        vec3 const outside = geometric_normal(t);
        surface const s = load_surface<every_effect>(view, t, place_on(n), -outside);
        vec3 const direction(grazing(glm::normalize(glm::dvec3(outside)), n));
        met += any_hit(tree.view(), {s.start_towards(direction), direction, INFINITY}) ? 1 : 0;
      }
      CAPTURE(seed, radius, away);
      CHECK(met == 0);
    }
}

TEST_CASE("what hangs closely over a huge plane throws a shadow on it", "[hard]") {
  // At heights of 8e-7 of the plane's size, and less over one along axes.
  std::uint64_t const seed = 655;
  fine_numbers n(seed);
  material const plain;
  scene_view view{};
  view.materials = &plain;
  for (int i = 0; i < 20000; ++i) {
    bool const tilted = i % 2 == 0;
    double const size = n.over_decades(1e-2, 1e6), height = size * (tilted ? 8e-7 : 1e-9);
    glm::dvec3 const normal = tilted ? n.on_sphere() : glm::dvec3(0, 1, 0),
                     u = glm::normalize(glm::cross(normal, n.on_sphere())),
                     v = glm::cross(normal, u);
    auto const at = [&](double x, double y, double z) { return vec3(x * u + y * v + z * normal); };
    triangle const ground = make_triangle(at(-size, -size, 0), at(size, -size, 0), at(0, size, 0));
    double const wide = size / 1000;  // of the same corner, so that it is rounded alike
    triangle const above =
        make_triangle(at(-wide, -wide, height), at(wide, -wide, height), at(0, wide, height));
    vec2 const near{float(0.25 + 1e-5 * n.uniform()), float(0.5 + 1e-5 * n.uniform())};
    surface const s = load_surface<every_effect>(view, ground, near, vec3(-normal));
    vec3 const up(normal);
    hit h;
    h.t = INFINITY;
    sheared_ray const shadow({s.start_towards(up), up, INFINITY});
    CAPTURE(seed, i, size);
    REQUIRE_FALSE(shadow.intersect(stored(ground), h));
    REQUIRE(shadow.intersect(stored(above), h));
  }
}

TEST_CASE("the start of a ray stays near the surface", "[hard]") {
  // A clearance is of use only as long as it is small against what it is next to.
  for (double const size : {1e-4, 1.0, 1e6})
    for (double const away : {0.0, 1.0, 1e3}) {
      triangle const t = ball(away * size * glm::dvec3(1, -0.5, 0.25), size, 1)[0];
      CAPTURE(size, away);
      CHECK(double{clearance_of(t)} > 0);
      CHECK(double{clearance_of(t)} < 1e-5 * size * (1 + 0.1 * away));
    }
}

TEST_CASE("rays from coplanar surfaces do not meet the other", "[hard]") {
  // Squares of different corners in one plane: what rounding leaves between them is within the
  // clearance as long as one is not more than ten times the other.
  std::uint64_t const seed = 654;
  fine_numbers n(seed);
  material const plain;
  scene_view view{};
  view.materials = &plain;
  int met = 0;
  for (int i = 0; i < 3000; ++i) {
    glm::dvec3 const normal = n.on_sphere(), u = glm::normalize(glm::cross(normal, n.on_sphere())),
                     v = glm::cross(normal, u), centre = 3.0 * n.on_sphere();
    std::vector<triangle> triangles;
    for (double const size : {1.0, n.over_decades(1, 10)}) {
      auto const at = [&](double x, double y) { return vec3(centre + size * (x * u + y * v)); };
      triangles.push_back(make_triangle(at(-1, -1), at(1, -1), at(1, 1)));
      triangles.push_back(make_triangle(at(-1, -1), at(1, 1), at(-1, 1)));
    }
    for (int k = 0; k < 100; ++k) {
      triangle const& t = triangles[n.below(4)];
      surface const s = load_surface<every_effect>(view, t, place_on(n), -geometric_normal(t));
      // Not flatter than the planes are rounded.
      glm::dvec3 const over = grazing(normal, n);
      if (glm::dot(over, normal) < 1e-5) continue;
      for (triangle const& other : triangles) {
        hit h;
        h.t = INFINITY;
        met += sheared_ray({s.start_towards(vec3(over)), vec3(over), INFINITY})
                   .intersect(stored(other), h);
      }
    }
  }
  CAPTURE(seed);
  CHECK(met == 0);
}
