// SPDX-License-Identifier: Apache-2.0
// Samples against densities by chi-squared tests, and reciprocity, also of lobes as narrow as they
// get and at grazing angles.
#include <algorithm>
#include <cmath>
#include <vector>

#include "hard_directions.hpp"
#include "hard_support.hpp"

using namespace path_tracer;

namespace {

constexpr int side = 12;                   // bins per axis
constexpr std::size_t bins = side * side;  // of reflection, then of refraction

/// The bin of a direction by the facet that turns `wo` to it: even bins of a GGX lobe's facets.
std::size_t bin_of(facet_map const& map, glm::dvec3 wi) {
  glm::dvec2 const at = map.shape.place(map.facet_between(wi));
  // Of the cosine q, whose square is even.
  int const row = std::min(static_cast<int>(at.x * at.x * side), side - 1);
  int const column = std::min(static_cast<int>(at.y / (2 * exact_pi) * side), side - 1);
  return static_cast<std::size_t>(row * side + column) + (wi.z > 0 ? 0 : bins);
}

/// How far Pearson's statistic of samples against the integral of the density is above what chance
/// gives, in standard deviations by the cube root of Wilson and Hilferty: above 5 with probability
/// 3e-7. Bins that expect fewer than 10 samples count as one.
template <class Bsdf>
double surprise(Bsdf const& b, facet_map const& map, vec3 wo, fine_numbers& n, int samples) {
  std::vector<double> expected(2 * bins), found(2 * bins);
  double total = 0;
  map.for_each_direction(150000, [&](glm::dvec3 wi, double weight) {
    double const p = weight * double{b.value(wo, vec3(wi)).pdf};
    expected[bin_of(map, wi)] += p * samples;
    total += p;
  });
  double lost = samples;
  for (int i = 0; i < samples; ++i) {
    auto const u = [&] { return static_cast<float>(std::floor(n.uniform() * 0x1p24)) * 0x1p-24f; };
    vec3 const numbers{u(), u(), u()};
    bsdf_sample const s = b.sample(wo, numbers);
    if (!(s.pdf > 0)) continue;
    found[bin_of(map, glm::dvec3(s.wi))] += 1;
    lost -= 1;
  }
  double statistic = 0, rest_expected = samples * std::max(1 - total, 0.0), rest_found = lost;
  int degrees = -1;
  auto const add = [&](double e, double f) {
    statistic += (f - e) * (f - e) / e;
    ++degrees;
  };
  for (std::size_t k = 0; k < 2 * bins; ++k) {
    if (expected[k] >= 10) {
      add(expected[k], found[k]);
    } else {
      rest_expected += expected[k];
      rest_found += found[k];
    }
  }
  add(std::max(rest_expected, 10.0), std::max(rest_found, 10.0));
  double const v = 2.0 / (9 * degrees);
  return (std::cbrt(statistic / degrees) - (1 - v)) / std::sqrt(v);
}

}  // namespace

TEST_CASE("samples of every lobe follow its density, however narrow it is", "[hard]") {
  std::uint64_t const seed = 641;
  fine_numbers n(seed);
  auto const check = [&](char const* name, auto const& b, exact_ggx const& shape, float c,
                         double eta = 0) {
    facet_map const map{shape, exact_polar(double{c}, 0.7), eta};
    CAPTURE(seed, name, c, shape.x, shape.y);
    CHECK(surprise(b, map, vec3(map.wo), n, 40000) < 5);
  };
  for (float const c : {1e-3f, 0.2f, 0.9f}) {
    check("matte", bsdf_matte{vec3{1}}, {0.5, 0.5}, c);
    for (float const r : {0.0f, 0.3f, 1.0f}) {
      double const a = double{alpha_of(r)};
      exact_ggx const shape{a, a};
      check("metal", metal(r), shape, c);
      check("plastic", plastic(r, vec3{1, 0.5f, 0.2f}), shape, c);
      check("glass", glass(r, 1.5f), shape, c, 1.5);
      check("glass from inside", glass(r, 1 / 1.5f), shape, c, double{1 / 1.5f});
      check("clearcoat", coated(r, plastic(r, vec3{1}, 0.3f)), shape, c);
      check("sheen", velvet(r, plastic(r, vec3{1})), shape, c);
      material const oil = oily(r, 350, 0);
      check("oily plastic", filmed(oil), shape, c);
      check("brushed metal", brushed(r, 0.9f, vec3{1}, 1), {a + (1 - a) * 0.81, a, 0.6, 0.8}, c);
    }
  }
}

