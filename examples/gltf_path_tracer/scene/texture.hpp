// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

#include "scene/math.hpp"
#include "scene/scene.hpp"

namespace path_tracer {

/// The sRGB transfer function (IEC 61966-2-1), from an encoded value to linear.
PT_HD inline real srgb_to_linear(real v) {
  return v <= real(0.04045) ? v / real(12.92)
                            : std::pow((v + real(0.055)) / real(1.055), real(2.4));
}

/// All textures of a scene; `linear` holds the linear value of each 8-bit sRGB code.
struct texture_view {
  texture const* textures;
  std::uint32_t const* texels;
  real const* linear;
};

/// The texel index in [0, size) that index `i` means under a wrap mode.
PT_HD inline std::uint32_t wrap_texel(std::int64_t i, std::uint32_t size, std::uint8_t mode) {
  auto const n = static_cast<std::int64_t>(size);
  if (mode == 1) return static_cast<std::uint32_t>(i < 0 ? 0 : i >= n ? n - 1 : i);
  std::int64_t const period = mode == 2 ? 2 * n : n;
  std::int64_t k = i % period;
  if (k < 0) k += period;
  return static_cast<std::uint32_t>(k < n ? k : period - 1 - k);
}

/// One texel, linear RGB and alpha.
PT_HD inline vec4 fetch_texel(texture_view const& view, texture const& t, std::int64_t x,
                              std::int64_t y) {
  std::uint32_t const row = wrap_texel(y, t.height, t.wrap_t);
  std::uint32_t const texel = view.texels[std::size_t{t.offset} + std::size_t{row} * t.width +
                                          wrap_texel(x, t.width, t.wrap_s)];
  std::uint32_t const r = texel & 255u, g = (texel >> 8) & 255u, b = (texel >> 16) & 255u;
  real const scale = real(1) / real(255);
  real const alpha = static_cast<real>(texel >> 24) * scale;
  if (t.srgb) return {view.linear[r], view.linear[g], view.linear[b], alpha};
  return {static_cast<real>(r) * scale, static_cast<real>(g) * scale, static_cast<real>(b) * scale,
          alpha};
}

/// Texture number `index` at `uv`, decoded before it is filtered. (0, 0) is the upper left corner
/// of the upper left texel. Coordinates beyond a million repeats, or not finite, count as 0.
PT_HD inline vec4 sample_texture(texture_view const& view, std::int32_t index, vec2 uv) {
  texture const& t = view.textures[index];
  if (!(std::fabs(uv.x) < real(1e6))) uv.x = 0;
  if (!(std::fabs(uv.y) < real(1e6))) uv.y = 0;
  real const x = uv.x * static_cast<real>(t.width);
  real const y = uv.y * static_cast<real>(t.height);
  if (t.nearest)
    return fetch_texel(view, t, static_cast<std::int64_t>(std::floor(x)),
                       static_cast<std::int64_t>(std::floor(y)));
  real const left = std::floor(x - real(0.5)), top = std::floor(y - real(0.5));
  real const fx = x - real(0.5) - left, fy = y - real(0.5) - top;
  auto const ix = static_cast<std::int64_t>(left), iy = static_cast<std::int64_t>(top);
  vec4 const upper =
      fetch_texel(view, t, ix, iy) * (1 - fx) + fetch_texel(view, t, ix + 1, iy) * fx;
  vec4 const lower =
      fetch_texel(view, t, ix, iy + 1) * (1 - fx) + fetch_texel(view, t, ix + 1, iy + 1) * fx;
  return upper * (1 - fy) + lower * fy;
}

}  // namespace path_tracer
