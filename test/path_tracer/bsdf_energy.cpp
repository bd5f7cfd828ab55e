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
      auto const check = [&](char const* name, auto const& b, double least,
                             double most = 1 + 1e-3) {
        CAPTURE(name);
        glm::dvec3 a = albedo(b, wo, 20000);  // good to 2e-3; where that is too near, to 2e-4
        if (max_component(vec3(a)) > 0.999f && max_component(vec3(a)) != 1)
          a = albedo(b, wo, 200000);
        CHECK(std::max({a.x, a.y, a.z}) <= most);
        CHECK(a.x >= least);
      };
      check("matte", bsdf_matte{vec3{1}}, 0.9999);
      check("metal", bsdf_metal{{{alpha_of(r)}, vec3{1}, vec3{1}}}, 0.25);
      check("plastic", white, 0.98);
      check("half metal", plastic(r, vec3{1}, 0.5f), 0.5);
      check("glass", bsdf_rough_glass{vec3{1}, 1.5f, {alpha_of(r)}}, 0.4);
      check("glass from inside", bsdf_rough_glass{vec3{1}, 1 / 1.5f, {alpha_of(r)}}, 0.4);
      check("smooth glass", bsdf_smooth_glass{vec3{1}, 1.5f}, 0.9999);
      // The extension takes Fresnel's term of the normal from the base, also where facets that turn
      // to the viewer reflect less of it. Its own albedo exceeds that term by 6e-4 at most.
      check("clearcoat", coated(r, white), r < 0.1f ? 0.8 : 0.1, 1 + 2e-3);
      check("clearcoat on clearcoat's roughness", coated(0.2f, white), c < 0.1f ? 0.6 : 0.95,
            1 + 2e-3);
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

TEST_CASE("a white base below a clear coat gives all light back", "[bsdf]") {
  for (float const r : {0.0f, 0.05f, 0.1f})
    for (double const degrees : {0.0, 45.0, 75.0}) {
      CAPTURE(r, degrees);
      bsdf_plastic const white{{vec3{1}, 0, 0.6f, 1.5f, 1, vec3{1}}, tables()};
      vec3 const wo = viewer(static_cast<float>(std::cos(degrees * std::acos(-1.0) / 180)));
      CHECK_THAT(albedo(coated(r, white), wo, 200000).x, WithinAbs(1, 3e-3));
    }
}

TEST_CASE("a clear coat is that of its extension", "[bsdf]") {
  // KHR_materials_clearcoat over Lambert, in double; the coat's facets by GGX.
  double const pi_ = std::acos(-1.0);
  bsdf_plastic const matte{{vec3{0.8f, 0.5f, 0.2f}, 0, 1, 1.5f, 0, vec3{1}}, tables()};
  for (float const factor : {0.3f, 1.0f})
    for (float const r : {0.2f, 0.6f})
      for (std::uint32_t i = 0; i < 500; ++i) {
        vec3 const u = draw3(i), wo = polar(0.05f + 0.94f * u.x, 6 * u.z),
                   wi = polar(0.05f + 0.94f * u.y, 0.5f);
        auto const fresnel = [](double c) { return 0.04 + 0.96 * std::pow(1 - c, 5); };
        glm::dvec3 const o(wo), w(wi), h = glm::normalize(o + w);
        double const a = double{r} * double{r}, f = double{factor};
        auto const lambda = [&](double z) { return std::sqrt(a * a + (1 - a * a) * z * z); };
        double const e = h.z * h.z * (a * a - 1) + 1, d = a * a / (pi_ * e * e);
        double const visible = 0.5 / (o.z * lambda(w.z) + w.z * lambda(o.z));
        double const coat = f * fresnel(glm::dot(o, h)) * d * visible;
        vec3 const found = bsdf_layered<coat_lobe, bsdf_plastic>{{factor, r, tables()}, matte, 0.5f}
                               .value(wo, wi)
                               .f_cos;
        CAPTURE(factor, r, i, o.z, w.z);
        for (int k = 0; k < 3; ++k) {
          double const base = double{vec3{0.8f, 0.5f, 0.2f}[k]} / pi_;
          double const expected = (base * (1 - f * fresnel(o.z)) + coat) * w.z;
          REQUIRE_THAT(double{found[k]}, WithinRel(expected, 1e-5));
        }
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
