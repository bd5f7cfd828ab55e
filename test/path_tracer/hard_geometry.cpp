// SPDX-License-Identifier: Apache-2.0
// Rays at closed meshes, slivers, copies and coplanar triangles, and frames about any normal.
#include <algorithm>
#include <cmath>
#include <vector>

#include "hard_support.hpp"
#include "scene/surface.hpp"

using namespace path_tracer;

namespace {

/// Shoots rays from about the middle of a closed mesh at its corners, its edges and its triangles;
/// returns how many meet nothing.
int count_leaks(std::vector<triangle> const& triangles, glm::dvec3 centre, double radius,
                fine_numbers& n, int rays) {
  bvh const tree = build_bvh(triangles);
  int leaks = 0;
  for (int i = 0; i < rays; ++i) {
    triangle const& t = triangles[n.below(triangles.size())];
    float const along = i % 4 == 0 ? 0.0f : static_cast<float>(n.uniform());
    vec3 target = glm::mix(t.position[i % 3], t.position[(i + 1) % 3], along);
    if (i % 4 == 3) target = glm::mix(target, t.position[(i + 2) % 3], float(n.uniform()));
    vec3 const origin(centre + (i % 8 < 4 ? 0.0 : 0.3 * n.uniform()) * radius * n.on_sphere());
    if (!any_hit(tree.view(), {origin, target - origin, INFINITY})) ++leaks;
  }
  return leaks;
}

double worst_frame(vec3 n, vec3 hint) {
  surface s{};
  set_frame(s, n, hint);
  glm::dvec3 const t(s.tangent), u(s.up), normal(s.normal);
  double const turn = glm::dot(glm::cross(t, u), normal);
  return std::max({std::abs(glm::dot(t, t) - 1), std::abs(glm::dot(u, u) - 1),
                   std::abs(glm::dot(t, u)), std::abs(glm::dot(t, normal)),
                   std::abs(glm::dot(u, normal)), std::abs(turn - 1)});
}

}  // namespace

TEST_CASE("no ray leaks through a closed mesh", "[hard]") {
  // 10^7 rays in all; the corners of a small ball far away lie on a coarse grid, and still close.
  std::uint64_t const seed = 601;
  fine_numbers n(seed);
  int rays = 0;
  for (double const radius : {1e-4, 1.0, 1e3, 1e6})
    for (double const away : {0.0, 1.0, 1e3, 1e6}) {
      if (away > radius * 2e6) continue;  // nothing is left of the ball in float
      glm::dvec3 const centre = away * glm::dvec3(1, -0.5, 0.25);
      CAPTURE(seed, radius, away);
      int const count = 750000;
      CHECK(count_leaks(ball(centre, radius, 1), centre, radius, n, count) == 0);
      rays += count;
    }
  CHECK(rays >= 10000000);
}

TEST_CASE("no ray leaks through a mesh of slivers and triangles without area", "[hard]") {
  std::uint64_t const seed = 602;
  fine_numbers n(seed);
  for (double const half : {1e-4, 1.0, 1e6})
    for (double const away : {0.0, 1.0}) {
      glm::dvec3 const centre = away * half * glm::dvec3(30, -17, 5);
      CAPTURE(seed, half, away);
      CHECK(count_leaks(sliver_cube(centre, half), centre, half, n, 100000) == 0);
    }
}

TEST_CASE("a sliver is hit where it is, and nowhere else", "[hard]") {
  std::uint64_t const seed = 603;
  fine_numbers n(seed);
  int inside = 0, outside = 0;
  for (int i = 0; i < 200000; ++i) {
    // A triangle of length 1 and of a width down to 1e-6, in the plane z = 0, turned about z; the
    // ray comes straight down, so that the weights are those of the plane.
    double const width = n.over_decades(1e-6, 1e-2), angle = 6.3 * n.uniform();
    glm::dvec2 const u(std::cos(angle), std::sin(angle)), v(-u.y, u.x);
    glm::dvec2 const corners[3] = {glm::dvec2(0.0), u, n.uniform() * u + width * v};
    triangle t{};
    for (int k = 0; k < 3; ++k) t.position[k] = {vec2(corners[k]), 0};
    glm::dvec2 const p = n.uniform() * u + (3 * n.uniform() - 1) * width * v;
    vec3 const origin{vec2(p), 2};
    // Twice the areas that the point spans with the edges, of the corners as float has them.
    double area[3], least = 1e9, sum = 0;
    for (int k = 0; k < 3; ++k) {
      glm::dvec2 const a = glm::dvec2(t.position[k]) - glm::dvec2(origin),
                       b = glm::dvec2(t.position[(k + 1) % 3]) - glm::dvec2(origin);
      area[k] = a.x * b.y - a.y * b.x;
      sum += area[k];
    }
    for (double const a : area) least = std::min(least, sum > 0 ? a : -a);
    if (std::abs(least) < 3e-7) continue;  // the product of two float coordinates decides no more
    hit h;
    h.t = INFINITY;
    bool const found = sheared_ray({origin, {0, 0, -1}, INFINITY}).intersect(stored(t), h);
    CAPTURE(seed, i, width, least);
    REQUIRE(found == (least > 0));
    (found ? inside : outside) += 1;
    if (found) REQUIRE_THAT(h.t, WithinRel(2.0f, 1e-6f));
  }
  CHECK(inside > 10000);
  CHECK(outside > 10000);
}

