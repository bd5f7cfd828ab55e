// SPDX-License-Identifier: Apache-2.0
#include "app/heatmap.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "io/canvas.hpp"

namespace path_tracer {
namespace {

/// Chroma and hue (degrees) at equal steps of the value; chosen to stay inside Rec. 709.
struct control_point {
  float chroma, hue;
};
constexpr control_point points[] = {
    {0.10f, 300}, {0.16f, 328}, {0.19f, 375}, {0.15f, 415}, {0.10f, 465}};
constexpr float darkest = 0.25f, lightest = 0.95f;

constexpr rgb paper{1}, ink{0}, no_request{0.5f};  // a grey, which the scale has not
constexpr std::uint32_t gap = 12, line = text_height + 4;
constexpr std::uint32_t lanes = 32, scale_width = 10 * lanes;

std::uint32_t divided(std::uint32_t a, std::uint32_t b) { return (a + b - 1) / b; }

/// A line of text below the colour scale, in the middle of a number of lanes.
void mark(canvas& sheet, std::uint32_t x, std::uint32_t y, std::uint32_t count) {
  std::string const text = std::to_string(count);
  std::uint32_t const step = scale_width / lanes;
  std::uint32_t const middle = x + (count - 1) * step + step / 2;
  sheet.text(middle - text_width(text) / 2, y, text, ink);
}

/// The colours of 1 to 32 lanes at work, with some of the numbers below, and that of no request.
void draw_scale(canvas& sheet, std::uint32_t x, std::uint32_t y) {
  std::uint32_t const step = scale_width / lanes;
  for (std::uint32_t k = 0; k < lanes; ++k)
    sheet.fill({x + k * step, y, step, line},
               heat_color(static_cast<float>(k + 1) / static_cast<float>(lanes)));
  for (std::uint32_t const count : {1u, 8u, 16u, 24u, 32u}) mark(sheet, x, y + line + 4, count);
  std::uint32_t const right = x + scale_width + 2 * gap;
  sheet.fill({right, y, line, line}, no_request);
  sheet.text(right + line + gap, y + 4, "no request", ink);
}
constexpr std::uint32_t scale_height = 2 * line + gap;

}  // namespace

rgb heat_color(float efficiency) {
  constexpr int intervals = static_cast<int>(std::size(points)) - 1;
  float const t = efficiency > 0 ? std::min(efficiency, 1.0f) : 0.0f;
  int const i = std::min(static_cast<int>(t * intervals), intervals - 1);
  float const u = t * intervals - static_cast<float>(i);
  float const chroma = points[i].chroma * (1 - u) + points[i + 1].chroma * u;
  float const hue = points[i].hue * (1 - u) + points[i + 1].hue * u;
  return from_oklab(darkest + (lightest - darkest) * t, chroma, hue);
}

heatmap_sheet::heatmap_sheet(render_settings const& settings)
    : width_(settings.width),
      height_(settings.height),
      step_(divided(std::max(width_, height_), largest_side)),
      whole_(batch_size_of(settings) >= std::uint64_t{width_} * height_) {}

void heatmap_sheet::add(run const& r) {
  row added{r.schedule, {}};
  for (bounce const& b : r.result.bounces) {
    if (b.pixel_efficiency.empty()) continue;  // of later batches alone
    if (b.pixel_efficiency.size() != std::size_t{width_} * height_)
      throw std::runtime_error("a heat map has another size than the picture");
    if (added.bounces.size() == most_columns) continue;
    heatmap map{{}, b.efficiency};
    for (std::size_t y = 0; y < height_; y += step_)
      for (std::size_t x = 0; x < width_; x += step_)
        map.efficiency.push_back(b.pixel_efficiency[y * width_ + x]);
    added.bounces.push_back(std::move(map));
  }
  most_bounces_ = std::max(most_bounces_, r.result.bounces.size());
  rows_.push_back(std::move(added));
}

image heatmap_sheet::colored(heatmap const& map) const {
  image result{divided(width_, step_), divided(height_, step_), {}};
  result.pixels.resize(map.efficiency.size());
  std::transform(map.efficiency.begin(), map.efficiency.end(), result.pixels.begin(),
                 [](float e) { return std::isnan(e) ? no_request : heat_color(e); });
  return result;
}

std::vector<std::string> heatmap_sheet::notes() const {
  std::vector<std::string> result = {"Lanes at work, in each group of 32 requests (one warp)"};
  if (most_bounces_ > most_columns)
    result.push_back("The first " + std::to_string(most_columns) + " of " +
                     std::to_string(most_bounces_) + " bounces");
  if (!whole_) result.push_back("Only pixels of the first batch have requests here");
  return result;
}

image heatmap_sheet::draw() const {
  std::uint32_t left = 0, columns = 0;
  for (row const& r : rows_) {
    left = std::max(left, text_width(r.schedule));
    columns = std::max(columns, static_cast<std::uint32_t>(r.bounces.size()));
  }
  left += 2 * gap;
  std::vector<std::string> const remarks = notes();
  std::uint32_t const wide = std::max(divided(width_, step_), text_width("bounce 16")) + gap;
  std::uint32_t const high = std::max(divided(height_, step_), line) + line + gap;
  std::uint32_t width = gap + scale_width + 4 * gap + line + text_width("no request");
  for (std::string const& remark : remarks) width = std::max(width, 2 * gap + text_width(remark));
  auto const rows = static_cast<std::uint32_t>(rows_.size());
  auto const lines = static_cast<std::uint32_t>(remarks.size());
  std::uint32_t const foot = gap + line + gap + rows * high;
  canvas sheet(std::max(width, left + columns * wide), foot + lines * line + scale_height + gap,
               paper);

  for (std::uint32_t k = 0; k < columns; ++k)
    sheet.text(left + k * wide, gap, "bounce " + std::to_string(k + 1), ink);
  std::uint32_t y = gap + line;
  for (row const& r : rows_) {
    sheet.text(gap, y, r.schedule, ink);
    std::uint32_t x = left;
    for (heatmap const& map : r.bounces) {
      image const picture = colored(map);
      sheet.paste(x, y, picture);
      char percent[32];
      std::snprintf(percent, sizeof(percent), "%.0f %%", 100 * map.mean);
      sheet.text(x, y + picture.height + 4, percent, ink);
      x += wide;
    }
    y += high;
  }
  for (std::uint32_t k = 0; k < lines; ++k) sheet.text(gap, foot + k * line, remarks[k], ink);
  draw_scale(sheet, gap, foot + lines * line + 4);
  return sheet.picture();
}

}  // namespace path_tracer
