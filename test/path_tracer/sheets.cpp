// SPDX-License-Identifier: Apache-2.0
// Heat maps and shader ids as labelled pictures.
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "app/heatmap.hpp"
#include "app/shader_ids.hpp"
#include "catch.hpp"
#include "io/canvas.hpp"
#include "render_support.hpp"

using namespace path_tracer;

namespace {

constexpr rgb white{1}, black{0};
float const not_a_number = std::numeric_limits<float>::quiet_NaN();

/// Oklab of linear RGB (Ottosson 2020), from the published matrices.
glm::dvec3 oklab(rgb c) {
  double const l = std::cbrt(0.4122214708 * c.x + 0.5363325363 * c.y + 0.0514459929 * c.z);
  double const m = std::cbrt(0.2119034982 * c.x + 0.6806995451 * c.y + 0.1073969566 * c.z);
  double const s = std::cbrt(0.0883024619 * c.x + 0.2817188376 * c.y + 0.6299787005 * c.z);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

std::ptrdiff_t pixels_of(rgb color, image const& picture) {
  return std::count(picture.pixels.begin(), picture.pixels.end(), color);
}

rgb pixel(image const& picture, std::uint32_t x, std::uint32_t y) {
  return picture.pixels.at(std::size_t{y} * picture.width + x);
}

/// A run of so many bounces, each with this efficiency at all pixels.
run uniform(std::string const& schedule, std::size_t bounces, std::size_t pixels,
            float efficiency) {
  run r{schedule, {}};
  r.result.bounces.resize(bounces);
  for (bounce& b : r.result.bounces) b.pixel_efficiency.assign(pixels, efficiency);
  return r;
}

image text_picture(std::string const& text) {
  canvas c(200, 40, white);
  c.text(10, 10, text, black);
  return c.picture();
}

}  // namespace

TEST_CASE("text stays in its place, and differs by what it says", "[sheets]") {
  for (char c = '!'; c <= '~'; ++c) {
    std::string const text{'a', c};
    CAPTURE(text);
    image const picture = text_picture(text);
    std::ptrdiff_t inside = 0;
    for (std::uint32_t y = 10; y < 10 + text_height; ++y)
      for (std::uint32_t x = 10; x < 10 + text_width(text); ++x)
        inside += pixel(picture, x, y) == black;
    CHECK(inside == pixels_of(black, picture));
    CHECK(inside > pixels_of(black, text_picture("a")));
  }
  CHECK(text_picture("bucket").pixels != text_picture("window").pixels);
  CHECK(text_picture("\xff\n").pixels == text_picture("??").pixels);
  CHECK(pixels_of(black, text_picture("")) == 0);
}

TEST_CASE("what lies outside of a canvas is left out", "[sheets]") {
  canvas c(8, 4, white);
  c.fill({6, 2, 100, 100}, black);
  CHECK(pixels_of(black, c.picture()) == 4);
  c.paste(0, 3, {2, 2, std::vector<rgb>(4, black)});
  CHECK(pixels_of(black, c.picture()) == 6);
  c.text(4, 0, "a long text", black);
  c.text(100, 100, "text", black);
  CHECK(c.picture().pixels.size() == 32);
}

TEST_CASE("the colours of a heat map rise evenly in lightness", "[sheets]") {
  for (int i = 0; i <= 100; ++i) {
    rgb const c = heat_color(static_cast<float>(i) / 100);
    CAPTURE(i, c.x, c.y, c.z);
    CHECK_THAT(oklab(c).x, WithinAbs(0.25 + 0.70 * i / 100, 0.002));
  }
}

TEST_CASE("a sheet has a heat map for each schedule and bounce", "[sheets]") {
  // No number of lanes in 32 has this colour: the scale has not.
  float const efficiency = 0.3f;
  rgb const color = heat_color(efficiency);
  render_settings settings;
  settings.width = 20;
  settings.height = 10;
  heatmap_sheet sheet(settings);
  image const empty = sheet.draw();
  CHECK(pixels_of(color, empty) == 0);
  run partly = uniform("local", 3, 200, efficiency);
  partly.result.bounces[1].pixel_efficiency.assign(200, not_a_number);
  partly.result.bounces[2].pixel_efficiency.clear();  // of later batches alone
  sheet.add(partly);
  image const one = sheet.draw();
  CHECK(pixels_of(color, one) == 200);
  CHECK(pixels_of(rgb{0.5f}, one) == pixels_of(rgb{0.5f}, empty) + 200);
  sheet.add(uniform("window", 4, 200, efficiency));
  image const two = sheet.draw();
  CHECK(pixels_of(color, two) == 5 * 200);
  CHECK(two.height > one.height);
  for (int lanes = 1; lanes <= 32; ++lanes)
    CHECK(pixels_of(heat_color(static_cast<float>(lanes) / 32), two) > 0);
  CHECK_THROWS_AS(sheet.add(uniform("sort", 1, 199, efficiency)), std::runtime_error);
}

TEST_CASE("a sheet names its rows", "[sheets]") {
  auto const named = [](std::string const& schedule) {
    heatmap_sheet sheet(small(1, 1));
    sheet.add(uniform(schedule, 8, 48 * 27, 1));
    return sheet.draw();
  };
  image const a = named("aaaa"), o = named("oooo");  // letters of one width
  REQUIRE(a.pixels.size() == o.pixels.size());
  CHECK(a.pixels != o.pixels);
  CHECK(named("oooo").pixels == o.pixels);
  CHECK(named("a much longer name").width > a.width);
}

TEST_CASE("a sheet of large pictures and many bounces stays small", "[sheets]") {
  render_settings settings;
  settings.width = 3 * heatmap_sheet::largest_side - 1;
  settings.height = 4;
  heatmap_sheet sheet(settings);
  sheet.add(uniform("local", 20, std::size_t{settings.width} * settings.height, 0.3f));
  image const picture = sheet.draw();
  // Every third pixel across and down, of the first bounces.
  CHECK(pixels_of(heat_color(0.3f), picture) ==
        2 * heatmap_sheet::largest_side * static_cast<std::ptrdiff_t>(heatmap_sheet::most_columns));
}

TEST_CASE("the colours of shaders are well apart", "[sheets]") {
  for (std::size_t i = 0; i < shader_count; ++i)
    for (std::size_t k = 0; k < i; ++k) {
      CAPTURE(i, k);
      CHECK(glm::distance(oklab(shader_color(i)), oklab(shader_color(k))) > 0.08);
    }
}

TEST_CASE("a picture of shader ids has its colours, and names those that occur", "[sheets]") {
  auto const last = static_cast<std::uint8_t>(miss);
  image const picture = shader_id_picture(3, 2, {0, last, 3, 3, 3, 3});
  CHECK(pixel(picture, 0, 0) == shader_color(0));
  CHECK(pixel(picture, 1, 0) == shader_color(last));
  CHECK(pixel(picture, 2, 1) == shader_color(3));
  CHECK(pixels_of(shader_color(3), picture) - 4 == pixels_of(shader_color(0), picture) - 1);
  CHECK(pixels_of(shader_color(3), picture) > 4);
  CHECK(pixels_of(shader_color(1), picture) == 0);
  CHECK(pixels_of(black, picture) > 0);
  CHECK_THROWS_AS(shader_id_picture(3, 2, {0, 0, 0, 0, 0}), std::invalid_argument);
}

TEST_CASE("the first shaders are those of every pixel, over several batches", "[sheets]") {
  scene s;
  s.materials.resize(2);
  s.materials[1].kind = shader_of<effects::metal>;
  add_quad(s, {-9, -9, -1}, {18, 0, 0}, {0, 9, 0}, 1);  // the lower half
  s.view.tan_half_yfov = 0.5f;
  render_settings settings = small(1, 1);
  settings.width = 1100;
  settings.height = 1000;
  settings.statistics = true;
  settings.schedule = GENERATE("implicit", "sort+explicit");
  REQUIRE(batch_size_of(settings) < 1100 * 1000);
  std::vector<std::uint8_t> const ids = render(s, settings).first_shaders;
  REQUIRE(ids.size() == 1100 * 1000);
  std::uint8_t const above = static_cast<std::uint8_t>(miss), below = number_of<effects::metal>;
  CHECK(std::count(ids.begin(), ids.begin() + 1100 * 499, above) == 1100 * 499);
  CHECK(std::count(ids.begin() + 1100 * 501, ids.end(), below) == 1100 * 499);
  settings.statistics = false;
  CHECK(render(s, settings).first_shaders.empty());
}
