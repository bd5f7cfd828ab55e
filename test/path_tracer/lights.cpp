// SPDX-License-Identifier: Apache-2.0
#include "scene/lights.hpp"

#include <cmath>
#include <vector>

#include "catch.hpp"
#include "shading/random.hpp"

using namespace path_tracer;

namespace {

struct quad {
  vec3 corner, edge1, edge2;  ///< emits to the side of cross(edge1, edge2)
  std::uint32_t material;
};

scene scene_of(std::vector<quad> const& quads, std::vector<vec3> const& emissions) {
  scene s;
  for (vec3 const e : emissions) {
    material m;
    m.kind = shader_of<effects::emitters>;
    m.emission = e;
    s.materials.push_back(m);
  }
  for (quad const& q : quads)
    for (int k = 0; k < 2; ++k) {
      triangle t{};
      t.position[0] = q.corner;
      t.position[1] = k == 0 ? q.corner + q.edge1 : q.corner + q.edge1 + q.edge2;
      t.position[2] = k == 0 ? q.corner + q.edge1 + q.edge2 : q.corner + q.edge2;
      t.material = q.material;
      s.triangles.push_back(t);
    }
  return s;
}

light_sample draw_light(scene const& s, light_list const& lights, vec3 p, std::uint32_t i) {
  random_stream const random(11, i, 0);
  return sample_light<every_effect>(lights.view(s), p,
                                    {random.pair(0), random.pair(1), random.pair(2), 0});
}

/// The irradiance at `p` on a surface of normal `n` by light samples alone, without shadows.
double irradiance(scene const& s, vec3 p, vec3 n, int count = 200000) {
  light_list const lights(s);
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    light_sample const l = draw_light(s, lights, p, static_cast<std::uint32_t>(i));
    if (l.pdf > 0) sum += double{luminance(l.radiance) * glm::max(glm::dot(l.wi, n), 0.0f) / l.pdf};
  }
  return sum / count;
}

/// Form factor of a rectangle a x b from a patch parallel to it at distance c under its corner.
double corner_form_factor(double a, double b, double c) {
  double const x = a / c, y = b / c;
  return (x / std::sqrt(1 + x * x) * std::atan(y / std::sqrt(1 + x * x)) +
          y / std::sqrt(1 + y * y) * std::atan(x / std::sqrt(1 + y * y))) /
         (2 * double{pi});
}

}  // namespace

TEST_CASE("light samples give a rectangle's closed-form irradiance", "[lights]") {
  // Above the origin, emitting downwards.
  scene const s = scene_of({{{0, 0, 2}, {0, 1.5f, 0}, {1, 0, 0}, 0}}, {vec3{3}});
  double const expected = 3 * double{pi} * corner_form_factor(1, 1.5, 2);
  CHECK_THAT(irradiance(s, {0, 0, 0}, {0, 0, 1}), WithinRel(expected, 0.005));
  SECTION("and nothing behind a one-sided one, where a two-sided one gives as much") {
    CHECK(irradiance(s, {0, 0, 4}, {0, 0, -1}) == 0);
    scene both = s;
    both.materials[0].two_sided = true;
    CHECK_THAT(irradiance(both, {0, 0, 4}, {0, 0, -1}), WithinRel(expected, 0.005));
  }
}

TEST_CASE("the density of a light sample is right for any power", "[lights]") {
  // Powers from 1e-47 to 1e45: neither they nor their reciprocals are all in the range of a float.
  for (float const size : {1e-10f, 1e-6f, 1.0f, 1e8f})
    for (float const emission : {1e-27f, 1e-10f, 1.0f, 1e29f}) {
      CAPTURE(size, emission);
      scene const s =
          scene_of({{{0, 0, 2 * size}, {0, 1.5f * size, 0}, {size, 0, 0}, 0}}, {vec3{emission}});
      light_list const lights(s);
      for (std::uint32_t i = 0; i < 20; ++i) {
        light_sample const l = draw_light(s, lights, {0, 0, 0}, i);
        double const d = double{l.distance}, area = 1.5 * double{size} * double{size};
        REQUIRE_THAT(double{l.pdf}, WithinRel(d * d / double{l.wi.z} / area, 1e-4));
      }
    }
}

TEST_CASE("many lights of different power add up", "[lights]") {
  std::vector<quad> quads;
  std::vector<vec3> emissions;
  double expected = 0;
  for (int i = 0; i < 6; ++i) {
    auto const side = static_cast<float>(1 + i) * 0.5f;
    float const height = 2.0f + static_cast<float>(i);
    vec3 const e = vec3{1, 0.5f, 2} * static_cast<float>(1 << i);
    quads.push_back({{0, 0, height}, {0, side, 0}, {side, 0, 0}, static_cast<std::uint32_t>(i)});
    emissions.push_back(e);
    expected += double{luminance(e)} * double{pi} * corner_form_factor(side, side, height);
  }
  CHECK_THAT(irradiance(scene_of(quads, emissions), {0, 0, 0}, {0, 0, 1}),
             WithinRel(expected, 0.01));
}

