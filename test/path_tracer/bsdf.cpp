// SPDX-License-Identifier: Apache-2.0
#include "shading/bsdf.hpp"

#include <array>
#include <cmath>
#include <string>

#include "bsdf_support.hpp"
#include "catch.hpp"

using namespace path_tracer;

namespace {

/// The integral of f over the sphere, from a grid that is dense about the poles and the horizon.
template <class Function>
glm::dvec4 over_sphere(int n, Function const& f) {
  glm::dvec4 sum{0};
  for (int i = 0; i < 2 * n; ++i)
    for (int k = 0; k < 2 * n; ++k) {
      double const s = (i % n + 0.5) / n, z = s * s * (3 - 2 * s), weight = 6 * s * (1 - s);
      double const phi = double{pi} * (k + 0.5) / n;
      sum += f(polar(static_cast<float>(i < n ? z : -z), static_cast<float>(phi))) * weight;
    }
  return sum * (double{pi} / (n * n));
}

}  // namespace

TEST_CASE("each density integrates to one, less what the surface swallows", "[bsdf]") {
  for_each_bsdf([](char const* name, auto const& b) {
    for (float const c : cosines) {
      CAPTURE(name, c);
      vec3 const wo = viewer(c);
      double const integral =
          over_sphere(200, [&](vec3 wi) { return glm::dvec4(double{b.value(wo, wi).pdf}); }).x;
      constexpr int count = 20000;
      int taken = 0;
      for (std::uint32_t i = 0; i < count; ++i) taken += b.sample(wo, draw3(i)).pdf > 0 ? 1 : 0;
      CHECK(integral < 1 + 5e-3);
      CHECK_THAT(integral, WithinAbs(double(taken) / count, 0.015));
    }
  });
}

TEST_CASE("samples fall where the density says, with the weight that value() gives", "[bsdf]") {
  for_each_bsdf([](char const* name, auto const& b) {
    for (float const c : {0.3f, 0.9f}) {
      CAPTURE(name, c);
      vec3 const wo = viewer(c);
      // Eight octants by samples and by integration, and the light that each carries.
      std::array<glm::dvec2, 8> found{}, expected{};
      auto const octant = [](vec3 w) {
        return static_cast<std::size_t>((w.x > 0 ? 1 : 0) + (w.y > 0 ? 2 : 0) + (w.z > 0 ? 4 : 0));
      };
      constexpr int count = 20000;
      for (std::uint32_t i = 0; i < count; ++i) {
        bsdf_sample const s = b.sample(wo, draw3(i));
        if (s.pdf == 0) continue;
        bsdf_value const v = b.value(wo, s.wi);
        REQUIRE_THAT(s.pdf, WithinRel(v.pdf, 1e-5f));
        REQUIRE_THAT(s.weight.y * s.pdf, WithinRel(v.f_cos.y, 1e-4f));
        REQUIRE_THAT(glm::length(s.wi), WithinAbs(1, 1e-4));
        found[octant(s.wi)] += glm::dvec2{1, double{s.weight.x}} / double(count);
      }
      for (std::size_t k = 0; k < 8; ++k) {
        glm::dvec4 const sum = over_sphere(200, [&](vec3 wi) {
          bsdf_value const v = octant(wi) == k ? b.value(wo, wi) : bsdf_value{};
          return glm::dvec4{double{v.pdf}, double{v.f_cos.x}, 0, 0};
        });
        expected[k] = {sum.x, sum.y};
      }
      for (std::size_t k = 0; k < 8; ++k) {
        CAPTURE(k);
        CHECK_THAT(found[k].x, WithinAbs(expected[k].x, 0.02));
        CHECK_THAT(found[k].y, WithinAbs(expected[k].y, 0.02));
      }
    }
  });
}

TEST_CASE("directions longer than 1 by their rounding give numbers", "[bsdf]") {
  for_each_bsdf([](char const* name, auto const& b) {
    for (int ulps = -3; ulps <= 3; ++ulps)
      for (std::uint32_t i = 0; i < 100; ++i) {
        float const length = 1 + static_cast<float>(ulps) * 0x1p-23f;
        vec3 const u = draw3(i), wo{0, 0, length};
        CAPTURE(name, ulps, i);
        bsdf_value const straight = b.value(wo, wo), aside = b.value(wo, polar(u.x, 6 * u.y));
        bsdf_sample const s = b.sample(wo, u);
        for (vec3 const& v : {straight.f_cos, aside.f_cos, s.weight})
          REQUIRE(std::isfinite(v.x + v.y + v.z));
        REQUIRE(std::isfinite(straight.pdf + aside.pdf + s.pdf));
      }
  });
}

TEST_CASE("the masking of sheen is that of a cosine of 1 for one that rounds above", "[bsdf]") {
  for (float const alpha : {0.08f, 0.25f, 1.0f}) {
    charlie const sheen{alpha};
    CAPTURE(alpha);
    REQUIRE(std::isfinite(sheen.lambda(1)));
    CHECK(sheen.lambda(1 + 0x1p-23f) == sheen.lambda(1));
    CHECK(sheen.lambda(1 + 0x1p-20f) == sheen.lambda(1));
  }
}

