// SPDX-License-Identifier: Apache-2.0
// Dielectric interfaces where the equations of Fresnel and Snell cancel, and long chains of them.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "bsdf_support.hpp"
#include "hard_support.hpp"
#include "machines.hpp"
#include "scene/surface.hpp"

using namespace path_tracer;

namespace {

struct refraction {
  double reflectance, cos_t;
};

/// Fresnel's equations by long double, in their textbook form.
refraction reference(long double cos_i, long double eta) {
  long double const sin2_t = (1 - cos_i) * (1 + cos_i) / (eta * eta);
  if (sin2_t >= 1) return {1, 0};
  long double const cos_t = std::sqrt(1 - sin2_t);
  long double const s = (cos_i - eta * cos_t) / (cos_i + eta * cos_t),
                    p = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  return {static_cast<double>((s * s + p * p) / 2), static_cast<double>(cos_t)};
}

/// Whether the float result is that of an angle and an index within some units in the last place of
/// those given, up to a relative error: as right as its input.
bool as_right_as_input(float cos_i, float eta) {
  float cos_t = 0;
  double const found = double{fresnel_dielectric(cos_i, eta, cos_t)};
  double low = 2, high = -1;
  for (int a = -2; a <= 2; ++a)
    for (int b = -2; b <= 2; ++b) {
      // A step of the index is a step of its distance from 1, which float has exactly.
      double const e = 1 + (double{eta} - 1) * (1 + b * 0x1p-23), c = double{cos_i};
      refraction const r = reference(std::min(c * (1 + a * 0x1p-23), 1.0), e);
      low = std::min(low, r.reflectance);
      high = std::max(high, r.reflectance);
    }
  return found >= low * (1 - 4e-6) - 1e-14 && found <= high * (1 + 4e-6) + 1e-14;
}

}  // namespace

TEST_CASE("Fresnel's equations hold at all angles and for indices next to one", "[hard]") {
  std::uint64_t const seed = 611;
  fine_numbers n(seed);
  for (int i = 0; i < 100000; ++i) {
    double const off = n.over_decades(1e-7, 0.9);
    auto const eta = static_cast<float>(i % 2 == 0 ? 1 + off : 1 / (1 + off));
    auto const cos_i = static_cast<float>(i % 3 == 0 ? n.over_decades(1e-6, 1) : n.uniform());
    CAPTURE(seed, eta, cos_i);
    REQUIRE(as_right_as_input(cos_i, eta));
  }
  for (float const cos_i : {1e-6f, 1e-3f, 0.5f, 1.0f}) {
    float cos_t = 0;
    CHECK(fresnel_dielectric(cos_i, 1, cos_t) == 0);  // no interface at all
    CHECK_THAT(cos_t, WithinRel(cos_i, 1e-6f));
  }
}

TEST_CASE("reflection becomes total at the critical angle and not before", "[hard]") {
  for (float const eta : {1 / 1.5f, 1 / 1.33f, 1 / 2.4f, 1 / 1.001f, 1 - 0x1p-20f}) {
    double const critical = std::sqrt((1 - double{eta}) * (1 + double{eta}));
    for (double const off : {1e-6, 1e-4, 1e-2}) {
      CAPTURE(eta, off);
      float cos_t = 0;
      CHECK(fresnel_dielectric(static_cast<float>(critical * (1 - off)), eta, cos_t) == 1);
      CHECK(cos_t == 0);
      CHECK(fresnel_dielectric(static_cast<float>(critical * (1 + off)), eta, cos_t) < 1);
      CHECK(cos_t > 0);
    }
    float cosine = static_cast<float>(critical * (1 - 1e-5)), before = 1;
    int steps = 0;  // through the angle, one float after the other
    for (; double{cosine} < critical * (1 + 1e-5); ++steps) {
      float cos_t = 0;
      float const f = fresnel_dielectric(cosine, eta, cos_t);
      CAPTURE(eta, cosine);
      REQUIRE(f >= 0);
      REQUIRE(f <= before + 1e-6f);
      REQUIRE((f == 1) == (cos_t == 0));
      before = f;
      cosine = std::nextafter(cosine, 2.0f);
    }
    CHECK(steps > 10);
  }
}

