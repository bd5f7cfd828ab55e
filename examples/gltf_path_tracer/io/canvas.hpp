// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

#include "io/image.hpp"

namespace path_tracer {

/// A rectangle of pixels: its upper left corner and its size.
struct area {
  std::uint32_t x, y, width, height;
};

/// A picture to draw on. What lies outside of it is left out.
class canvas {
 public:
  canvas(std::uint32_t width, std::uint32_t height, rgb background);

  void fill(area where, rgb color);
  void paste(std::uint32_t x, std::uint32_t y, image const& picture);

  /// Draws one line in a bitmap font, its upper left corner at (x, y). Characters that are not
  /// printable ASCII become question marks.
  void text(std::uint32_t x, std::uint32_t y, std::string_view line, rgb color);

  image const& picture() const { return picture_; }

 private:
  image picture_;
};

/// The size of a line of text in pixels.
inline constexpr std::uint32_t text_height = 20;
std::uint32_t text_width(std::string_view line);

/// Linear RGB of a colour in Oklab (Ottosson 2020): lightness and chroma from 0 to 1, hue in
/// degrees; clamped to what a screen can show.
rgb from_oklab(float lightness, float chroma, float hue);

}  // namespace path_tracer
