// SPDX-License-Identifier: Apache-2.0
// Energy of BSDFs and integrals of their densities, from roughness 0 to 1 and to grazing angles.
#include <cmath>

#include "hard_directions.hpp"
#include "hard_support.hpp"

using namespace path_tracer;

namespace {

constexpr float roughnesses[] = {0, 1e-4f, 0.03f, 0.1f, 0.3f, 0.6f, 1};
constexpr float grazing_cosines[] = {1e-6f, 1e-4f, 1e-2f, 0.1f, 0.5f, 1};

/// What a white lobe reflects and lets through by single scattering, and what of the visible facets
/// turns light nowhere; all in double.
struct exact_shares {
  double reflected = 0, refracted = 0, lost = 0;
};
exact_shares shares_of(facet_map const& map, bool conductor, int n) {
  exact_shares sum;
  for (int i = 0; i < n; ++i) {
    glm::dvec2 const at = place_in_lattice(i, n);
    glm::dvec3 const m = map.shape.facet(at.x, at.y);
    double const visible = map.shape.visible(map.wo, m, at.x) * 2 * exact_pi / n;
    if (!(visible > 0)) continue;
    double cos_t = 0;
    double const f = conductor ? 1 : exact_fresnel(glm::dot(map.wo, m), map.eta, cos_t);
    glm::dvec3 const up = map.reflected(m);
    auto const left = [&](glm::dvec3 wi) {
      wi.z = std::abs(wi.z);
      return map.shape.g2(map.wo, wi) / map.shape.g1(map.wo);
    };
    (up.z > 0 ? sum.reflected : sum.lost) += f * visible * (up.z > 0 ? left(up) : 1);
    if (f == 1) continue;
    glm::dvec3 const down = map.refracted(m);
    (down.z < 0 ? sum.refracted : sum.lost) += (1 - f) * visible * (down.z < 0 ? left(down) : 1);
  }
  return sum;
}

struct integrals {
  double energy = 0, density = 0;
};
template <class Bsdf>
integrals integrate(Bsdf const& b, facet_map const& map, vec3 wo, int n) {
  integrals sum;
  map.for_each_direction(n, [&](glm::dvec3 wi, double weight) {
    bsdf_value const v = b.value(wo, vec3(wi));
    sum.energy += weight * double{max_component(v.f_cos)};
    sum.density += weight * double{v.pdf};
  });
  return sum;
}

exact_ggx shape_of(float roughness) {
  double const alpha = double{alpha_of(roughness)};
  return {alpha, alpha};
}

/// What the density may be off. The half vector of two directions in float, next to each other at
/// grazing angles, is noisy by 6e-8 over its length; a lobe of alpha 0.002 feels that.
double slack_of(float roughness, float cosine) {
  return alpha_of(roughness) < 0.01f && cosine < 1e-3f ? 3e-3 : 1e-3;
}

/// The share of samples that sample() drops, from numbers of low discrepancy.
template <class Bsdf>
double dropped(Bsdf const& b, vec3 wo, int count) {
  glm::dvec3 const step{0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
  int none = 0;
  for (int i = 0; i < count; ++i)
    none += b.sample(wo, vec3(glm::fract(step * (i + 0.5)))).pdf > 0 ? 0 : 1;
  return static_cast<double>(none) / count;
}

}  // namespace

TEST_CASE("a white metal loses what single scattering loses, at any roughness and angle",
          "[hard]") {
  for (float const r : roughnesses)
    for (float const c : grazing_cosines) {
      facet_map const map{shape_of(r), exact_polar(double{c}, 0.7)};
      vec3 const wo(map.wo);
      exact_shares const exact = shares_of(map, true, 200000);
      integrals const found =
          integrate(bsdf_metal{{{alpha_of(r)}, vec3{1}, vec3{1}}}, map, wo, 60000);
      CAPTURE(r, c, exact.reflected, exact.lost);
      CHECK(found.energy <= 1 + 1e-3);
      CHECK_THAT(found.energy, WithinAbs(exact.reflected, slack_of(r, c)));
      CHECK_THAT(found.density, WithinAbs(1 - exact.lost, slack_of(r, c)));
    }
}

TEST_CASE("clear glass loses what single scattering loses, at any roughness and angle", "[hard]") {
  for (float const eta : {1.5f, 1 / 1.5f})
    for (float const r : roughnesses)
      for (float const c : grazing_cosines) {
        facet_map const map{shape_of(r), exact_polar(double{c}, 0.7), double{eta}};
        vec3 const wo(map.wo);
        exact_shares const exact = shares_of(map, false, 200000);
        integrals const found =
            integrate(bsdf_rough_glass{vec3{1}, eta, {alpha_of(r)}}, map, wo, 60000);
        CAPTURE(eta, r, c, exact.reflected, exact.refracted, exact.lost);
        CHECK(found.energy <= 1 + 1e-3);
        CHECK_THAT(found.energy, WithinAbs(exact.reflected + exact.refracted, slack_of(r, c)));
        CHECK_THAT(found.density, WithinAbs(1 - exact.lost, slack_of(r, c)));
      }
}

TEST_CASE("brushed metal loses what single scattering loses, at any roughness and angle",
          "[hard]") {
  for (float const r : {0.0f, 0.3f, 1.0f})
    for (float const strength : {0.3f, 1.0f})
      for (float const c : grazing_cosines) {
        double const y = double{alpha_of(r)};
        double const x = y + (1 - y) * double{strength} * double{strength};
        facet_map const map{{x, y, 0.6, 0.8}, exact_polar(double{c}, 0.7)};
        vec3 const wo(map.wo);
        exact_shares const exact = shares_of(map, true, 200000);
        integrals const found = integrate(brushed(r, strength, vec3{1}, 1), map, wo, 60000);
        CAPTURE(r, strength, c, exact.reflected, exact.lost);
        CHECK(found.energy <= 1 + 1e-3);
        CHECK_THAT(found.energy, WithinAbs(exact.reflected, slack_of(r, c)));
        CHECK_THAT(found.density, WithinAbs(1 - exact.lost, slack_of(r, c)));
      }
}

TEST_CASE("layers over a white base give back no more than they get, and little less", "[hard]") {
  for (float const r : roughnesses)
    for (float const c : grazing_cosines) {
      facet_map const map{shape_of(r), exact_polar(double{c}, 0.7)};
      vec3 const wo(map.wo);
      bsdf_plastic const white{{vec3{1}, 0, r, 1.5f, 1, vec3{1}}, tables()};
      // What a lobe of F0 0.04 has lost at most: all that its facets lose.
      double const loss = 1 - shares_of(map, true, 40000).reflected;
      auto const check = [&](char const* name, auto const& b, double least, double strength = 0) {
        facet_map around = map;
        around.shape.x += (1 - around.shape.x) * strength * strength;
        if (strength > 0) around.shape.cosine = 0.6, around.shape.sine = 0.8;
        integrals const found = integrate(b, around, wo, 40000);
        CAPTURE(name, r, c, loss);
        CHECK(found.energy <= 1 + 1e-3);
        CHECK(found.energy >= least);
        CHECK_THAT(found.density, WithinAbs(1 - dropped(b, wo, 50000), slack_of(r, c) + 5e-4));
      };
      check("matte", bsdf_matte{vec3{1}}, 1 - 1e-3);
      check("plastic", white, 1 - loss - 1e-2);
      check("half metal", plastic(r, vec3{1}, 0.5f), 1 - loss - 0.1);
      check("clearcoat", coated(r, white), r < 0.1f ? 1 - 2 * loss - 0.2 : 0.05);
      check("sheen", bsdf_layered<sheen_lobe, bsdf_plastic>{{vec3{1}, r, tables()}, white, 1},
            1 - loss - 0.3);
      check("brushed plastic", brushed(r, 0.5f, vec3{1}, 0), 1 - loss - 0.1, 0.5);
      material const oil = oily(r, 350, 0);
      check("oily plastic", filmed(oil), 0.5);
    }
}