TEST_CASE("an interface is the same from both sides", "[hard]") {
  std::uint64_t const seed = 612;
  fine_numbers n(seed);
  for (int i = 0; i < 100000; ++i) {
    auto const eta = static_cast<float>(1 + n.over_decades(1e-6, 1.5));
    auto const cos_i = static_cast<float>(n.over_decades(0.03, 1));
    float cos_t = 0, back = 0;
    float const there = fresnel_dielectric(cos_i, eta, cos_t);
    // 1 / eta is rounded, which an index next to 1 feels in its distance from 1, and cos_t, which a
    // grazing ray feels in what it differs from the critical angle.
    double const slack = 1e-5 + 4 * 0x1p-24 / (double{eta} - 1) + 1e-6 / double{cos_i * cos_i};
    CAPTURE(seed, eta, cos_i, cos_t);
    REQUIRE_THAT(double{fresnel_dielectric(cos_t, 1 / eta, back)},
                 WithinRel(double{there}, 3 * slack) || WithinAbs(double{there}, 1e-12));
    REQUIRE_THAT(double{back}, WithinRel(double{cos_i}, slack));
  }
}

TEST_CASE("light through nested glass keeps Snell's invariant", "[hard]") {
  // Parallel layers, each in the next: the sine over the index is the same in all of them.
  std::uint64_t const seed = 613;
  fine_numbers n(seed);
  std::vector<float> const indices = {1, 1.33f, 1.5f, 2.4f, 1.500001f, 1.5f, 1.0001f, 1};
  for (int i = 0; i < 20000; ++i) {
    double const sine = n.uniform() * 0.999, phi = 6.28 * n.uniform();
    vec3 wo(sine * std::cos(phi), sine * std::sin(phi), std::sqrt((1 - sine) * (1 + sine)));
    vec3 const first = wo;
    double share = 1;
    for (std::size_t k = 1; k < indices.size(); ++k) {
      bsdf_smooth_glass const glass{vec3{1}, indices[k] / indices[k - 1]};
      bsdf_sample const through = glass.sample(wo, {0.5f, 0.5f, 0x1.fffffep-1f});
      CAPTURE(seed, sine, k);
      REQUIRE(through.delta);
      REQUIRE(through.weight == vec3{1});
      REQUIRE(through.wi.z < 0);
      share *= double{through.pdf};
      wo = -through.wi;  // as the next interface sees it
      double const here = std::hypot(double{wo.x}, double{wo.y}) * double{indices[k]};
      REQUIRE_THAT(here, WithinAbs(sine, 3e-6));
    }
    REQUIRE(share > 0);
    REQUIRE(share <= 1);
    REQUIRE(glm::length(wo - first) < 1e-5f);
  }
}

