// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scene/math.hpp"

namespace path_tracer {

/// Linear RGB, row 0 on top.
struct image {
  std::uint32_t width = 0, height = 0;
  std::vector<rgb> pixels;
};

/// The file name endings that `write_image` takes in this build: .png, .pfm and perhaps .exr.
std::vector<std::string_view> image_endings();

/// Whether `path` has one of them, in lower or upper case.
bool has_image_ending(std::string const& path);

/// Writes a picture in the format of the path's ending, whole or not at all.
/// - .png: 8 bits, values times 2^`exposure` clamped to [0, 1] (NaN: 0) and sRGB-encoded; no tone
///   mapping.
/// - .pfm: 32-bit floats as they are, little-endian, bottom row first as the format has it.
/// - .exr: 32-bit floats as they are, ZIP-compressed; Rec. 709 primaries, the format's default.
/// Throws std::invalid_argument for another ending and std::runtime_error as `write_file` does.
void write_image(std::string const& path, image const& picture, float exposure = 0);

}  // namespace path_tracer
