// SPDX-License-Identifier: Apache-2.0
// Sampling functions at the ends of their input, and lights and skies that are far from even.
#include <cmath>
#include <limits>
#include <vector>

#include "bsdf_support.hpp"
#include "hard_support.hpp"
#include "machines.hpp"
#include "scene/lights.hpp"
#include "shading/spectrum.hpp"

using namespace path_tracer;

namespace {

/// The ends of [0, 1), numbers between, and what is not normal.
constexpr float ends[] = {0,       0x1p-149f, 0x1p-127f, 0x1p-126f,    0x1p-24f,
                          0x1p-2f, 0.5f,      0.75f,     1 - 0x1p-23f, 1 - 0x1p-24f};

bool is_direction(vec3 w) { return std::abs(glm::length(glm::dvec3(w)) - 1) < 1e-6; }

/// Triangles of area 1 / 2 side by side that look down, of such radiances.
scene lamps(std::vector<float> const& radiances) {
  scene s;
  for (std::uint32_t i = 0; i < radiances.size(); ++i) {
    material m;
    m.kind = shader_of<effects::emitters>;
    m.emission = vec3{radiances[i]};
    m.base_color = vec3{0};
    s.materials.push_back(m);
    auto const x = static_cast<float>(2 * i);
    s.triangles.push_back(make_triangle({x, 0, 2}, {x, 1, 2}, {x + 1, 0, 2}));
    s.triangles.back().material = i;
  }
  return s;
}

}  // namespace

TEST_CASE("directions are unit vectors for numbers at the ends of their range", "[hard]") {
  for (float const a : ends)
    for (float const b : ends) {
      CAPTURE(a, b);
      vec3 const w = sample_cosine({a, b});
      REQUIRE(is_direction(w));
      REQUIRE(w.z > 0);  // else its density would be 0
      // The sine of the angle is the root of the number, however near to the pole.
      REQUIRE_THAT(std::hypot(double{w.x}, double{w.y}),
                   WithinRel(std::sqrt(double{b}), 1e-6) || WithinAbs(0, 1e-37));
      vec3 const p = polar(b, 2 * pi * a);
      REQUIRE(is_direction(p));
      REQUIRE_THAT(std::hypot(double{p.x}, double{p.y}),
                   WithinRel(std::sqrt((1 - double{b}) * (1 + double{b})), 1e-6));
      for (float const g : {-0.99f, -1e-4f, 0.0f, 1e-3f, 0.99f}) {
        float const cosine = sample_phase(g, a);
        REQUIRE(std::abs(cosine) <= 1);
        REQUIRE(phase(g, cosine) > 0);
        REQUIRE(std::isfinite(phase(g, cosine)));
      }
      REQUIRE(sample_wavelength(a) >= shortest_wavelength);
      REQUIRE(sample_wavelength(a) <= longest_wavelength);
      for (float const share : ends) {
        float u = b;
        bool const first = choose(share, u);
        REQUIRE(first == (b < share));
        REQUIRE(u >= 0);
        REQUIRE(u < 1);
      }
    }
}

TEST_CASE("the sine of a direction next to the pole has all its digits", "[hard]") {
  std::uint64_t const seed = 622;
  fine_numbers n(seed);
  for (int i = 0; i < 100000; ++i) {
    auto const c = static_cast<float>(1 - n.over_decades(1e-7, 1));
    auto const phi = static_cast<float>(6.28 * n.uniform());
    vec3 const w = polar(c, phi);
    CAPTURE(seed, c, phi);
    REQUIRE_THAT(std::hypot(double{w.x}, double{w.y}),
                 WithinRel(std::sqrt((1 - double{c}) * (1 + double{c})), 1e-6));
  }
}

TEST_CASE("samples of a BSDF are finite for numbers at the ends of their range", "[hard]") {
  auto const check = [](char const* name, auto const& b) {
    for (float const c : {1e-6f, 1e-3f, 0.5f, 1.0f})
      for (float const x : ends)
        for (float const y : ends)
          for (float const z : ends) {
            bsdf_sample const s = b.sample(viewer(c), {x, y, z});
            CAPTURE(name, c, x, y, z);
            REQUIRE(is_direction(s.wi));
            REQUIRE(s.pdf >= 0);
            REQUIRE(std::isfinite(s.pdf));
            for (int k = 0; k < 3; ++k) REQUIRE((s.weight[k] >= 0 && s.weight[k] < 1.1f));
          }
  };
  for (float const r : {0.0f, 0.2f, 1.0f}) {
    check("metal", metal(r));
    check("glass", glass(r, 1.5f));
    check("glass from inside", glass(r, 1 / 1.5f));
    check("brushed metal", brushed(r, 0.9f, vec3{1}, 1));
  }
  check("smooth glass", bsdf_smooth_glass{vec3{1}, 1.5f});
  check("matte", bsdf_matte{vec3{1}});
}

