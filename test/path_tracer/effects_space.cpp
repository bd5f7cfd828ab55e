// SPDX-License-Identifier: Apache-2.0
// Lens, shutter, sky and fog against what is known of them in closed form.
#include <algorithm>
#include <cmath>
#include <vector>

#include "machines.hpp"
#include "scene/bvh.hpp"
#include "scene/lights.hpp"
#include "shading/path_draws.hpp"

using namespace path_tracer;

namespace {

double const tau = 2 * std::acos(-1.0);

/// A lamp of radiance 1 that reflects nothing, and a matte or black material before it.
scene lit() {
  scene s;
  s.materials.resize(2);
  s.materials[0].base_color = vec3{0.6f};
  s.materials[1].kind = shader_of<effects::emitters>;
  s.materials[1].emission = vec3{1};
  s.materials[1].base_color = vec3{0};
  s.view.position = {0, 0, 1};
  s.view.tan_half_yfov = 1e-3f;
  return s;
}

}  // namespace

TEST_CASE("a lens has the circle of confusion of the thin-lens formula", "[effects]") {
  camera view;
  view.position = {1, 2, 3};
  view.aperture_radius = 0.25f;
  view.focus_distance = 4;
  vec3 const direction = glm::normalize(view.forward + 0.2f * view.right - 0.1f * view.up);
  auto const at_depth = [&](ray const& r, float depth) {
    float const t = (depth - glm::dot(r.origin - view.position, view.forward)) /
                    glm::dot(r.direction, view.forward);
    return r.origin + t * r.direction;
  };
  for (float const depth : {1.0f, 4.0f, 9.0f}) {
    vec3 const centre = at_depth({view.position, direction, INFINITY}, depth);
    double const radius = std::fabs(0.25 * (1 - double{depth} / 4));
    double largest = 0, squares = 0;
    std::uint32_t const count = 20000;
    for (std::uint32_t k = 0; k < count; ++k) {
      ray r{view.position, direction, INFINITY};
      effects::depth_of_field::camera_ray(view, random_stream(7, k, 0), r);
      REQUIRE_THAT(glm::dot(r.direction, r.direction), WithinAbs(1, 1e-5));
      double const off = double{glm::length(at_depth(r, depth) - centre)};
      largest = std::max(largest, off);
      squares += off * off;
    }
    CAPTURE(depth, radius);
    CHECK(largest <= radius + 1e-5);
    CHECK(largest >= radius * 0.99);
    CHECK_THAT(squares / count, WithinAbs(radius * radius / 2, 0.02 * radius * radius + 1e-9));
  }
}

TEST_CASE("what passes while the shutter is open is seen for its share of the time", "[effects]") {
  std::string const machine = GENERATE(from_range(machines()));
  CAPTURE(machine);
  scene s = lit();
  add_quad(s, {-2.5f, -5, -1}, {1, 0, 0}, {0, 10, 0}, 1);
  for (triangle const& t : s.triangles) {
    triangle_motion m{};
    for (int k = 0; k < 3; ++k) {
      m.position[k] = t.position[k] + vec3{4, 0, 0};
      m.normal[k] = t.normal[k];
    }
    s.motion.push_back(m);
  }
  glm::dvec2 const mean = mean_and_error(render(s, small(256, 1, machine)));
  CHECK_THAT(mean.x, WithinAbs(0.25, mean.y));
  CHECK(mean.y < 0.01);
}

