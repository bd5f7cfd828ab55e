// SPDX-License-Identifier: Apache-2.0
#include "shading/noise.hpp"

#include <algorithm>
#include <cmath>

#include "catch.hpp"

using namespace path_tracer;

namespace {

vec3 point(std::uint32_t i) {
  vec2 const a = random_stream(3, i, 0).pair(0), b = random_stream(3, i, 0).pair(1);
  return (vec3{a.x, a.y, b.x} - 0.5f) * 200.0f;
}

}  // namespace

TEST_CASE("gradient noise vanishes at lattice points and is bounded and centred", "[noise]") {
  CHECK(gradient_noise({0, 0, 0}) == 0);
  CHECK(gradient_noise({-3, 7, 1000}) == 0);
  double sum = 0, squares = 0;
  float largest = 0;
  constexpr int count = 100000;
  for (std::uint32_t i = 0; i < count; ++i) {
    float const n = gradient_noise(point(i));
    sum += double{n};
    squares += double{n} * double{n};
    largest = std::max(largest, std::abs(n));
  }
  CHECK(largest <= 1);
  CHECK(largest > 0.7f);
  CHECK_THAT(sum / count, WithinAbs(0, 0.01));
  CHECK(squares / count > 0.03);
}

TEST_CASE("gradient noise is continuous, across cells too", "[noise]") {
  float worst = 0;
  for (std::uint32_t i = 0; i < 20000; ++i) {
    vec3 p = point(i);
    if (i % 2 == 0) p[static_cast<int>(i / 2 % 3)] = std::floor(p.x);  // on a face of a cell
    for (int k = 0; k < 3; ++k) {
      vec3 a = p, b = p;
      a[k] -= 1e-3f;
      b[k] += 1e-3f;
      worst = std::max(worst, std::abs(gradient_noise(b) - gradient_noise(a)));
    }
  }
  CHECK(worst < 2e-3f * 4);  // no slope is steeper than 4
}

TEST_CASE("turbulence bounds fbm, and patterns stay within [0, 1] and vary", "[noise]") {
  float low[2] = {1, 1}, high[2] = {0, 0};
  for (std::uint32_t i = 0; i < 20000; ++i) {
    vec3 const p = point(i) * 0.1f;
    float const t = turbulence(p, 4);
    REQUIRE(t >= 0);
    REQUIRE(std::abs(fbm(p, 4)) <= t + 1e-6f);
    float const patterns[2] = {marble_pattern(p, 16), wood_pattern(p, 16)};
    for (int k = 0; k < 2; ++k) {
      low[k] = std::min(low[k], patterns[k]);
      high[k] = std::max(high[k], patterns[k]);
    }
  }
  for (int k = 0; k < 2; ++k) {
    CHECK(low[k] >= 0);
    CHECK(high[k] <= 1);
    CHECK(low[k] < 0.05f);
    CHECK(high[k] > 0.95f);
  }
}
