// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>
#include <vector>

#include "bvh_support.hpp"
#include "catch.hpp"

using namespace path_tracer;

TEST_CASE("triangles without area are kept apart from rays", "[bvh]") {
  numbers n(4);
  std::vector<triangle> triangles = soup(n, 50, 0.5f);
  std::size_t const solid = triangles.size();
  for (int i = 0; i < 30; ++i) {
    vec3 const p = n.in_cube(), q = n.in_cube();
    triangles.push_back(make_triangle(p, p, p));
    triangles.push_back(make_triangle(p, q, p));
  }
  check_structure(triangles);
  bvh const with = build_bvh(triangles);
  triangles.resize(solid);
  bvh const without = build_bvh(triangles);
  for (int i = 0; i < 3000; ++i) {
    ray const r{n.in_cube() * 3.0f - 1.0f, n.on_sphere(), INFINITY};
    REQUIRE(closest_hit(with.view(), r).t == closest_hit(without.view(), r).t);
  }
}

TEST_CASE("no input makes a hierarchy that overflows the stack", "[bvh]") {
  std::vector<triangle> triangles;
  SECTION("the same triangle many times") {
    triangles.assign(5000, make_triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
  }
  SECTION("concentric triangles: centroids all alike") {
    for (int i = 1; i <= 3000; ++i) {
      auto const s = static_cast<float>(i);
      triangles.push_back(make_triangle({-s, -s, 0}, {s, -s, 0}, {0, s, 0}));
    }
  }
  SECTION("sizes and places that shrink by a factor: the heuristic peels off one at a time") {
    for (int copy = 0; copy < 40; ++copy)
      for (int i = -120; i < 120; ++i) {
        float const s = std::ldexp(1.0f, i);
        triangles.push_back(make_triangle({s, 0, 0}, {1.5f * s, 0, 0}, {s, 0.5f * s, 0}));
      }
  }
  SECTION("the ends of the range of float") {
    float const big = std::numeric_limits<float>::max();
    float const small = std::numeric_limits<float>::denorm_min();
    for (int i = 0; i < 20; ++i) {
      triangles.push_back(make_triangle({-big, -big, 0}, {big, -big, 0}, {0, big, 0}));
      triangles.push_back(make_triangle({0, 0, 0}, {small, 0, 0}, {0, small, 0}));
      triangles.push_back(make_triangle({small, 0, 0}, {big, 0, 0}, {0, 1, 0}));
    }
  }
  check_structure(triangles);
  bvh const tree = build_bvh(triangles);
  numbers n(5);
  for (int i = 0; i < 200; ++i)
    (void)closest_hit(tree.view(), {n.in_cube() - 0.5f, n.on_sphere(), INFINITY});
}

TEST_CASE("no ray slips through the edges or corners of a closed surface", "[bvh]") {
  // A bumpy sphere; every ray from inside aims at a corner or at a point of an edge.
  constexpr int rings = 24, sectors = 48;
  numbers n(7);
  float const offset = GENERATE(0.0f, 1000.0f);
  CAPTURE(offset);
  std::vector<vec3> corners;
  for (int i = 0; i <= rings; ++i)
    for (int k = 0; k < sectors; ++k) {
      float const theta = pi * static_cast<float>(i) / rings,
                  phi = 2 * pi * static_cast<float>(k) / sectors;
      float const radius = i == 0 || i == rings ? 1.0f : 0.8f + 0.4f * n.uniform();
      vec3 const p = i == 0       ? vec3{0, 0, 1}
                     : i == rings ? vec3{0, 0, -1}
                                  : radius * vec3{std::sin(theta) * std::cos(phi),
                                                  std::sin(theta) * std::sin(phi), std::cos(theta)};
      corners.push_back(p + offset);
    }
  std::vector<triangle> triangles;
  auto const corner = [&](int i, int k) {
    return corners[static_cast<std::size_t>(i * sectors + k % sectors)];
  };
  for (int i = 0; i < rings; ++i)
    for (int k = 0; k < sectors; ++k) {
      triangles.push_back(make_triangle(corner(i, k), corner(i + 1, k), corner(i + 1, k + 1)));
      triangles.push_back(make_triangle(corner(i, k), corner(i + 1, k + 1), corner(i, k + 1)));
    }
  bvh const tree = build_bvh(triangles);
  int missed = 0;
  for (int i = 0; i < 60000; ++i) {
    triangle const& t =
        triangles[static_cast<std::size_t>(n.uniform() * static_cast<float>(triangles.size()))];
    float const along = i % 4 == 0 ? 0.0f : n.uniform();
    vec3 const target = glm::mix(t.position[i % 3], t.position[(i + 1) % 3], along);
    vec3 const origin = vec3{offset} + (n.in_cube() - 0.5f) * (i % 2 == 0 ? 0.2f : 0.0f);
    if (!any_hit(tree.view(), {origin, target - origin, INFINITY})) ++missed;
  }
  CHECK(missed == 0);
}

TEST_CASE("rays along the axes meet boxes whose faces they graze", "[bvh]") {
  std::vector<triangle> triangles;
  for (int i = 0; i < 8; ++i)
    for (int k = 0; k < 8; ++k) {
      vec3 const p{static_cast<float>(i), static_cast<float>(k), 0};
      triangles.push_back(make_triangle(p, p + vec3{1, 0, 0}, p + vec3{1, 1, 0}));
      triangles.push_back(make_triangle(p, p + vec3{1, 1, 0}, p + vec3{0, 1, 0}));
    }
  bvh const tree = build_bvh(triangles);
  int missed = 0;
  for (int i = 0; i <= 16; ++i)
    for (int k = 0; k <= 16; ++k) {
      vec3 const p{0.5f * static_cast<float>(i), 0.5f * static_cast<float>(k), 0};
      for (float const side : {-1.0f, 1.0f}) {
        hit const h = closest_hit(tree.view(), {p + vec3{0, 0, 3 * side}, {0, -0.0f, -side}, 10});
        if (h.primitive == no_primitive || h.t != 3) ++missed;
      }
    }
  CHECK(missed == 0);
}