TEST_CASE("reflection is reciprocal for narrow lobes and at grazing angles", "[hard]") {
  std::uint64_t const seed = 642;
  fine_numbers n(seed);
  auto const check = [&](char const* name, auto const& b, double alpha) {
    double largest = 0;
    for (int i = 0; i < 3000; ++i) {
      // Two directions whose half vector is in the lobe.
      facet_map const map{{alpha, alpha}, exact_polar(n.over_decades(1e-6, 1), 6.28 * n.uniform())};
      glm::dvec3 const wi =
          map.reflected(map.shape.facet(std::sqrt(n.uniform()), 6.28 * n.uniform()));
      if (!(wi.z > 1e-6)) continue;
      vec3 const a(map.wo), c(wi);
      vec3 const there = b.value(a, c).f_cos / c.z, back = b.value(c, a).f_cos / a.z;
      CAPTURE(seed, name, alpha, a.z, c.z, there.x, back.x);
      largest = std::max(largest, double{there.x});
      // Fresnel's term takes the cosine to the half vector, of which rounding leaves two digits
      // where both directions graze.
      double const slack = a.z < 1e-3f && c.z < 1e-3f ? 3e-2 : 2e-3;
      for (int k = 0; k < 3; ++k)
        REQUIRE_THAT(double{there[k]},
                     WithinRel(double{back[k]}, slack) || WithinAbs(double{back[k]}, 1e-6));
    }
    CHECK(largest > 0);
  };
  for (float const r : {0.0f, 1e-4f, 0.1f, 0.5f, 1.0f}) {
    double const alpha = double{alpha_of(r)};
    check("matte", bsdf_matte{vec3{1}}, alpha);
    check("metal", metal(r), alpha);
    check("plastic", plastic(r, vec3{1, 0.5f, 0.2f}), alpha);
    check("glass", glass(r, 1.5f), alpha);
    check("sheen", velvet(r, plastic(r, vec3{1})), alpha);
    check("brushed metal", brushed(r, 0.9f, vec3{1}, 1), alpha);
    check("brushed plastic", brushed(r, 0.3f, vec3{1}, 0), alpha);
    material const oil = oily(r, 350, 0);
    check("oily plastic", filmed(oil), alpha);
  }
}

TEST_CASE("light goes through narrow lobes as it comes back", "[hard]") {
  std::uint64_t const seed = 643;
  fine_numbers n(seed);
  int compared = 0;
  for (float const r : {0.0f, 0.1f, 0.5f})
    for (float const eta : {1.5f, 1 / 1.5f, 2.4f})
      for (int i = 0; i < 3000; ++i) {
        double const alpha = double{alpha_of(r)};
        facet_map const map{
            {alpha, alpha}, exact_polar(n.over_decades(1e-3, 1), 6.28 * n.uniform()), double{eta}};
        glm::dvec3 const m = map.shape.facet(std::sqrt(n.uniform()), 6.28 * n.uniform());
        glm::dvec3 const wi = map.refracted(m);
        if (glm::dot(map.wo, m) < 1e-2 || !(wi.z < -1e-3)) continue;
        vec3 const a(map.wo), c(wi);
        // From below, everything is turned over: z downwards, the other medium near.
        double const there = double{glass(r, eta).value(a, c).f_cos.x} / -double{c.z};
        double const back = double{glass(r, 1 / eta).value(-c, -a).f_cos.x} / double{a.z};
        CAPTURE(seed, r, eta, a.z, c.z);
        // A lobe of alpha 0.002 feels the rounding of a direction, 6e-8, a hundred times.
        REQUIRE_THAT(there,
                     WithinRel(back * double{eta} * double{eta}, 2e-2) || WithinAbs(0, 1e-4));
        compared += there > 1e-3 ? 1 : 0;
      }
  CHECK(compared > 10000);
}