TEST_CASE("reflection is reciprocal", "[bsdf]") {
  for_each_bsdf([](char const* name, auto const& b) {
    if (std::string(name) == "clearcoat") return;  // not in KHR_materials_clearcoat
    for (std::uint32_t i = 0; i < 500; ++i) {
      vec3 const u = draw3(i);
      vec3 const wo = polar(0.05f + 0.94f * u.x, 6 * u.z), wi = polar(0.05f + 0.94f * u.y, 0.5f);
      CAPTURE(name, wo.z, wi.z);
      vec3 const there = b.value(wo, wi).f_cos / wi.z, back = b.value(wi, wo).f_cos / wo.z;
      for (int k = 0; k < 3; ++k)
        REQUIRE_THAT(there[k], WithinRel(back[k], 2e-3f) || WithinAbs(back[k], 1e-5f));
    }
  });
}

TEST_CASE("refraction is reciprocal in radiance over the squared index", "[bsdf]") {
  int compared = 0;
  for (float const eta : {1.5f, 1 / 1.5f, 1.33f})
    for (std::uint32_t i = 0; i < 2000; ++i) {
      vec3 const u = draw3(i);
      vec3 const wo = polar(0.1f + 0.9f * u.x, 6 * u.z), below = polar(-0.1f - 0.9f * u.y, 0.5f);
      CAPTURE(eta, wo.z, below.z);
      float const there = glass(0.7f, eta).value(wo, below).f_cos.y / -below.z;
      // From below, everything is turned over: z downwards, the other medium near.
      float const back = glass(0.7f, 1 / eta).value(-below, -wo).f_cos.y / wo.z;
      REQUIRE_THAT(there, WithinRel(back * eta * eta, 1e-2f) || WithinAbs(back * eta * eta, 1e-4f));
      compared += there > 1e-3f ? 1 : 0;
    }
  CHECK(compared > 1000);
}

TEST_CASE("a plastic without specular is Lambertian to the last bit", "[bsdf]") {
  vec3 const color{0.73f, 0.05f, 0.45f};
  bsdf_matte const matte{color};
  for (float const roughness : {0.0f, 0.3f, 1.0f}) {
    bsdf_plastic const p = plastic(roughness, color, 0, 0);
    for (std::uint32_t i = 0; i < 2000; ++i) {
      vec3 const u = draw3(i), wo = viewer(0.01f + 0.99f * draw3(i + 5000).x);
      bsdf_sample const a = p.sample(wo, u), b = matte.sample(wo, u);
      REQUIRE(a.wi == b.wi);
      REQUIRE(a.weight == b.weight);
      REQUIRE(a.pdf == b.pdf);
      REQUIRE(p.value(wo, b.wi).f_cos == matte.value(wo, b.wi).f_cos);
    }
  }
}

TEST_CASE("the Fresnel equations have their known values", "[bsdf]") {
  float cos_t;
  CHECK_THAT(fresnel_dielectric(1, 1.5f, cos_t), WithinAbs(0.04, 1e-6));
  CHECK_THAT(fresnel_dielectric(1, 1 / 1.5f, cos_t), WithinAbs(0.04, 1e-6));
  // At Brewster's angle the parallel half is 0; the other is ((n^2 - 1) / (n^2 + 1))^2.
  float const brewster = 1 / std::sqrt(1 + 1.5f * 1.5f);
  CHECK_THAT(fresnel_dielectric(brewster, 1.5f, cos_t),
             WithinAbs(0.5 * std::pow(1.25 / 3.25, 2), 1e-6));
  CHECK_THAT(fresnel_dielectric(1e-4f, 1.5f, cos_t), WithinAbs(1, 1e-3));
  CHECK(fresnel_dielectric(0.7f, 1 / 1.5f, cos_t) == 1);  // beyond the critical angle
  CHECK(cos_t == 0);
  (void)fresnel_dielectric(0.6f, 1.5f, cos_t);  // Snell's law
  vec3 const in = refract_direction({0.8f, 0, 0.6f}, {0, 0, 1}, 1.5f, cos_t);
  CHECK_THAT(in.x, WithinAbs(-0.8 / 1.5, 1e-5));
  CHECK_THAT(in.z, WithinAbs(-double{cos_t}, 1e-5));
}

TEST_CASE("the GGX distribution projects to area one", "[bsdf]") {
  for (float const alpha : {0.2f, 0.5f, 1.0f}) {
    ggx const g{alpha};
    double const area = over_sphere(500, [&](vec3 m) {
                          return glm::dvec4(m.z > 0 ? double{g.d(m)} * double{m.z} : 0);
                        }).x;
    CHECK_THAT(area, WithinAbs(1, 5e-3));
  }
}
