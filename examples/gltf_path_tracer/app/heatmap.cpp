// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include "app/report.hpp"
#include "io/image.hpp"

namespace path_tracer {
namespace {

/// Oklab to linear Rec. 709, B. Ottosson, "A perceptual color space for image processing", 2020.
rgb oklab_to_linear(float lightness, float a, float b) {
  float const l = lightness + 0.3963377774f * a + 0.2158037573f * b;
  float const m = lightness - 0.1055613458f * a - 0.0638541728f * b;
  float const s = lightness - 0.0894841775f * a - 1.2914855480f * b;
  rgb const cubes{l * l * l, m * m * m, s * s * s};
  return {4.0767416621f * cubes.x - 3.3077115913f * cubes.y + 0.2309699292f * cubes.z,
          -1.2684380046f * cubes.x + 2.6097574011f * cubes.y - 0.3413193965f * cubes.z,
          -0.0041960863f * cubes.x - 0.7034186147f * cubes.y + 1.7076147010f * cubes.z};
}

/// Chroma and hue (degrees) at equal steps of the value; chosen to stay inside Rec. 709.
struct control_point {
  float chroma, hue;
};
constexpr control_point points[] = {
    {0.10f, 300}, {0.16f, 328}, {0.19f, 375}, {0.15f, 415}, {0.10f, 465}};
constexpr float darkest = 0.25f, lightest = 0.95f;

}  // namespace

rgb heat_color(float efficiency) {
  constexpr int intervals = static_cast<int>(std::size(points)) - 1;
  float const t = efficiency > 0 ? std::min(efficiency, 1.0f) : 0.0f;
  int const i = std::min(static_cast<int>(t * intervals), intervals - 1);
  float const u = t * intervals - static_cast<float>(i);
  float const chroma = points[i].chroma * (1 - u) + points[i + 1].chroma * u;
  float const hue = (points[i].hue * (1 - u) + points[i + 1].hue * u) * float(pi) / 180;
  float const lightness = darkest + (lightest - darkest) * t;
  rgb const color = oklab_to_linear(lightness, chroma * std::cos(hue), chroma * std::sin(hue));
  return glm::clamp(color, rgb(0), rgb(1));
}

void write_heatmaps(std::string const& folder, render_settings const& settings, run const& r,
                    bool name_schedule) {
  image picture{settings.width, settings.height, {}};
  std::size_t const size = std::size_t{picture.width} * picture.height;
  for (std::size_t i = 0; i < r.result.bounces.size(); ++i) {
    std::vector<float> const& efficiency = r.result.bounces[i].pixel_efficiency;
    if (efficiency.empty()) continue;
    if (efficiency.size() != size)
      throw std::runtime_error("the efficiency of bounce " + std::to_string(i + 1) +
                               " has another size than the picture");
    picture.pixels.resize(size);
    std::transform(efficiency.begin(), efficiency.end(), picture.pixels.begin(),
                   [](float e) { return std::isnan(e) ? rgb(0.01f) : heat_color(e); });
    char number[32];
    std::snprintf(number, sizeof(number), "bounce_%02zu.png", i + 1);
    std::string const prefix = name_schedule ? r.schedule + "_" : "";
    write_image((std::filesystem::path(folder) / (prefix + number)).string(), picture);
  }
}

}  // namespace path_tracer
