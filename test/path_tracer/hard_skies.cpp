// SPDX-License-Identifier: Apache-2.0
// Environments with one bright texel, with none, and with texels that are not numbers.
#include <cmath>
#include <limits>

#include "fixture.hpp"
#include "hard_support.hpp"
#include "machines.hpp"
#include "scene/lights.hpp"

using namespace path_tracer;

namespace {

constexpr std::uint32_t width = 64, height = 32, bright_x = 40, bright_y = 9;

/// A matte patch under a sky that is black except for one texel.
scene under_sky(float bright, float elsewhere) {
  scene s;
  s.materials.resize(1);
  s.materials[0].kind = shader_of<effects::matte>;
  s.materials[0].base_color = vec3{0.6f};
  add_quad(s, {-9, 0, -9}, {0, 0, 18}, {18, 0, 0}, 0);
  s.view.position = {0, 1, 0};
  s.view.right = {1, 0, 0};
  s.view.up = {0, 0, -1};
  s.view.forward = {0, -1, 0};
  s.view.tan_half_yfov = 1e-3f;
  s.sky = {width, height, std::vector<vec3>(width * height, vec3{elsewhere})};
  s.sky.texels[bright_y * width + bright_x] = vec3{bright};
  return s;
}

/// The irradiance from above, of the bilinear picture, by quadrature in double.
double irradiance(scene const& s) {
  double const right = std::acos(-1.0) / 2;
  int const fine = 64;  // points per texel and axis
  double sum = 0;
  for (std::uint32_t y = 0; y < height / 2 * fine; ++y)
    for (std::uint32_t x = 0; x < width * fine; ++x) {
      double const u = (x + 0.5) / fine - 0.5, v = (y + 0.5) / fine - 0.5;  // between centres
      double const theta = 2 * right * (y + 0.5) / (height * fine);
      double const a = std::max(0.0, 1 - std::abs(u - bright_x)),
                   b = std::max(0.0, 1 - std::abs(v - bright_y));
      double const dim = double{s.sky.texels[0].x};
      double const bright = double{s.sky.texels[bright_y * width + bright_x].x};
      sum += (dim + (bright - dim) * a * b) * std::sin(theta) * std::cos(theta);
    }
  return sum * (2 * right / (height * fine)) * (4 * right / (width * fine));
}

}  // namespace

TEST_CASE("one bright texel of a sky lights by its share of the sky", "[hard]") {
  std::string const machine = GENERATE(from_range(machines()));
  CAPTURE(machine);
  for (glm::vec2 const sky : {glm::vec2(1e6f, 0), glm::vec2(1e6f, 1), glm::vec2(1e12f, 1e-3f)}) {
    scene const s = under_sky(sky.x, sky.y);
    render_result const r = render(s, small(32, 2, machine));
    double const expected = 0.6 / std::acos(-1.0) * irradiance(s);
    glm::dvec2 const mean = mean_and_error(r);
    CAPTURE(sky.x, sky.y, mean.x, mean.y, expected);
    CHECK(r.discarded_samples == 0);
    CHECK_THAT(mean.x, WithinAbs(expected, mean.y));
    CHECK(mean.y < 0.03 * expected);
  }
}

TEST_CASE("samples of a sky are finite at its poles and seams", "[hard]") {
  scene const s = under_sky(1e6f, 1);
  light_list const list(s);
  light_view const lights = list.view(s);
  constexpr float ends[] = {0, 0x1p-149f, 0x1p-24f, 0.5f, 1 - 0x1p-24f};
  for (float const a : ends)
    for (float const b : ends)
      for (float const c : ends)
        for (float const d : ends) {
          light_sample const l = sample_sky(lights, {a, b}, {c, d});
          CAPTURE(a, b, c, d);
          REQUIRE(std::isfinite(l.pdf));
          REQUIRE(l.pdf >= 0);
          REQUIRE_THAT(double{glm::length(l.wi)}, WithinAbs(1, 1e-6));
          REQUIRE(std::isfinite(l.radiance.x));
        }
  for (vec3 const d : {vec3{0, 1, 0}, vec3{0, -1, 0}, vec3{0, 0, 1}, vec3{-0.0f, 0, 1},
                       vec3{0, 0, -1}, vec3{0x1p-149f, 1, 0}}) {
    vec2 const uv = lights.sky.coordinates(d);
    CAPTURE(d.x, d.y, d.z);
    REQUIRE((uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1));
    REQUIRE(lights.sky.texel_at(uv) < width * height);
    REQUIRE(std::isfinite(lights.sky.radiance(uv).x));
    REQUIRE(std::isfinite(sky_pdf(lights, uv)));
  }
}

TEST_CASE("a black sky gives a black picture", "[hard]") {
  std::string const machine = GENERATE(from_range(machines()));
  CAPTURE(machine);
  render_result const r = render(under_sky(0, 0), small(4, 4, machine));
  CHECK(r.discarded_samples == 0);
  for (vec3 const p : r.pixels) REQUIRE(p == vec3{0});
}

TEST_CASE("a sky with a texel that no light can come from is refused", "[hard]") {
  auto const message = [](float value, float intensity = 1) {
    scene s = under_sky(1, 1);
    s.sky.texels[3 * width + 5].y = value;
    s.environment_intensity = intensity;
    try {
      (void)render(s, small(1, 1));
    } catch (std::invalid_argument const& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  std::string const where = "the environment is not usable: texel 5, 3 holds a value that is ";
  CHECK(message(std::numeric_limits<float>::quiet_NaN()) == where + "not a number");
  CHECK(message(std::numeric_limits<float>::infinity()) == where + "negative or beyond 1e30");
  CHECK(message(-1) == where + "negative or beyond 1e30");
  CHECK(message(1e20f, 1e20f) == where + "negative or beyond 1e30");
  CHECK(message(1e20f) == "no error");
  scene s = under_sky(1, 1);
  s.sky.texels.pop_back();
  CHECK_THROWS_WITH(render(s, small(1, 1)),
                    "the environment has not as many texels as its size says");
}

TEST_CASE("a file of a sky that is too bright is refused by its texel", "[hard]") {
  path_tracer_test::temporary_folder const folder;
  std::string const path = folder / "sky.hdr";
  // Flat, not run-length encoded: four bytes each, the last the exponent of a common factor.
  std::string bytes = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 3\n";
  for (int k = 0; k < 6; ++k) {
    bytes += std::string("\x80\x80\x80", 3);
    bytes += static_cast<char>(k == 4 ? 255 : 129);
  }
  path_tracer_test::write_bytes(path, bytes);
  CHECK_THROWS_WITH(
      load_environment(path, 1),
      "environment \"" + path + "\": texel 1, 1 holds a value that is negative or beyond 1e30");
}