TEST_CASE("copies of triangles change no distance", "[hard]") {
  std::uint64_t const seed = 604;
  fine_numbers n(seed);
  std::vector<triangle> const once = ball({3, -2, 1}, 1, 2);
  std::vector<triangle> twice = once;
  for (triangle const& t : once) {
    twice.push_back(t);
    twice.push_back(make_triangle(t.position[1], t.position[2], t.position[0]));
    twice.push_back(make_triangle(t.position[2], t.position[1], t.position[0]));
  }
  check_structure(twice);
  bvh const single = build_bvh(once), many = build_bvh(twice);
  int hits = 0;
  for (int i = 0; i < 100000; ++i) {
    glm::dvec3 const aim = glm::dvec3(3, -2, 1) + 1.2 * n.on_sphere();
    vec3 const origin(4.0 * n.on_sphere());
    ray const r{origin, vec3(aim) - origin, INFINITY};
    hit const a = closest_hit(single.view(), r), b = closest_hit(many.view(), r);
    CAPTURE(seed, i);
    REQUIRE((a.primitive == no_primitive) == (b.primitive == no_primitive));
    REQUIRE_THAT(b.t, WithinRel(a.t, 1e-6f));
    hits += a.primitive != no_primitive ? 1 : 0;
  }
  CHECK(hits > 20000);
}

TEST_CASE("of coplanar surfaces the ray meets one, where their plane is", "[hard]") {
  // Two squares of different corners and sizes in one plane, tilted against the axes.
  std::uint64_t const seed = 605;
  fine_numbers n(seed);
  glm::dvec3 const normal = glm::normalize(glm::dvec3(1, 2, 3)),
                   u = glm::normalize(glm::cross(normal, glm::dvec3(0, 0, 1))),
                   v = glm::cross(normal, u), origin(0.3, 0.2, -0.7);
  std::vector<triangle> triangles;
  for (double const size : {1.0, 7.0}) {
    auto const at = [&](double x, double y) { return vec3(origin + size * (x * u + y * v)); };
    triangles.push_back(make_triangle(at(-1, -1), at(1, -1), at(1, 1)));
    triangles.push_back(make_triangle(at(-1, -1), at(1, 1), at(-1, 1)));
  }
  bvh const tree = build_bvh(triangles);
  int first = 0;
  for (int i = 0; i < 100000; ++i) {
    glm::dvec3 const target = origin + (2 * n.uniform() - 1) * u + (2 * n.uniform() - 1) * v;
    glm::dvec3 const from = target + 3.0 * glm::normalize(normal + 0.9 * n.on_sphere());
    vec3 const start(from), direction(glm::normalize(target - from));
    hit const h = closest_hit(tree.view(), {start, direction, INFINITY});
    double const expected =
        glm::dot(origin - glm::dvec3(start), normal) / glm::dot(glm::dvec3(direction), normal);
    CAPTURE(seed, i);
    REQUIRE(h.primitive != no_primitive);
    REQUIRE_THAT(double{h.t}, WithinRel(expected, 1e-5));
    first += h.primitive < 2 ? 1 : 0;
  }
  CAPTURE(first);
  CHECK(first < 100000);  // both are in the game
  CHECK(first > 0);
}

TEST_CASE("a frame about any normal is orthonormal", "[hard]") {
  std::uint64_t const seed = 606;
  fine_numbers n(seed);
  double worst = 0;
  auto const check = [&](vec3 normal) { worst = std::max(worst, worst_frame(normal, vec3{0})); };
  check({0, 0, 1});
  check({0, 0, -1});
  check({1, 0, -0.0f});
  for (int k = 1; k < 64; ++k) {
    double const z = -1 + k * 0x1p-24;
    check(vec3(std::sqrt((1 - z) * (1 + z)), 0, z));
  }
  for (int i = 0; i < 300000; ++i) {
    double const sine = n.over_decades(1e-30, 1), phi = 6.3 * n.uniform();
    double const z = (i % 2 == 0 ? -1 : 1) * std::sqrt(1 - sine * sine);
    check(vec3(sine * std::cos(phi), sine * std::sin(phi), z));
  }
  CAPTURE(seed);
  CHECK(worst < 1e-6);
}

TEST_CASE("a frame stays orthonormal whatever tangent it is asked for", "[hard]") {
  std::uint64_t const seed = 607;
  fine_numbers n(seed);
  double worst = 0;
  for (int i = 0; i < 300000; ++i) {
    glm::dvec3 const normal = n.on_sphere();
    // Down to tangents that are the normal, of any length.
    glm::dvec3 const hint = n.over_decades(1e-12, 1e12) *
                            (glm::dvec3(vec3(normal)) + n.over_decades(1e-9, 1) * n.on_sphere());
    worst = std::max(worst, worst_frame(vec3(normal), vec3(hint)));
  }
  CAPTURE(seed);
  CHECK(worst < 1e-6);
}
