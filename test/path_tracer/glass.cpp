// SPDX-License-Identifier: Apache-2.0
// Glass beside metal, and mirrors and glass whose shading normals are not those of their triangles.
#include <cmath>

#include "bsdf_support.hpp"
#include "hard_support.hpp"
#include "machines.hpp"
#include "scene/surface.hpp"

using namespace path_tracer;

namespace {

glm::dvec3 exact_up(glm::dvec3 v) { return v.z < 0 ? -v : v; }

/// A ball of few triangles with smooth normals in a sky of radiance 1.
scene ball_in_sky(material const& m) {
  scene s;
  s.materials = {m};
  s.triangles = ball({0, 0, 0}, 1, 1);
  s.background = vec3{1};
  s.view.position = {0, 0, 4};
  s.view.tan_half_yfov = 0.3f;
  return s;
}

std::size_t count_off(render_result const& r, float tolerance) {
  std::size_t off = 0;
  for (rgb const& p : r.pixels)
    for (int c = 0; c < 3; ++c) off += std::abs(p[c] - 1) > tolerance ? 1u : 0u;
  return off;
}

}  // namespace

TEST_CASE("metal beside glass takes its share", "[glass]") {
  material m;
  m.base_color = {0.9f, 0.6f, 0.3f};
  m.roughness = 0.4f;
  for (float const metallic : {0.0f, 0.3f, 0.9f})
    for (float const transmission : {0.2f, 0.7f, 1.0f}) {
      m.metallic = metallic;
      m.transmission = transmission;
      auto const found = effects::rough_glass::bsdf(material_point(m));
      bsdf_rough_glass const clear{m.base_color, 1.5f, {alpha_of(0.4f)}};
      bsdf_plastic const dull{{m.base_color, 0, 0.4f, 1.5f, 1, vec3{1}}, tables()};
      bsdf_metal const metal{{{alpha_of(0.4f)}, m.base_color, vec3{1}}};
      for (std::uint32_t i = 0; i < 300; ++i) {
        vec3 const u = draw3(i), wo = polar(0.05f + 0.94f * u.x, 6 * u.z),
                   wi = polar(1 - 2 * u.y, 0.5f);
        vec3 const f = found.value(wo, wi).f_cos, g = clear.value(wo, wi).f_cos,
                   d = dull.value(wo, wi).f_cos, c = metal.value(wo, wi).f_cos;
        CAPTURE(metallic, transmission, i);
        for (int k = 0; k < 3; ++k) {
          double const rest = (1 - double{transmission}) * double{d[k]};
          double const expected =
              double{metallic} * double{c[k]} +
              (1 - double{metallic}) * (double{transmission} * double{g[k]} + rest);
          REQUIRE_THAT(double{f[k]}, WithinRel(expected, 1e-4) || WithinAbs(expected, 1e-6));
        }
      }
    }
}

TEST_CASE("a mirror with smooth normals shows the sky up to its rim", "[glass]") {
  std::string const machine = GENERATE(from_range(machines()));
  material m;
  m.kind = shader_of<effects::metal>;
  m.base_color = vec3{1};
  m.metallic = 1;
  m.roughness = 0;
  // A lobe of alpha 0.002 is a little short of 1 at grazing angles.
  CHECK(count_off(render(ball_in_sky(m), small(4, 30, machine)), 0.02f) == 0);
}

TEST_CASE("glass with smooth normals shows the sky up to its rim", "[glass]") {
  std::string const machine = GENERATE(from_range(machines()));
  material m;
  m.kind = shader_of<effects::smooth_glass>;
  m.base_color = vec3{1};
  m.roughness = 0;
  m.transmission = 1;
  m.thickness = 1;
  // Bent normals keep five paths of a thousand inside for ever.
  render_result const r = render(ball_in_sky(m), small(64, 200, machine));
  CHECK(mean_and_error(r).x > 0.993);
  for (rgb const& p : r.pixels) REQUIRE(p.x > 0.5f);
}

TEST_CASE("a bent normal reflects to the outside, and is kept where it does so", "[glass]") {
  fine_numbers n(671);
  vec3 const outside{0, 0, 1};
  for (int i = 0; i < 100000; ++i) {
    vec3 const wo(exact_up(n.on_sphere())), normal(exact_up(n.on_sphere()));
    vec3 const bent = reflect_above(face_viewer(normal, wo), outside, wo);
    vec3 const kept = 2 * glm::dot(face_viewer(normal, wo), wo) * face_viewer(normal, wo) - wo;
    vec3 const turned = 2 * glm::dot(bent, wo) * bent - wo;
    CAPTURE(i, wo.z, normal.z);
    REQUIRE_THAT(glm::length(bent), WithinAbs(1, 1e-5));
    REQUIRE(turned.z > 0);
    if (kept.z > 0.051f) REQUIRE(bent == face_viewer(normal, wo));
  }
}
