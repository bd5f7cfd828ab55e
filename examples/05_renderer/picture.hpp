// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <vector>

#include "vec.hpp"

/// Writes a PFM picture, whole or not at all: rows of `width` pixels from the bottom up, on a
/// little-endian machine. Returns whether it did.
inline bool write_picture(std::string const& name, std::size_t width,
                          std::vector<vec> const& pixels) {
  std::string const part = name + ".part";
  std::ofstream file(part, std::ios::binary);
  file << "PF\n" << width << ' ' << pixels.size() / width << "\n-1.0\n";
  file.write(reinterpret_cast<char const*>(pixels.data()),
             static_cast<std::streamsize>(pixels.size() * sizeof(vec)));
  file.close();
  std::error_code error;
  if (file) std::filesystem::rename(part, name, error);
  if (file && !error) return true;
  std::filesystem::remove(part, error);
  return false;
}
