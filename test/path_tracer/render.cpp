// SPDX-License-Identifier: Apache-2.0
#include "app/render.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "machines.hpp"

using namespace path_tracer;

TEST_CASE("every schedule, backend and number of threads gives the same bits", "[render]") {
  scene const s = room();
  render_settings const settings = small(4, 9);
  double brightest = 0;
  for (vec3 const& p : render(s, settings).pixels) brightest = std::max(brightest, double{p.x});
  REQUIRE(brightest > 1);
  check_same_bits(s, settings, {1, 3});
}

TEST_CASE("the room shows every shader", "[render]") {
  render_settings settings = small(2, 2);
  settings.statistics = true;
  scene const foggy = room();
  scene clear = foggy;
  clear.medium_scattering = clear.medium_absorption = vec3{0};
  for (std::uint32_t k = 0; k < shader_count; ++k) {
    // Without this material, the picture is another one. Through fog, nothing is seen of the sky.
    scene const& s = k == number_of<effects::medium> ? foggy : clear;
    scene changed = s;
    if (k == number_of<effects::medium>)
      changed.medium_scattering = vec3{0};
    else if (k == static_cast<std::uint32_t>(miss))
      changed.background = vec3{5};
    else
      changed.materials[k].kind =
          k == number_of<effects::matte> ? shader_of<effects::metal> : shader_of<effects::matte>;
    if (k == number_of<effects::emitters>) changed.materials[k].emission = vec3{0};
    CAPTURE(k);
    CHECK_FALSE(same_bits(render(s, settings), render(changed, settings)));
  }
}

TEST_CASE("the camera looks down its axis, with up on top and right on the right", "[render]") {
  scene s;
  s.materials.resize(1);
  s.materials[0].kind = shader_of<effects::emitters>;
  s.materials[0].emission = vec3{1};
  s.materials[0].two_sided = true;
  auto const at = [&](vec3 corner, float ortho_height, unsigned x, unsigned y) {
    s.triangles.clear();
    add_quad(s, corner, {0.1f, 0, 0}, {0, 0.1f, 0}, 0);
    s.view.tan_half_yfov = 0.5f;
    s.view.ortho_height = ortho_height;
    render_settings settings = small(1, 1);
    settings.width = 20;
    settings.height = 10;
    return render(s, settings).pixels[y * 20 + x].x;
  };
  // At distance 1 a pixel measures 0.1 x 0.1; (0.6, 0.3) is in column 16, row 1.
  CHECK(at({0.6f, 0.3f, -1}, 0, 16, 1) == 1);
  CHECK(at({0.6f, 0.3f, -1}, 0, 16, 8) == 0);
  CHECK(at({0.6f, 0.3f, -1}, 0, 3, 1) == 0);
  CHECK(at({0.6f, 0.3f, 1}, 0, 16, 1) == 0);
  CHECK(at({0.6f, 0.3f, -7}, 0.5f, 16, 1) == 1);
}

TEST_CASE("statistics count requests and find efficiencies", "[render]") {
  scene const s = room();
  render_settings settings = small(4, 6, GENERATE(from_range(machines())));
  settings.statistics = true;
  settings.schedule = GENERATE("implicit", "sort+explicit", "local");
  CAPTURE(settings.backend, settings.schedule);
  render_result const r = render(s, settings);
  settings.statistics = false;
  CHECK(same_bits(r, render(s, settings)));
  REQUIRE_FALSE(r.bounces.empty());
  CHECK(r.bounces.size() <= 6);
  CHECK(r.bounces[0].requests == 48 * 27 * 4);
  std::uint64_t before = r.bounces[0].requests;
  for (bounce const& b : r.bounces) {
    CHECK(b.requests <= before);
    before = b.requests;
    CHECK(b.efficiency > 0);
    CHECK(b.efficiency <= 1);
    CHECK_THAT(b.shade_ms + b.group_ms, WithinAbs(b.total_ms, 1e-6 * (1 + b.total_ms)));
    REQUIRE(b.pixel_efficiency.size() == r.pixels.size());
    int shown = 0;
    for (float const e : b.pixel_efficiency) {
      REQUIRE((std::isnan(e) || (e > 0 && e <= 1)));
      shown += std::isnan(e) ? 0 : 1;
    }
    CHECK(shown > 0);
  }
  if (settings.schedule != "implicit") CHECK(r.bounces[1].efficiency > 0.8);
}

TEST_CASE("the picture depends on the seed, and a progress report ends at 1", "[render]") {
  scene const s = room();
  render_settings settings = small(2, 3);
  double last = 0;
  render_result const a = render(s, settings, [&](double done) { last = done; });
  CHECK(last == 1);
  settings.seed = 2;
  CHECK_FALSE(same_bits(a, render(s, settings)));
}

TEST_CASE("samples that are not finite are dropped and counted", "[render]") {
  scene s;
  s.background = {1, std::numeric_limits<float>::infinity(), 1};
  render_result const r = render(s, small(3, 2, GENERATE(from_range(machines()))));
  CHECK(r.discarded_samples == 48 * 27 * 3);
  CHECK(std::all_of(r.pixels.begin(), r.pixels.end(), [](vec3 p) { return p == vec3{0}; }));
}

TEST_CASE("names and sizes that do not exist are refused", "[render]") {
  scene const s = box_of(material{});
  render_settings settings = small(1, 1);
  SECTION("backend") { settings.backend = "vax"; }
  SECTION("schedule") { settings.schedule = "chaos"; }
  SECTION("no pixel") { settings.width = 0; }
  SECTION("no sample") { settings.samples = 0; }
  CHECK_THROWS_AS(render(s, settings), std::invalid_argument);
}
