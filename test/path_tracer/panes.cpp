// SPDX-License-Identifier: Apache-2.0
// Glass without an inside (KHR_materials_transmission without KHR_materials_volume).
#include <cmath>

#include "bsdf_support.hpp"
#include "hard_directions.hpp"
#include "machines.hpp"

using namespace path_tracer;

namespace {

/// A floor seen at one point, and a pane over it, tilted about y.
scene under_pane(float tilt) {
  scene s;
  s.materials.resize(3);
  s.materials[0].base_color = vec3{0.6f};
  material& pane = s.materials[1];
  pane.kind = shader_of<effects::smooth_glass>;
  pane.base_color = {0.9f, 0.8f, 0.7f};
  pane.roughness = 0;
  pane.transmission = 1;
  pane.thin = true;
  s.materials[2].kind = shader_of<effects::emitters>;
  s.materials[2].emission = vec3{5};
  s.materials[2].base_color = vec3{0};
  add_quad(s, {-50, -50, 0}, {100, 0, 0}, {0, 100, 0}, 0);
  vec3 const along{std::cos(tilt), 0, std::sin(tilt)};
  add_quad(s, vec3{0, -20, 1} - 20.0f * along, 40.0f * along, {0, 40, 0}, 1);
  s.view.position = {0.3f, 0.2f, 0.1f};
  s.view.tan_half_yfov = 1e-4f;
  return s;
}

}  // namespace

TEST_CASE("a pane lets light of a lamp through to what it shines on", "[panes]") {
  std::string const machine = GENERATE(from_range(machines()));
  for (float const tilt : {0.0f, 0.6f})
    for (int panes = 1; panes <= 2; ++panes) {
      scene s = under_pane(tilt);
      if (panes == 2) add_quad(s, {-20, -20, 2}, {40, 0, 0}, {0, 40, 0}, 1);
      s.lights.resize(1);
      s.lights[0].position = {1.3f, 0.2f, 9};
      s.lights[0].intensity = vec3{100};
      glm::dvec3 const d(1, 0, 9), w = glm::normalize(d);
      glm::dvec3 const normal(-std::sin(double{tilt}), 0, std::cos(double{tilt}));
      double unused;
      double const first = 1 - exact_fresnel(glm::dot(w, normal), 1.5, unused);
      double const second = 1 - exact_fresnel(w.z, 1.5, unused);
      double const share = first * (panes == 2 ? second : 1);
      render_result const r = render(s, small(1, 2, machine));
      CAPTURE(machine, tilt, panes);
      for (int c = 0; c < 3; ++c) {
        double const tint = std::pow(double{s.materials[1].base_color[c]}, panes);
        double const expected = 0.6 / exact_pi * 100 / glm::dot(d, d) * w.z * share * tint;
        for (rgb const& p : r.pixels) REQUIRE_THAT(double{p[c]}, WithinRel(expected, 1e-3));
      }
    }
}

TEST_CASE("what blocks light blocks it behind a pane, a body of glass too", "[panes]") {
  for (std::uint32_t const blocks : {0u, 3u}) {
    scene s = under_pane(0);
    s.materials.push_back(s.materials[1]);
    s.materials[3].thin = false;
    add_quad(s, {-20, -20, 2}, {40, 0, 0}, {0, 40, 0}, blocks);
    s.lights.resize(1);
    s.lights[0].position = {0, 0, 9};
    s.lights[0].intensity = vec3{100};
    for (rgb const& p : render(s, small(1, 2, "cpp")).pixels) REQUIRE(p == rgb{0});
  }
}

TEST_CASE("light and BSDF samples agree behind a pane", "[panes]") {
  std::string const machine = GENERATE(from_range(machines()));
  scene s = under_pane(0.4f);
  add_quad(s, {-2, -2, 4}, {0, 4, 0}, {4, 0, 0}, 2);
  glm::dvec2 means[3];
  for (estimator const how : {estimator::mis, estimator::bsdf, estimator::light}) {
    render_settings settings = small(256, 4, machine);
    settings.accuracy.light = how;
    means[static_cast<int>(how)] = mean_and_error(render(s, settings));
    CHECK(means[static_cast<int>(how)].y < 0.03 * means[0].x);
  }
  for (glm::dvec2 const& m : means) {
    CAPTURE(machine, m.x, m.y, means[0].x);
    CHECK_THAT(m.x, WithinAbs(means[0].x, m.y + means[0].y));
  }
}

TEST_CASE("a pane does not shift what is seen through it", "[panes]") {
  for (float const cosine : cosines) {
    vec3 const wo = viewer(cosine);
    bsdf_sample const s = bsdf_smooth_glass{vec3{1}, 1.5f, true}.sample(wo, {0, 0, 0.999f});
    CHECK(s.wi == -wo);
    CHECK(s.straight);
  }
}

TEST_CASE("a rough pane transmits the mirror image of a reflection", "[panes]") {
  bsdf_rough_glass const pane{vec3{1}, 1.5f, {alpha_of(0.5f)}, true};
  for (std::uint32_t i = 0; i < 1000; ++i) {
    vec3 const u = draw3(i), wo = polar(0.05f + 0.94f * u.x, 6 * u.z),
               wi = polar(0.05f + 0.94f * u.y, 0.5f);
    double unused;
    double const f = exact_fresnel(
        glm::dot(glm::dvec3(wo), glm::normalize(glm::dvec3(wo) + glm::dvec3(wi))), 1.5, unused);
    float const up = pane.value(wo, wi).f_cos.x, down = pane.value(wo, {wi.x, wi.y, -wi.z}).f_cos.x;
    CAPTURE(i, wo.z, wi.z);
    REQUIRE_THAT(double{down}, WithinRel(double{up} * (1 - f) / f, 1e-3));
  }
}
