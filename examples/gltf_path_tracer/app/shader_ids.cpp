// SPDX-License-Identifier: Apache-2.0
#include "app/shader_ids.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "effects/scene_effects.hpp"
#include "io/canvas.hpp"

namespace path_tracer {
namespace {

constexpr rgb paper{1}, ink{0};
constexpr std::uint32_t gap = 12, swatch = text_height, line = text_height + 8;
constexpr auto hues = static_cast<std::size_t>(miss);  // one for each shader but `miss`

struct entry {
  std::size_t id;
  std::string text;
  std::uint32_t width() const { return swatch + gap / 2 + text_width(text) + 2 * gap; }
};

std::vector<entry> entries_of(std::vector<std::uint8_t> const& ids) {
  std::array<std::size_t, shader_count> pixels{};
  for (std::uint8_t const id : ids) ++pixels.at(id);
  auto const names = shader_names();
  std::vector<entry> result;
  for (std::size_t k = 0; k < pixels.size(); ++k) {
    if (pixels[k] == 0) continue;
    double const percent = 100 * static_cast<double>(pixels[k]) / static_cast<double>(ids.size());
    char share[32];
    std::snprintf(share, sizeof(share), percent < 1 ? "%.1f %%" : "%.0f %%", percent);
    result.push_back({k, std::string(names[k]) + "  " + share});
  }
  return result;
}

}  // namespace

rgb shader_color(std::size_t id) {
  if (id >= hues) return from_oklab(0.35f, 0, 0);
  // Neighbours in the table lie far apart on the circle of hues, and neighbours there in lightness.
  std::size_t const place = 5 * id % hues;
  float const hue = 360 * static_cast<float>(place) / static_cast<float>(hues);
  bool const odd_one = place + 1 == hues && hues % 2 == 1;
  return odd_one          ? from_oklab(0.70f, 0.20f, hue)
         : place % 2 == 0 ? from_oklab(0.87f, 0.11f, hue)
                          : from_oklab(0.55f, 0.16f, hue);
}

image shader_id_picture(std::uint32_t width, std::uint32_t height,
                        std::vector<std::uint8_t> const& ids) {
  if (ids.size() != std::size_t{width} * height)
    throw std::invalid_argument("the shader ids of first hits are not as many as pixels");
  image picture{width, height, {}};
  for (std::uint8_t const id : ids) picture.pixels.push_back(shader_color(id));

  std::vector<entry> const entries = entries_of(ids);
  std::uint32_t column = 0;
  for (entry const& e : entries) column = std::max(column, e.width());
  std::uint32_t const whole = std::max(width, column + gap);
  std::uint32_t const columns = (whole - gap) / column;
  auto const lines = (static_cast<std::uint32_t>(entries.size()) + columns - 1) / columns;
  canvas result(whole, height + 2 * gap + lines * line, paper);
  result.paste(0, 0, picture);
  for (std::uint32_t k = 0; k < entries.size(); ++k) {
    std::uint32_t const x = gap + k % columns * column, y = height + gap + k / columns * line;
    result.fill({x, y, swatch, swatch}, shader_color(entries[k].id));
    result.text(x + swatch + gap / 2, y + 2, entries[k].text, ink);
  }
  return result.picture();
}

}  // namespace path_tracer