TEST_CASE("a light is picked in proportion to its power, and reports that density", "[lights]") {
  scene s = scene_of({{{0, 0, 2}, {0, 1, 0}, {1, 0, 0}, 0}, {{5, 0, 2}, {0, 1, 0}, {3, 0, 0}, 1}},
                     {vec3{1}, vec3{4}});
  punctual_light point;
  point.position = {0, 9, 0};
  point.intensity = vec3{3.25f};  // its power, 4 pi 3.25, equals that of the two quads, pi (1 + 12)
  s.lights.push_back(point);
  light_list const lights(s);
  constexpr int count = 100000;
  int punctual = 0, bright = 0;
  bool consistent = true;
  for (std::uint32_t i = 0; i < count; ++i) {
    light_sample const l = draw_light(s, lights, {0.5f, 0.5f, 0}, i);
    punctual += l.delta ? 1 : 0;
    bright += l.radiance.x == 4 ? 1 : 0;
    if (l.delta) {
      consistent = consistent && std::abs(l.pdf - 0.5f) < 1e-5f;
    } else {
      float const cos_light = std::abs(l.wi.z), d2 = l.distance * l.distance;
      material const& m = s.materials[l.radiance.x == 4 ? 1 : 0];
      float const pdf = light_pdf(lights.view(s), m, d2, cos_light);
      // Of the area of its quad, a share of the power over that area, turned to solid angle.
      float const expected = (l.radiance.x == 4 ? 6.0f / 13 / 3 : 0.5f / 13) * d2 / cos_light;
      consistent = consistent && std::abs(pdf - l.pdf) < 1e-4f * pdf &&
                   std::abs(expected - l.pdf) < 1e-4f * pdf;
    }
  }
  CHECK(consistent);
  CHECK_THAT(double(punctual) / count, WithinAbs(0.5, 0.008));
  CHECK_THAT(double(bright) / count, WithinAbs(6.0 / 13, 0.008));
}

TEST_CASE("rounding of equal lights' powers does not decide which one is drawn", "[lights]") {
  // The bright one's triangles, each less one of the other's, are the mean except for rounding.
  float const bright = GENERATE(1.5f, 1.6f, 1.9f);
  std::vector<std::uint32_t> aliases;
  for (float const ulps : {-2.f, -1.f, 0.f, 1.f, 2.f}) {
    float const edge = 1 + ulps * 0x1p-23f;
    scene const s =
        scene_of({{{0, 0, 0}, {edge, 0, 0}, {0, 1, 0}, 0}, {{0, 0, 2}, {1, 0, 0}, {0, 1, 0}, 1}},
                 {vec3{bright}, vec3{2 - bright}});
    light_list const lights(s);
    light_view const view = lights.view(s);
    REQUIRE(view.count == 4);
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < view.count; ++i) found.push_back(view.entries[i].alias);
    if (aliases.empty()) aliases = found;
    CHECK(found == aliases);
  }
}

TEST_CASE("punctual lights follow KHR_lights_punctual", "[lights]") {
  punctual_light light;
  light.intensity = {8, 4, 2};
  light.position = {0, 0, 2};
  SECTION("a point light falls off with the square of the distance") {
    light_sample const l = sample_punctual(light, {0, 0, 0}, 100);
    CHECK(l.delta);
    CHECK(l.wi == vec3{0, 0, 1});
    CHECK(l.distance == 2);
    CHECK(l.radiance == vec3{2, 1, 0.5f});
  }
  SECTION("a range ends it smoothly") {
    light.range = 4;
    CHECK_THAT(sample_punctual(light, {0, 0, 0}, 100).radiance.x, WithinRel(2 * 15.0f / 16, 1e-5f));
    light.range = 2;
    CHECK(sample_punctual(light, {0, 0, 0}, 100).radiance.x == 0);
  }
  SECTION("a spot light has a cone") {
    light.kind = punctual_light::type::spot;
    light.direction = {0, 0, -1};
    light.cos_inner = std::cos(0.2f);
    light.cos_outer = std::cos(0.6f);
    auto const at = [&](float angle) {
      vec3 const p = light.position + 2.0f * vec3{std::sin(angle), 0, -std::cos(angle)};
      return sample_punctual(light, p, 100).radiance.x;
    };
    CHECK_THAT(at(0.1f), WithinRel(2.0f, 1e-4f));
    CHECK(at(0.7f) == 0);
    CHECK(at(3.0f) == 0);
    float const share = (std::cos(0.4f) - light.cos_outer) / (light.cos_inner - light.cos_outer);
    CHECK_THAT(at(0.4f), WithinRel(2 * share * share, 1e-3f));
  }
  SECTION("a directional light is the same everywhere") {
    light.kind = punctual_light::type::directional;
    light.direction = {0, -1, 0};
    light_sample const l = sample_punctual(light, {3, 4, 5}, 100);
    CHECK(l.wi == vec3{0, 1, 0});
    CHECK(l.radiance == light.intensity);
    CHECK(l.distance == 100);
  }
}

TEST_CASE("a scene without light has no lights", "[lights]") {
  auto const count = [](scene const& s) { return light_list(s).view(s).count; };
  CHECK(count(scene{}) == 0);
  CHECK(count(scene_of({{{0, 0, 2}, {0, 1, 0}, {1, 0, 0}, 0}}, {vec3{0}})) == 0);
  // No area, no power.
  CHECK(count(scene_of({{{0, 0, 2}, {0, 1, 0}, {0, 2, 0}, 0}}, {vec3{1}})) == 0);
}

TEST_CASE("the power heuristic's two weights add up to one", "[lights]") {
  for (float const a : {1e-6f, 0.3f, 7.0f, 1e8f})
    for (float const b : {1e-6f, 0.5f, 3.0f, 1e9f})
      CHECK_THAT(power_heuristic(a, b) + power_heuristic(b, a), WithinAbs(1, 1e-5));
  CHECK(power_heuristic(2, 0) == 1);
}