TEST_CASE("a lamp that grows while the shutter is open lights by its mean area", "[effects]") {
  std::string const machine = GENERATE(from_range(machines()));
  CAPTURE(machine);
  // Side 1 to 2 at distance 20, facing down at the point that is seen: small enough for a point.
  scene s = lit();
  add_quad(s, {-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, 0);
  add_quad(s, {-0.5f, -0.5f, 20}, {0, 1, 0}, {1, 0, 0}, 1);
  for (triangle const& t : s.triangles) {
    triangle_motion m{};
    for (int k = 0; k < 3; ++k) {
      vec3 const p = t.position[k];
      m.position[k] = t.material == 1 ? vec3{2 * p.x, 2 * p.y, p.z} : p;
      m.normal[k] = t.normal[k];
    }
    s.motion.push_back(m);
  }
  glm::dvec2 const mean = mean_and_error(render(s, small(64, 2, machine)));
  double const area = 7.0 / 3;  // the mean of (1 + t)^2
  CHECK_THAT(mean.x, WithinRel(0.6 * 2 / tau * area / 400, 0.01));
}

TEST_CASE("fog lets through what the exponential law says", "[effects]") {
  std::string const machine = GENERATE(from_range(machines()));
  CAPTURE(machine);
  scene s = lit();
  add_quad(s, {-9, -9, -1}, {18, 0, 0}, {0, 18, 0}, 1);
  s.medium_absorption = {0.1f, 0.6f, 0};
  render_result const r = render(s, small(256, 4, machine));
  for (int c = 0; c < 3; ++c) {
    glm::dvec2 const mean = mean_and_error(r, c);
    CAPTURE(c);
    CHECK_THAT(mean.x, WithinAbs(std::exp(-2 * double{s.medium_absorption[c]}), mean.y + 1e-5));
    CHECK(mean.y < 0.02);
  }
}

TEST_CASE("fog hides the sky from the channels that it takes away, and from no other",
          "[effects]") {
  std::string const machine = GENERATE(from_range(machines()));
  CAPTURE(machine);
  scene s = lit();
  add_quad(s, {5, 5, 9}, {1, 0, 0}, {0, 1, 0}, 0);  // out of sight
  s.background = vec3{0.5f};
  s.medium_absorption = {0, 0.1f, 0.2f};
  render_result const r = render(s, small(256, 4, machine));
  glm::dvec2 const red = mean_and_error(r, 0);
  CHECK_THAT(red.x, WithinAbs(0.5, red.y));
  CHECK(red.y < 0.05);
  CHECK(mean_and_error(r, 1).x == 0);
  CHECK(mean_and_error(r, 2).x == 0);
}

TEST_CASE("fog that takes nothing away vanishes in a furnace", "[effects]") {
  std::string const machine = GENERATE(from_range(machines()));
  float const anisotropy = GENERATE(-0.5f, 0.0f, 0.8f);
  CAPTURE(machine, anisotropy);
  material wall;
  wall.kind = shader_of<effects::emitters>;
  wall.emission = vec3{1};
  wall.base_color = vec3{0};
  scene s = box_of(wall);
  s.medium_scattering = {0.5f, 1, 2};
  s.medium_anisotropy = anisotropy;
  render_result const r = render(s, small(128, 200, machine));
  for (int c = 0; c < 3; ++c) {
    glm::dvec2 const mean = mean_and_error(r, c);
    CAPTURE(c);
    CHECK_THAT(mean.x, WithinAbs(1, mean.y));
    CHECK(mean.y < 0.1);
  }
}

TEST_CASE("the phase function integrates to one and turns light by its mean cosine", "[effects]") {
  for (float const g : {-0.9f, -0.3f, 0.0f, 1e-4f, 0.5f, 0.95f}) {
    CAPTURE(g);
    double sum = 0, cosines = 0, drawn = 0;
    int const count = 200000;
    for (int k = 0; k < count; ++k) {
      double const cosine = -1 + (k + 0.5) * 2 / count;
      double const p = double{phase(g, static_cast<float>(cosine))} * tau * 2 / count;
      sum += p;
      cosines += p * cosine;
      drawn += double{sample_phase(g, (static_cast<float>(k) + 0.5f) / count)} / count;
    }
    CHECK_THAT(sum, WithinAbs(1, 1e-3));
    CHECK_THAT(cosines, WithinAbs(double{g}, 1e-3));
    CHECK_THAT(drawn, WithinAbs(double{g}, 1e-3));
  }
}

TEST_CASE("the density of sky samples integrates to one", "[effects]") {
  scene s;
  s.materials.resize(1);
  add_quad(s, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 0);
  s.sky = {4, 3, {}};
  for (int k = 0; k < 12; ++k) s.sky.texels.push_back(vec3{static_cast<float>(k % 5)});
  s.environment_rotation = 0.4f;
  light_list const list(s);
  light_view const lights = list.view(s);
  double sum = 0;
  int const steps = 600;
  for (int y = 0; y < steps; ++y)
    for (int x = 0; x < 2 * steps; ++x) {
      vec2 const uv{(float(x) + 0.5f) / float(2 * steps), (float(y) + 0.5f) / float(steps)};
      vec2 const back = lights.sky.coordinates(lights.sky.direction(uv));
      REQUIRE(std::fabs(back.x - uv.x) + std::fabs(back.y - uv.y) < 1e-4f);
      sum += double{sky_pdf(lights, uv)} * std::sin(tau / 2 * double{uv.y}) * (tau / 2 / steps) *
             (tau / (2 * steps));
    }
  CHECK_THAT(sum, WithinAbs(1, 1e-4));
}

TEST_CASE("a sky turns counter-clockwise, and a black one is dark", "[effects]") {
  scene s = lit();
  s.sky = {4, 2, std::vector<vec3>(8, vec3{0})};
  light_list const list(s);
  environment_view sky = list.view(s).sky;
  CHECK(list.view(s).count == 0);
  vec3 const middle = sky.direction({0.5f, 0.5f});
  CHECK_THAT(middle.z, WithinAbs(-1, 1e-6));
  CHECK_THAT(sky.direction({0.75f, 0.5f}).x, WithinAbs(1, 1e-6));
  CHECK_THAT(sky.direction({0.5f, 0}).y, WithinAbs(1, 1e-6));
  sky.rotation = pi / 2;  // about +y from -z: to -x
  CHECK_THAT(sky.direction({0.5f, 0.5f}).x, WithinAbs(-1, 1e-6));
  add_quad(s, {-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, 0);
  std::string const machine = GENERATE(from_range(machines()));
  render_result const r = render(s, small(1, 3, machine));
  CHECK(mean_and_error(r).x == 0);
  CHECK(r.discarded_samples == 0);
}

TEST_CASE("a sky lights a plane by the integral over it", "[effects]") {
  std::string const machine = GENERATE(from_range(machines()));
  CAPTURE(machine);
  scene s = lit();
  add_quad(s, {-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, 0);
  s.sky = {8, 4, {}};
  for (int k = 0; k < 32; ++k) s.sky.texels.push_back(vec3{k == 17 ? 40.0f : 0.1f * float(k % 7)});
  s.environment_intensity = 0.5f;
  s.environment_rotation = 1;
  light_list const list(s);
  environment_view const sky = list.view(s).sky;
  double irradiance = 0;
  int const steps = 1000;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      double const z = std::sqrt((i + 0.5) / steps), phi = tau * (j + 0.5) / steps;
      vec3 const d = polar(static_cast<float>(z), static_cast<float>(phi));
      irradiance += double{sky.radiance(sky.coordinates(d)).y} * tau / 2 / (steps * steps);
    }
  glm::dvec2 const mean = mean_and_error(render(s, small(128, 2, machine)));
  CAPTURE(irradiance);
  CHECK_THAT(mean.x, WithinAbs(0.6 * irradiance * 2 / tau, mean.y));
  CHECK(mean.y < 0.05 * mean.x);
}
