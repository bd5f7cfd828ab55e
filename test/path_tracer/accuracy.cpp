// SPDX-License-Identifier: Apache-2.0
// Settings that give up accuracy for time: what each may change, and what not.
#include <cmath>
#include <random>
#include <vector>

#include "machines.hpp"
#include "render_support.hpp"
#include "scene/lights.hpp"
#include "shading/noise.hpp"
#include "shading/sums.hpp"

using namespace path_tracer;
using Catch::Matchers::WithinAbs;

namespace {

/// A matte floor under a lamp, under a sky that is brighter in one place, in thin fog.
scene lit_floor(bool fog) {
  scene s;
  s.materials.resize(2);
  s.materials[0].specular = 0;
  s.materials[1].kind = shader_of<effects::emitters>;
  s.materials[1].emission = vec3{3};
  add_quad(s, {-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, 0);
  add_quad(s, {-1, -1, 1.5f}, {0, 2, 0}, {2, 0, 0}, 1);
  s.sky = {2, 2, {vec3{0.1f}, vec3{0.2f}, vec3{2}, vec3{0.5f}}};
  s.view.position = {0, 0, 1};
  s.view.tan_half_yfov = 0.5f;
  if (fog) s.medium_scattering = vec3{0.2f};
  return s;
}

glm::dvec2 brightness(scene const& s, std::string const& machine, accuracy_settings const& a) {
  render_settings settings = small(256, 6, machine);
  settings.accuracy = a;
  auto const result = render(s, settings);
  CHECK(result.discarded_samples == 0);
  return mean_and_error(result);
}

}  // namespace

TEST_CASE("every estimator finds the same light", "[accuracy]") {
  std::string const machine = GENERATE(from_range(machines()));
  bool const fog = GENERATE(false, true);
  CAPTURE(machine, fog);
  scene const s = lit_floor(fog);
  glm::dvec2 const mis = brightness(s, machine, {});
  REQUIRE(mis.x > 0.1);
  for (estimator const how : {estimator::bsdf, estimator::light}) {
    // In fog, points right before a lamp are lit without bound: light samples alone do not
    // converge.
    if (fog && how == estimator::light) continue;
    CAPTURE(static_cast<int>(how));
    accuracy_settings a;
    a.light = how;
    glm::dvec2 const mean = brightness(s, machine, a);
    CHECK_THAT(mean.x, WithinAbs(mis.x, mis.y + mean.y));
    CHECK(mean.y < 0.1 * mean.x);
    CHECK(mean.x != mis.x);
  }
}

TEST_CASE("lights that an estimator does not sample are not in its list", "[accuracy]") {
  scene s = lit_floor(false);
  s.lights.resize(1);
  s.lights[0].intensity = vec3{1};
  CHECK(light_list(s).view(s).count == 4);  // two triangles, a point, the sky
  CHECK(light_list(s, estimator::light).view(s).count == 4);
  light_list const points(s, estimator::bsdf);
  CHECK(points.view(s).count == 1);
  CHECK(points.view(s).triangle_count == 0);
}

TEST_CASE("the two weights of one direction add up to one", "[accuracy]") {
  for (estimator const how : {estimator::mis, estimator::bsdf, estimator::light})
    for (float const light : {1e-6f, 0.3f, 1.0f, 1e6f})
      for (float const bsdf : {1e-6f, 0.3f, 1.0f, 1e6f}) {
        CAPTURE(static_cast<int>(how), light, bsdf);
        // An estimator that samples BSDFs alone lists no light: there is no sample to weigh.
        double const by_light = how == estimator::bsdf ? 0 : weight_of_light(how, light, bsdf);
        CHECK_THAT(by_light + weight_of_bsdf(how, bsdf, light), WithinAbs(1, 1e-6));
      }
  CHECK(weight_of_bsdf(estimator::light, 1, 0) == 1);  // no light sample could have found it
}

TEST_CASE("roulette changes no mean", "[accuracy]") {
  std::string const machine = GENERATE(from_range(machines()));
  CAPTURE(machine);
  scene const s = lit_floor(false);
  accuracy_settings early, never;
  early.roulette_from = 1;
  never.roulette_from = 64;
  glm::dvec2 const a = brightness(s, machine, early), b = brightness(s, machine, never);
  CHECK_THAT(a.x, WithinAbs(b.x, a.y + b.y));
  CHECK(a.x != b.x);
}

TEST_CASE("sums of samples lose what they say", "[accuracy]") {
  auto const seed = std::random_device{}();
  CAPTURE(seed);
  std::mt19937 engine(seed);
  std::uniform_real_distribution<float> even(0, 2);
  pixel_sum<summation::in_double> in_double;
  pixel_sum<summation::compensated> compensated;
  long double exact = 0;
  int const count = 10'000'000;
  for (int k = 0; k < count; ++k) {
    float const v = even(engine);
    exact += static_cast<long double>(v);
    in_double.add(vec3{v});
    compensated.add(vec3{v});
  }
  auto const error = [&](auto const& sum) {
    return std::fabs(static_cast<double>(static_cast<long double>(sum.total.y) / exact - 1));
  };
  CHECK(error(in_double) < 1e-12);
  CHECK(error(compensated) < 1.2e-7);  // the rounding of the sum itself
}

TEST_CASE("a sum in float stops where a sample is half a step", "[accuracy]") {
  pixel_sum<summation::in_double> in_double;
  pixel_sum<summation::compensated> compensated;
  pixel_sum<summation::in_float> in_float;
  int const stop = 1 << 24, count = stop + 1000;
  for (int k = 0; k < count; ++k) {
    in_double.add(vec3{1});
    compensated.add(vec3{1});
    in_float.add(vec3{1});
  }
  CHECK(in_double.total.y == count);
  CHECK(compensated.total.y == static_cast<float>(count));
  CHECK(in_float.total.y == static_cast<float>(stop));
}

TEST_CASE("a procedural texture has no more octaves than it may", "[accuracy]") {
  for (int k = 0; k < 100; ++k) {
    vec3 const p{0.37f * static_cast<float>(k), 0.11f * static_cast<float>(k), 0.7f};
    CHECK(marble_pattern(p, 16) == marble_pattern(p, 5));
    CHECK(wood_pattern(p, 16) == wood_pattern(p, 3));
    CHECK(std::fabs(turbulence(p, 3) - turbulence(p, 2)) <= 0.25f);
  }
  vec3 const p{0.3f, 0.4f, 0.5f};
  CHECK(marble_pattern(p, 1) != marble_pattern(p, 2));
  CHECK(wood_pattern(p, 1) != wood_pattern(p, 2));
}
