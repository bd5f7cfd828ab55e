// SPDX-License-Identifier: Apache-2.0
#include "io/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#if __has_include(<stb_easy_font.h>)
#include <stb_easy_font.h>
#else
#include <stb/stb_easy_font.h>
#endif

namespace path_tracer {
namespace {

constexpr std::uint32_t pixels_per_dot = 2;

std::string printable(std::string_view line) {
  std::string result(line);
  for (char& c : result)
    if (c < ' ' || c > '~') c = '?';
  return result;
}

/// A corner of a stroke, in the layout of stb_easy_font.
struct vertex {
  float x, y, z;
  unsigned char color[4];
};
constexpr std::size_t most_strokes = 16;  // of a character

}  // namespace

canvas::canvas(std::uint32_t width, std::uint32_t height, rgb background)
    : picture_{width, height, std::vector<rgb>(std::size_t{width} * height, background)} {}

void canvas::fill(area where, rgb color) {
  std::uint32_t const right = std::min(picture_.width, where.x + where.width);
  std::uint32_t const bottom = std::min(picture_.height, where.y + where.height);
  for (std::size_t y = where.y; y < bottom; ++y)
    for (std::size_t x = where.x; x < right; ++x) picture_.pixels[y * picture_.width + x] = color;
}

void canvas::paste(std::uint32_t x, std::uint32_t y, image const& source) {
  for (std::uint32_t row = 0; row < source.height; ++row)
    for (std::uint32_t column = 0; column < source.width; ++column)
      fill({x + column, y + row, 1, 1}, source.pixels[std::size_t{row} * source.width + column]);
}

void canvas::text(std::uint32_t x, std::uint32_t y, std::string_view line, rgb color) {
  std::string characters = printable(line);
  std::vector<vertex> corners(4 * most_strokes * characters.size() + 4);
  auto const bytes = static_cast<int>(corners.size() * sizeof(vertex));
  int const strokes = stb_easy_font_print(0, 0, characters.data(), nullptr, corners.data(), bytes);
  auto const pixels = [](float dots) { return pixels_per_dot * static_cast<std::uint32_t>(dots); };
  for (std::size_t k = 0; k < static_cast<std::size_t>(strokes); ++k) {
    vertex const &first = corners[4 * k], &last = corners[4 * k + 2];
    fill({x + pixels(first.x), y + pixels(first.y), pixels(last.x - first.x),
          pixels(last.y - first.y)},
         color);
  }
}

std::uint32_t text_width(std::string_view line) {
  std::string characters = printable(line);
  return pixels_per_dot * static_cast<std::uint32_t>(stb_easy_font_width(characters.data()));
}

rgb from_oklab(float lightness, float chroma, float hue) {
  float const angle = hue * float(pi) / 180;
  float const a = chroma * std::cos(angle), b = chroma * std::sin(angle);
  float const l = lightness + 0.3963377774f * a + 0.2158037573f * b;
  float const m = lightness - 0.1055613458f * a - 0.0638541728f * b;
  float const s = lightness - 0.0894841775f * a - 1.2914855480f * b;
  rgb const cubes{l * l * l, m * m * m, s * s * s};
  rgb const color{4.0767416621f * cubes.x - 3.3077115913f * cubes.y + 0.2309699292f * cubes.z,
                  -1.2684380046f * cubes.x + 2.6097574011f * cubes.y - 0.3413193965f * cubes.z,
                  -0.0041960863f * cubes.x - 0.7034186147f * cubes.y + 1.7076147010f * cubes.z};
  return glm::clamp(color, rgb(0), rgb(1));
}

}  // namespace path_tracer
