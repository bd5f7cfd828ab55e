// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "io/third_party.hpp"
#include "path_tracer/fixture.hpp"

namespace path_tracer_test {

/// A PNG that was read back: 8 bits for each of `channels`, top row first; 0 x 0 if it is none.
struct png_picture {
  int width = 0, height = 0, channels = 0;
  std::vector<int> values;
};

inline png_picture read_png(std::string const& path) {
  std::string const bytes = read_bytes(path);
  png_picture result;
  std::unique_ptr<stbi_uc, void (*)(void*)> const read(
      stbi_load_from_memory(reinterpret_cast<stbi_uc const*>(bytes.data()),
                            static_cast<int>(bytes.size()), &result.width, &result.height,
                            &result.channels, 0),
      stbi_image_free);
  if (!read) return {};
  result.values.assign(read.get(), read.get() + result.width * result.height * result.channels);
  return result;
}

}  // namespace path_tracer_test
