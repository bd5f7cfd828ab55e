// SPDX-License-Identifier: Apache-2.0
// Media that scatter colours differently: no light is lost, however many times it is scattered.
#include <algorithm>
#include <cmath>

#include "machines.hpp"
#include "shading/shaders.hpp"

using namespace path_tracer;

namespace {

/// One path in a medium, as the effect sees it.
struct medium_batch {
  vec3 *throughput, *origin, *direction;
  std::uint32_t bounce, number;

  random_stream random(std::uint32_t) const { return {17, number, 0}; }
};

/// A box whose walls emit 1 and reflect nothing.
scene furnace(vec3 scattering) {
  material wall;
  wall.kind = shader_of<effects::emitters>;
  wall.emission = vec3{1};
  wall.base_color = vec3{0};
  scene s = box_of(wall);
  s.medium_scattering = scattering;
  return s;
}

}  // namespace

TEST_CASE("a path keeps the sum of its throughput in a medium that absorbs nothing", "[medium]") {
  for (vec3 const color : {vec3{1}, vec3{1, 0.5f, 0.1f}, vec3{0, 1, 30}, vec3{1e-3f, 1, 1e3f}})
    for (std::uint32_t number = 0; number < 50; ++number) {
      medium_view const medium{color, color, 0};
      vec3 throughput{1}, origin{0}, direction{0, 0, 1};
      medium_batch batch{&throughput, &origin, &direction, 0, number};
      for (int scattered = 0; batch.bounce < 500; ++batch.bounce) {
        scattered += effects::medium::scatters(batch, medium, 0, 0.5f) ? 1 : 0;
        CAPTURE(color.x, color.z, number, batch.bounce, scattered);
        REQUIRE_THAT(throughput.x + throughput.y + throughput.z, WithinRel(3.0f, 2e-3f));
        REQUIRE(std::min({throughput.x, throughput.y, throughput.z}) >= 0);
      }
    }
}

TEST_CASE("roulette ends no path that has lost nothing", "[medium]") {
  CHECK(survival_of(vec3{1}) == 1);
  CHECK(survival_of(vec3{0, 3, 0}) == 1);
  CHECK(survival_of(vec3{0.25f, 0.5f, 0}) == 0.5f);
  // Of a grey medium every sample is then exact, but for rounding.
  std::string const machine = GENERATE(from_range(machines()));
  render_settings settings = small(1, 5000, machine);
  settings.accuracy.light = estimator::bsdf;
  for (rgb const& p : render(furnace(vec3{4}), settings).pixels)
    for (int c = 0; c < 3; ++c) REQUIRE_THAT(p[c], WithinAbs(1, 1e-3));
}

TEST_CASE("a furnace of coloured fog has the radiance of its walls", "[medium]") {
  std::string const machine = GENERATE(from_range(machines()));
  float const depth = GENERATE(0.1f, 1.0f, 10.0f, 30.0f);
  float const anisotropy = GENERATE(0.0f, 0.8f);
  CAPTURE(machine, depth, anisotropy);
  scene s = furnace(0.5f * depth * vec3{1, 0.3f, 0.05f});  // two units wide
  s.medium_anisotropy = anisotropy;
  for (estimator const how : {estimator::mis, estimator::bsdf}) {
    render_settings settings = small(depth > 5 ? 64 : 128, 20000, machine);
    settings.accuracy.light = how;
    render_result const r = render(s, settings);
    CHECK(r.discarded_samples == 0);
    for (int c = 0; c < 3; ++c) {
      glm::dvec2 const mean = mean_and_error(r, c);
      CAPTURE(static_cast<int>(how), c, mean.x, mean.y);
      CHECK_THAT(mean.x, WithinAbs(1, mean.y));
      CHECK(mean.y < 0.04);
    }
  }
}
