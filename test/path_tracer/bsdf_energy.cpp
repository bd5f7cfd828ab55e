// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "bsdf_support.hpp"
#include "catch.hpp"

using namespace path_tracer;

namespace {

/// The mean weight of samples: the share of light that comes back, by channel.
template <class Bsdf>
glm::dvec3 albedo(Bsdf const& b, vec3 wo, int count) {
  // The additive recurrence by the root of x^4 = x + 1: low discrepancy in three dimensions.
  glm::dvec3 const step{0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
  glm::dvec3 sum{0};
  for (int i = 0; i < count; ++i)
    sum += glm::dvec3(b.sample(wo, vec3(glm::fract(step * (i + 0.5)))).weight);
  return sum / double(count);
}

}  // namespace

TEST_CASE("no surface gives back more light than it gets", "[bsdf]") {
  for (float const r : {0.0f, 0.05f, 0.15f, 0.3f, 0.6f, 1.0f})
    for (float const c : {0.01f, 0.05f, 0.2f, 0.6f, 1.0f}) {
      CAPTURE(r, c);
      vec3 const wo = viewer(c);
      bsdf_plastic const white{{vec3{1}, 0, r, 1.5f, 1, vec3{1}}, tables()};
      auto const check = [&](char const* name, auto const& b, double least) {
        CAPTURE(name);
        glm::dvec3 a = albedo(b, wo, 20000);  // good to 2e-3; where that is too near, to 2e-4
        if (max_component(vec3(a)) > 0.999f && max_component(vec3(a)) != 1)
          a = albedo(b, wo, 200000);
        CHECK(std::max({a.x, a.y, a.z}) <= 1 + 1e-3);
        CHECK(a.x >= least);
      };
      check("matte", bsdf_matte{vec3{1}}, 0.9999);
      check("metal", bsdf_metal{{{alpha_of(r)}, vec3{1}, vec3{1}}}, 0.25);
      check("plastic", white, 0.98);
      check("half metal", plastic(r, vec3{1}, 0.5f), 0.5);
      check("glass", bsdf_rough_glass{vec3{1}, 1.5f, {alpha_of(r)}}, 0.4);
      check("glass from inside", bsdf_rough_glass{vec3{1}, 1 / 1.5f, {alpha_of(r)}}, 0.4);
      check("smooth glass", bsdf_smooth_glass{vec3{1}, 1.5f}, 0.9999);
      check("clearcoat", coated(r, white), 0.8);
      check("clearcoat on clearcoat's roughness", coated(0.2f, white), 0.8);
      for (float const strength : {0.3f, 0.7f, 1.0f}) {
        CAPTURE(strength);
        check("brushed metal", brushed(r, strength, vec3{1}, 1), 0.25);
        check("brushed plastic", brushed(r, strength, vec3{1}, 0), 0.9);
      }
      material film;
      film.base_color = vec3{1};
      film.roughness = r;
      film.iridescence = 1;
      for (float const thickness : {0.0f, 250.0f, 1000.0f}) {
        CAPTURE(thickness);
        film.film_thickness = thickness;
        film.metallic = 0;
        effects::iridescence::prepare(film);
        check("filmed plastic", filmed(film), 0.7);
        film.metallic = 1;
        effects::iridescence::prepare(film);
        check("filmed metal", filmed(film), 0.25);
      }
      check("sheen", bsdf_layered<sheen_lobe, bsdf_plastic>{{vec3{1}, r, tables()}, white, 1}, 0.7);
    }
}

TEST_CASE("smooth glass is the limit of rough glass", "[bsdf]") {
  for (float const eta : {1.5f, 1 / 1.5f})
    for (float const c : {0.2f, 0.6f, 0.95f}) {
      CAPTURE(eta, c);
      vec3 const wo = viewer(c);
      bsdf_smooth_glass const smooth{vec3{1, 0.9f, 0.8f}, eta};
      glm::dvec3 const a = albedo(smooth, wo, 20000), b = albedo(glass(0.05f, eta), wo, 20000);
      for (int k = 0; k < 3; ++k) CHECK_THAT(a[k], WithinAbs(b[k], 0.01));
    }
}

TEST_CASE("extreme directions and roughness give finite values", "[bsdf]") {
  vec3 const grazing = polar(1e-5f, 0.3f);
  auto const check = [&](char const* name, auto const& b) {
    for (vec3 const& wo : {grazing, vec3{0, 0, 1}})
      for (vec3 const& wi : {grazing, vec3{0, 0, 1}, -grazing, vec3{0, 0, -1}, -wo}) {
        bsdf_value const v = b.value(wo, wi);
        CAPTURE(name, wo.z, wi.z);
        REQUIRE(std::isfinite(v.pdf));
        REQUIRE(std::isfinite(v.f_cos.x + v.f_cos.y + v.f_cos.z));
        for (float const u : {0.0f, 0.5f, 0x1.fffffep-1f}) {
          bsdf_sample const s = b.sample(wo, {u, u, u});
          REQUIRE(std::isfinite(s.pdf));
          REQUIRE(std::isfinite(s.weight.x + s.wi.x + s.wi.y + s.wi.z));
        }
      }
  };
  for (float const r : {0.0f, 1.0f}) {
    check("metal", metal(r));
    check("plastic", plastic(r, vec3{0}));
    check("glass", glass(r, 1.001f));
    check("glass", glass(r, 0.0f));
    check("coated", coated(r, plastic(r, vec3{1})));
    check("velvet", velvet(r, plastic(r, vec3{1})));
    check("ior 0",
          bsdf_plastic{{vec3{1}, 0, r, 0, 1, vec3{1}}, tables()});  // ior 0: all is reflected
  }
}