TEST_CASE("64 total reflections keep all of the light and its angle", "[hard]") {
  // Between two planes, tilted against the axes, by the renderer's own hit, frame and next ray.
  std::uint64_t const seed = 614;
  fine_numbers n(seed);
  for (int i = 0; i < 200; ++i) {
    glm::dvec3 const up = n.on_sphere(), u = glm::normalize(glm::cross(up, n.on_sphere())),
                     v = glm::cross(up, u);
    scene s;
    s.materials.resize(1);
    double const wide = 2000;
    for (double const height : {-1.0, 1.0}) {  // corners turn left seen from outside
      glm::dvec3 const centre = height * up, x = wide * u, y = height * wide * v;
      s.triangles.push_back(
          make_triangle(vec3(centre - x - y), vec3(centre + x - y), vec3(centre + y)));
    }
    bvh const tree = build_bvh(s.triangles);
    scene_view view{};
    view.bvh = tree.view();
    view.triangles = s.triangles.data();
    view.materials = s.materials.data();
    double const sine = 0.7 + 0.25 * n.uniform();  // of the angle to the normal; critical: 2 / 3
    vec3 origin(0.1 * n.on_sphere()),
        direction(glm::normalize(std::sqrt(1 - sine * sine) * up + sine * u));
    vec3 throughput{1};
    for (int bounce = 0; bounce < 64; ++bounce) {
      hit const h = closest_hit(view.bvh, {origin, direction, INFINITY});
      CAPTURE(seed, i, sine, bounce);
      REQUIRE(h.primitive == static_cast<std::uint32_t>(bounce % 2 == 0 ? 1 : 0));
      surface const at =
          load_surface<every_effect>(view, view.triangles[h.primitive], h.barycentric, direction);
      REQUIRE_FALSE(at.front);
      bsdf_sample const b =
          bsdf_smooth_glass{vec3{0.9f}, 1 / 1.5f}.sample(at.wo, {0.5f, 0.5f, 0x1.fffffep-1f});
      throughput *= b.weight;
      vec3 const wi = at.to_world(b.wi);
      REQUIRE(at.consistent(b.wi, wi));
      origin = at.start_towards(wi);
      direction = glm::normalize(wi);
    }
    CHECK(throughput == vec3{1});
    CHECK_THAT(std::abs(glm::dot(glm::dvec3(direction), u)), WithinAbs(sine, 64 * 2e-7));
    CHECK_THAT(glm::dot(glm::dvec3(direction), v), WithinAbs(0, 64 * 2e-7));
  }
}

TEST_CASE("a white glass in a glass vanishes in an even sky", "[hard]") {
  std::string const machine = GENERATE(from_range(machines()));
  CAPTURE(machine);
  scene s;
  s.background = vec3{0.5f};
  s.view.position = {0.3f, 0.4f, 4};
  for (float const ior : {1.5f, 1.001f, 2.4f}) {
    material m;
    m.kind = shader_of<effects::smooth_glass>;
    m.base_color = vec3{1};
    m.roughness = 0;
    m.transmission = 1;
    m.ior = ior;
    s.materials.push_back(m);
  }
  for (std::uint32_t k = 0; k < 3; ++k) {
    auto const shell = ball({0, 0, 0}, 1.2 - 0.4 * k, 2, k);
    s.triangles.insert(s.triangles.end(), shell.begin(), shell.end());
  }
  render_result const r = render(s, small(64, 400, machine));
  glm::dvec2 const mean = mean_and_error(r);
  CAPTURE(mean.x, mean.y);
  CHECK(r.discarded_samples == 0);
  CHECK_THAT(mean.x, WithinAbs(0.5, mean.y + 2e-3));
  CHECK(mean.y < 0.03);
}

TEST_CASE("a mirror of roughness 1e-4 is one of roughness 0", "[hard]") {
  std::uint64_t const seed = 615;
  fine_numbers n(seed);
  for (int i = 0; i < 50000; ++i) {
    auto const cos_o = static_cast<float>(n.over_decades(1e-3, 1));
    vec3 const wo = polar(cos_o, 1), u(n.uniform(), n.uniform(), n.uniform());
    bsdf_sample const a = metal(0).sample(wo, u), b = metal(1e-4f).sample(wo, u);
    CAPTURE(seed, cos_o);
    REQUIRE(a.wi == b.wi);
    REQUIRE(a.weight == b.weight);
    if (!(a.pdf > 0)) continue;  // a facet that turns the light into the surface
    vec3 const mirrored{-wo.x, -wo.y, wo.z};
    // A facet of slope k alpha turns the ray by twice that; k = 32 is that of 0.999.
    if (cos_o > 0.1f && u.y < 0.999f) REQUIRE(glm::length(a.wi - mirrored) < 2 * 100 * min_alpha);
    REQUIRE(a.weight.x <= 1 + 1e-5f);
  }
}
