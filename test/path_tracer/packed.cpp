// SPDX-License-Identifier: Apache-2.0
// The smaller records between stages, against the vectors that they stand for.
#include "shading/packed.hpp"

#include <cmath>
#include <limits>
#include <random>

#include "machines.hpp"

using namespace path_tracer;

namespace {

double angle_between(vec3 a, vec3 b) {
  glm::dvec3 const u(a), v(b);
  return std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v));
}

double off(vec3 v) { return angle_between(v, packed_direction(v)); }

}  // namespace

TEST_CASE("packed directions are off by less than 1e-4", "[packed]") {
  auto const seed = GENERATE(take(3, random(1u, 1u << 30)));
  CAPTURE(seed);
  std::mt19937 engine(seed);
  std::normal_distribution<float> normal;
  double worst = 0;
  for (int i = 0; i < 100000; ++i) {
    vec3 const v = glm::normalize(vec3{normal(engine), normal(engine), normal(engine)});
    worst = std::max(worst, off(v));
    REQUIRE(std::fabs(glm::length(vec3(packed_direction(v))) - 1) < 3e-7f);
  }
  CHECK(worst < 1e-4);
  CHECK(worst > 1e-5);  // 16 bits a coordinate
}

TEST_CASE("packed directions know all sides, edges and corners", "[packed]") {
  for (float const x : {-1.0f, -1e-7f, -0.0f, 0.0f, 1e-7f, 1.0f})
    for (float const y : {-1.0f, -1e-7f, -0.0f, 0.0f, 1e-7f, 1.0f})
      for (float const z : {-1.0f, -1e-7f, -0.0f, 0.0f, 1e-7f, 1.0f}) {
        if (x == 0 && y == 0 && z == 0) continue;
        vec3 const v = glm::normalize(vec3{x, y, z} / glm::length(vec3{x, y, z}));
        CAPTURE(v.x, v.y, v.z);
        CHECK(off(v) < 1e-4);
      }
  for (int axis = 0; axis < 3; ++axis)
    for (float const sign : {-1.0f, 1.0f}) {
      vec3 v{0};
      v[axis] = sign;
      CHECK(vec3(packed_direction(v)) == v);
    }
}

TEST_CASE("what has no direction is packed as no number", "[packed]") {
  float const infinity = std::numeric_limits<float>::infinity(), nan = std::nanf("");
  for (vec3 const v : {vec3{0}, vec3{nan, 0, 1}, vec3{0, 1, nan}, vec3{infinity, 0, 0}})
    CHECK(std::isnan(vec3(packed_direction(v)).x));
}

TEST_CASE("packed colours keep eleven bits", "[packed]") {
  auto const seed = GENERATE(take(3, random(1u, 1u << 30)));
  CAPTURE(seed);
  std::mt19937 engine(seed);
  std::uniform_real_distribution<float> exponent(-14, 15.99f);
  for (int i = 0; i < 100000; ++i) {
    vec3 const c{std::exp2(exponent(engine)), std::exp2(exponent(engine)),
                 std::exp2(exponent(engine))};
    vec3 const kept = packed_color(c);
    for (int k = 0; k < 3; ++k) REQUIRE(std::fabs(kept[k] - c[k]) <= 0x1p-11f * c[k]);
  }
  for (float const exact : {0.0f, 1.0f, 0.5f, 0x1p-24f, 2047.0f, 65504.0f})
    CHECK(vec3(packed_color(vec3{exact})) == vec3{exact});
}

TEST_CASE("packed colours at the ends of their range", "[packed]") {
  float const infinity = std::numeric_limits<float>::infinity();
  CHECK(vec3(packed_color(vec3{65520, 1e9f, 3e38f})) == vec3{65504});
  CHECK(vec3(packed_color(vec3{-65520, -1e9f, -3e38f})) == vec3{-65504});
  CHECK(vec3(packed_color(vec3{1e-8f, 1e-30f, 1e-45f})) == vec3{0});
  CHECK(vec3(packed_color(vec3{infinity})) == vec3{infinity});  // so that it is counted
  CHECK(std::isnan(vec3(packed_color(vec3{std::nanf("")})).x));
}

TEST_CASE("packed colours add up and multiply as vectors do", "[packed]") {
  packed_color c = vec3{1, 2, 0};
  c += vec3{0.5f, 0.25f, 0};
  CHECK(c == vec3{1.5f, 2.25f, 0});
  c *= vec3{2, 4, 8};
  CHECK(c == vec3{3, 9, 0});
  CHECK(c * vec3{1, 0.5f, 7} == vec3{3, 4.5f, 0});
  CHECK_FALSE(c == vec3{3, 9, 1});
}