TEST_CASE("the phase function is exact next to its peak", "[hard]") {
  std::uint64_t const seed = 621;
  fine_numbers n(seed);
  for (int i = 0; i < 100000; ++i) {
    auto const g = static_cast<float>((i % 2 == 0 ? 1 : -1) * n.over_decades(0.1, 0.99));
    double const off = n.over_decades(1e-7, 2);
    auto const cosine = static_cast<float>((g > 0 ? 1 : -1) * (1 - off));
    double const exact_g = double{g}, exact_c = double{cosine};
    double const root2 = 1 + exact_g * exact_g - 2 * exact_g * exact_c;
    double const expected =
        (1 - exact_g * exact_g) / (4 * std::acos(-1.0) * root2 * std::sqrt(root2));
    CAPTURE(seed, g, cosine);
    REQUIRE_THAT(double{phase(g, cosine)}, WithinRel(expected, 2e-5));
  }
}

TEST_CASE("a light is picked as often as its density says, were it a million times dimmer",
          "[hard]") {
  for (float const bright : {1e5f, 1e6f, 3e7f}) {
    scene const s = lamps({1, bright, 1});
    light_list const list(s);
    light_view const lights = list.view(s);
    REQUIRE(lights.count == 3);
    // The first number of a pick on a fine grid, the second on that of the random numbers, up to
    // where the dim lights end.
    double const dim = 1 / (2.0 + double{bright});
    int const columns = 3 * 4096;
    std::vector<double> found(3);
    for (int x = 0; x < columns; ++x) {
      double const share = (x + 0.5) / columns;
      auto const u = static_cast<float>(share);
      int y = 0;
      for (; y < 0x1000000; ++y) {
        std::uint32_t const entry =
            pick_entry(lights.entries, lights.count, {u, static_cast<float>(y) * 0x1p-24f});
        if (lights.entries[entry].index == 1) break;
        found[lights.entries[entry].index] += 0x1p-24 / columns;
      }
      found[1] += (0x1000000 - y) * 0x1p-24 / columns;
    }
    CAPTURE(bright, found[0], found[1], found[2]);
    CHECK_THAT(found[0], WithinRel(dim, 5e-3));
    CHECK_THAT(found[2], WithinRel(dim, 5e-3));
    CHECK_THAT(found[1], WithinRel(1 - 2 * dim, 1e-6));
  }
}

TEST_CASE("lights without area or radiance are never picked", "[hard]") {
  scene s = lamps({0, 1, 0, 2, 0});
  s.triangles.push_back(make_triangle({9, 0, 2}, {9, 1, 2}, {9, 2, 2}));
  s.triangles.back().material = 1;
  s.triangles.push_back(make_triangle({9, 0, 2}, {9, 0, 2}, {9, 0, 2}));
  s.triangles.back().material = 3;
  light_list const list(s);
  light_view const lights = list.view(s);
  REQUIRE(lights.count == 2);
  double sum = 0;
  for (std::uint32_t i = 0; i < lights.count; ++i) {
    REQUIRE((lights.entries[i].index == 1 || lights.entries[i].index == 3));
    sum += double{lights.entries[i].probability};
  }
  CHECK_THAT(sum, WithinAbs(1, 1e-6));
  for (float const a : ends)
    for (float const b : ends) {
      std::uint32_t const entry = pick_entry(lights.entries, lights.count, {a, b});
      REQUIRE(entry < lights.count);
      for (float const c : ends)
        for (float const d : ends) {
          light_sample const l =
              sample_light<every_effect>(lights, {3, 0.3f, 0}, {{a, b}, {c, d}, {0, 0}, 0});
          REQUIRE(std::isfinite(l.pdf));
          REQUIRE(l.pdf > 0);
          REQUIRE(is_direction(l.wi));
        }
    }
}

TEST_CASE("a lamp next to one a million times brighter lights as much as alone", "[hard]") {
  // By exhaustion of what a light sample picks: the mean over the points of the dim lamp alone.
  scene const alone = lamps({1}), both = lamps({1, 0, 1e6f});
  auto const irradiance = [](scene const& s, std::uint32_t wanted) {
    light_list const list(s);
    light_view const lights = list.view(s);
    double sum = 0;
    int const n = 256;
    for (std::uint32_t k = 0; k < lights.count; ++k) {
      if (lights.entries[k].index != wanted) continue;
      triangle const& t = s.triangles[wanted];
      for (int i = 0; i < n * n; ++i) {
        vec2 const place{(static_cast<float>(i % n) + 0.5f) / n,
                         (static_cast<float>(i / n) + 0.5f) / n};
        light_sample const l = sample_emitter<every_effect>(lights, t, s.materials[t.material],
                                                            {0.2f, 0.2f, 0}, place);
        sum += double{l.radiance.x} * double{l.wi.z} / double{l.pdf} / (n * n) *
               double{lights.entries[k].probability};
      }
    }
    return sum;
  };
  CHECK_THAT(irradiance(both, 0), WithinRel(irradiance(alone, 0), 1e-5));
}

TEST_CASE("the power heuristic holds for densities whose squares a float does not have", "[hard]") {
  for (float const a : {1e-30f, 1e-20f, 1.0f, 1e20f, 1e30f})
    for (float const b : {1e-30f, 1e-20f, 1.0f, 1e20f, 1e30f}) {
      double const ratio = double{b} / double{a};
      CAPTURE(a, b);
      CHECK_THAT(double{power_heuristic(a, b)},
                 WithinRel(1 / (1 + ratio * ratio), 1e-5) || WithinAbs(0, 1e-37));
    }
}
