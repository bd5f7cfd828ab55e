// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "machines.hpp"

using namespace path_tracer;

TEST_CASE("a furnace has the radiance of its closed form", "[render]") {
  std::string const machine = GENERATE(from_range(machines()));
  CAPTURE(machine);
  // Walls that emit E and reflect a share a: everywhere E (1 + a + a^2 + ...), cut at the depth.
  double const e = 0.7, a = 0.6;
  material wall;
  wall.kind = shader_of<effects::emitters>;
  wall.emission = vec3{static_cast<float>(e)};
  wall.base_color = vec3{static_cast<float>(a)};
  scene const s = box_of(wall);
  for (std::uint32_t const depth : {1u, 2u, 5u, 100u}) {
    CAPTURE(depth);
    render_result const r = render(s, small(64, depth, machine));
    glm::dvec2 const mean = mean_and_error(r);
    CHECK_THAT(mean.x, WithinAbs(e * (1 - std::pow(a, depth)) / (1 - a), mean.y));
    CHECK(mean.y < 0.05);
  }
}

TEST_CASE("a white object vanishes in an even sky", "[render]") {
  std::string const machine = GENERATE(from_range(machines()));
  CAPTURE(machine);
  scene s;
  s.background = vec3{0.5f};
  s.view.position = {0.3f, 0.4f, 4};
  auto const kind = GENERATE(shader_of<effects::matte>, shader_of<effects::smooth_glass>,
                             shader_of<effects::rough_glass>, shader_of<effects::plastic>,
                             shader_of<effects::marble>);
  CAPTURE(static_cast<int>(kind));
  material m;
  m.kind = kind;
  m.base_color = m.second_color = vec3{1};
  m.roughness = kind == shader_of<effects::rough_glass> ? 0.2f : 0.4f;
  m.transmission = 1;
  s.materials = {m};
  add_box(s, {0, 0, 0}, vec3{1}, 0, false);
  // Long paths: light that glass holds by total reflection gets out at last, or is lost.
  glm::dvec2 const mean = mean_and_error(render(s, small(64, 400, machine)));
  double const lost = kind == shader_of<effects::rough_glass> ? 0.02 : 1e-3;
  CHECK(mean.x < 0.5 + mean.y + 5e-4);
  CHECK(mean.x > 0.5 - mean.y - lost);
}

TEST_CASE("punctual lights on a matte plane match the closed form", "[render]") {
  std::string const machine = GENERATE(from_range(machines()));
  CAPTURE(machine);
  scene s;
  material ground;
  ground.base_color = {0.5f, 0.6f, 0.7f};
  s.materials = {ground};
  add_quad(s, {-50, -50, 0}, {100, 0, 0}, {0, 100, 0}, 0);
  s.view.position = {0, 0, 3};
  s.view.tan_half_yfov = 1e-4f;  // one point of the plane
  punctual_light light;
  light.intensity = {20, 30, 40};
  double cos_theta = 0.8, falloff = 1.0 / 25;
  SECTION("point") { light.position = {3, 0, 4}; }
  SECTION("spot") {
    light.kind = punctual_light::type::spot;
    light.position = {3, 0, 4};
    light.direction = {-0.6f, 0, -0.8f};
    light.cos_inner = 0.99f;
    light.cos_outer = 0.9f;
  }
  SECTION("directional") {
    light.kind = punctual_light::type::directional;
    light.direction = {-0.6f, 0, -0.8f};
    falloff = 1;
  }
  s.lights = {light};
  render_result const r = render(s, small(1, 2, machine));
  for (vec3 const& p : r.pixels)
    for (int k = 0; k < 3; ++k) {
      double const irradiance = double{light.intensity[k]} * falloff * cos_theta;
      REQUIRE_THAT(double{p[k]},
                   WithinRel(double{ground.base_color[k]} / double{pi} * irradiance, 1e-3));
    }
}

TEST_CASE("what stands before a punctual light darkens, what stands behind it does not",
          "[render]") {
  std::string const machine = GENERATE(from_range(machines()));
  CAPTURE(machine);
  scene s;
  s.materials.resize(1);
  add_quad(s, {-50, -50, 0}, {100, 0, 0}, {0, 100, 0}, 0);
  add_quad(s, {-1, -1, 2}, {2, 0, 0}, {0, 2, 0}, 0);
  s.view.position = {0, 0, 1};
  s.view.tan_half_yfov = 1e-4f;
  s.lights.resize(1);
  s.lights[0].intensity = vec3{1};
  s.lights[0].position = {0, 0, 2.5f};
  for (vec3 const& p : render(s, small(1, 2, machine)).pixels) REQUIRE(p == vec3{0});
  s.lights[0].position = {0, 0, 1.5f};
  for (vec3 const& p : render(s, small(1, 2, machine)).pixels) REQUIRE(p.x > 0);
}

TEST_CASE("light and BSDF samples of an area light agree with the form factor", "[render]") {
  std::string const machine = GENERATE(from_range(machines()));
  CAPTURE(machine);
  // A lamp of 2 x 2, one above a patch of matte or nearly smooth ground, next to the patch's
  // corner.
  scene s;
  s.materials.resize(2);
  s.materials[0].base_color = vec3{0.8f};
  s.materials[1].kind = shader_of<effects::emitters>;
  s.materials[1].emission = vec3{5};
  s.materials[1].base_color = vec3{0};
  add_quad(s, {-50, -50, 0}, {100, 0, 0}, {0, 100, 0}, 0);
  add_quad(s, {0, 0, 1}, {0, 2, 0}, {2, 0, 0}, 1);
  s.view.position = {0, 0, 0.5f};
  s.view.tan_half_yfov = 1e-4f;
  double const x = 2 / std::sqrt(5.0);
  double const form_factor = 2 * x * std::atan(x) / (2 * double{pi});
  glm::dvec2 const mean = mean_and_error(render(s, small(256, 2, machine)));
  CHECK_THAT(mean.x, WithinAbs(0.8 * 5 * form_factor, mean.y));
  CHECK(mean.y < 0.02);
}

TEST_CASE("a mirror shows the lamp as bright as it is, and glass dims it by Fresnel", "[render]") {
  std::string const machine = GENERATE(from_range(machines()));
  CAPTURE(machine);
  scene s;
  s.materials.resize(2);
  s.materials[1].kind = shader_of<effects::emitters>;
  s.materials[1].emission = vec3{3};
  s.materials[1].base_color = vec3{0};
  s.view.position = {0, 0, 1};
  s.view.tan_half_yfov = 1e-3f;
  add_quad(s, {-5, -5, 0}, {10, 0, 0}, {0, 10, 0}, 0);
  SECTION("mirror") {
    s.materials[0].kind = shader_of<effects::metal>;
    s.materials[0].base_color = {0.9f, 0.8f, 0.7f};
    s.materials[0].roughness = 0;
    add_quad(s, {-50, -50, 3}, {0, 100, 0}, {100, 0, 0}, 1);
    glm::dvec2 const mean = mean_and_error(render(s, small(16, 2, machine)));
    CHECK_THAT(mean.x, WithinAbs(3 * 0.8, 5e-3));
  }
  SECTION("glass") {
    s.materials[0].kind = shader_of<effects::smooth_glass>;
    s.materials[0].transmission = 1;
    s.materials[0].base_color = vec3{0.5f};
    add_quad(s, {-50, -50, -3}, {100, 0, 0}, {0, 100, 0}, 1);
    glm::dvec2 const mean = mean_and_error(render(s, small(64, 2, machine)));
    CHECK_THAT(mean.x, WithinAbs(3 * 0.5 * 0.96, mean.y));
  }
}
