// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "scene/math.hpp"

namespace path_tracer {

/// Radiance from all directions, linear RGB: a picture whose middle lies along -z, whose top is +y
/// and whose right is +x. Row 0 is on top.
struct environment_map {
  std::uint32_t width = 0, height = 0;
  std::vector<vec3> texels;
};

/// Names a texel with an invalid value: negative, NaN or, alone or times `intensity`, beyond 1e30.
/// Empty if all are valid.
std::string fault_of(environment_map const& map, real intensity);

/// Reads a picture in Radiance's .hdr format, of 2^24 pixels at most. Throws std::runtime_error,
/// for values that are negative or, times `intensity`, not in the range of a float as well.
environment_map load_environment(std::string const& path, real intensity);

/// A map for rays, rotated about y, counter-clockwise as seen from above.
struct environment_view {
  vec3 const* texels;
  std::uint32_t width, height;
  real intensity;
  real rotation;  ///< radians

  /// The unit direction of picture coordinates in [0, 1] x [0, 1].
  PT_HD vec3 direction(vec2 uv) const {
    real const theta = pi * uv.y, phi = 2 * pi * (uv.x - real(0.5)) - rotation;
    real const s = std::sin(theta);
    return {s * std::sin(phi), std::cos(theta), -s * std::cos(phi)};
  }
  PT_HD vec2 coordinates(vec3 d) const {
    real const turn = (std::atan2(d.x, -d.z) + rotation) / (2 * pi) + real(0.5);
    return {turn - std::floor(turn), std::acos(glm::clamp(d.y, real(-1), real(1))) / pi};
  }
  /// The texel that has the coordinates inside.
  PT_HD std::uint32_t texel_at(vec2 uv) const {
    auto const x = static_cast<std::uint32_t>(uv.x * static_cast<real>(width));
    auto const y = static_cast<std::uint32_t>(uv.y * static_cast<real>(height));
    return (y < height ? y : height - 1) * width + (x < width ? x : width - 1);
  }
  /// Bilinear between the centres of texels.
  PT_HD vec3 radiance(vec2 uv) const {
    real const x = uv.x * static_cast<real>(width) - real(0.5);
    real const y = glm::clamp(uv.y * static_cast<real>(height) - real(0.5), real(0),
                              static_cast<real>(height - 1));
    real const left = std::floor(x), top = std::floor(y);
    auto const w = static_cast<std::int32_t>(width);
    auto const x0 = (static_cast<std::int32_t>(left) + w) % w, x1 = (x0 + 1) % w;
    auto const y0 = static_cast<std::uint32_t>(top), y1 = y0 + 1 < height ? y0 + 1 : y0;
    auto const at = [&](std::int32_t column, std::uint32_t row) {
      return texels[static_cast<std::size_t>(row) * width + static_cast<std::uint32_t>(column)];
    };
    vec3 const upper = glm::mix(at(x0, y0), at(x1, y0), x - left);
    vec3 const lower = glm::mix(at(x0, y1), at(x1, y1), x - left);
    return intensity * glm::mix(upper, lower, y - top);
  }
};

}  // namespace path_tracer
