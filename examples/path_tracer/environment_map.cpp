// SPDX-License-Identifier: Apache-2.0
#include "environment_map.hpp"

#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>

#include "third_party.hpp"

namespace path_tracer {

environment_map load_environment(std::string const& path) {
  auto const fail = [&](std::string const& what) {
    throw std::runtime_error("environment \"" + path + "\": " + what);
  };
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) fail("there is no such file");
  std::uintmax_t const size = std::filesystem::file_size(path, error);
  if (error || size > 0x7fffffffu) fail("is larger than 2 GB");
  std::ifstream file(path, std::ios::binary);
  std::vector<unsigned char> bytes(static_cast<std::size_t>(size));
  if (!file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)))
    fail("cannot be read");
  auto const count = static_cast<int>(size);
  if (stbi_is_hdr_from_memory(bytes.data(), count) == 0)
    fail("is not a picture in Radiance's .hdr format");
  int width = 0, height = 0, channels = 0;
  std::unique_ptr<float, void (*)(void*)> const values(
      stbi_loadf_from_memory(bytes.data(), count, &width, &height, &channels, 3), stbi_image_free);
  if (!values) fail(std::string("cannot be decoded: ") + stbi_failure_reason());
  environment_map result;
  result.width = static_cast<std::uint32_t>(width);
  result.height = static_cast<std::uint32_t>(height);
  result.texels.resize(std::size_t{result.width} * result.height);
  for (std::size_t k = 0; k < result.texels.size(); ++k) {
    float const* const v = values.get() + 3 * k;
    for (int c = 0; c < 3; ++c)
      if (!(v[c] >= 0 && v[c] <= 1e30f))
        fail("texel " + std::to_string(k % result.width) + ", " + std::to_string(k / result.width) +
             " holds a value that is not finite or negative");
    result.texels[k] = {v[0], v[1], v[2]};
  }
  return result;
}

}  // namespace path_tracer
