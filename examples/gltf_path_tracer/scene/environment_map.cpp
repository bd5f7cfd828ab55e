// SPDX-License-Identifier: Apache-2.0
#include "scene/environment_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>

#include "io/third_party.hpp"

namespace path_tracer {
namespace {

/// The most texels: a random number of 24 bits can pick each of them.
constexpr std::int64_t most_texels = std::int64_t{1} << 24;

/// A file that records reads beyond its end, which stb ignores.
struct byte_stream {
  std::vector<unsigned char> const& bytes;
  std::size_t at;
  bool has_ended;
};

int read_stream(void* user, char* to, int count) {
  auto& stream = *static_cast<byte_stream*>(user);
  std::size_t const taken =
      std::min(static_cast<std::size_t>(count), stream.bytes.size() - stream.at);
  // It fills a buffer of 128 bytes, and asks for less only of what it needs.
  if (taken == 0 || (taken < static_cast<std::size_t>(count) && count < 128))
    stream.has_ended = true;
  std::copy_n(stream.bytes.begin() + static_cast<std::ptrdiff_t>(stream.at), taken, to);
  stream.at += taken;
  return static_cast<int>(taken);
}

void skip_stream(void* user, int count) {
  auto& stream = *static_cast<byte_stream*>(user);
  auto const at = static_cast<std::int64_t>(stream.at) + count;
  stream.at = static_cast<std::size_t>(
      std::clamp(at, std::int64_t{0}, static_cast<std::int64_t>(stream.bytes.size())));
}

int stream_is_at_end(void* user) {
  auto const& stream = *static_cast<byte_stream*>(user);
  return stream.at == stream.bytes.size() ? 1 : 0;
}

constexpr stbi_io_callbacks stream_calls = {read_stream, skip_stream, stream_is_at_end};

}  // namespace

std::string fault_of(environment_map const& map, real intensity) {
  for (std::size_t k = 0; k < map.texels.size(); ++k)
    for (int c = 0; c < 3; ++c) {
      real const v = map.texels[k][c];
      if (v >= 0 && v * intensity <= real(1e30) && v <= real(1e30)) continue;
      return "texel " + std::to_string(k % map.width) + ", " + std::to_string(k / map.width) +
             " holds a value that is " +
             (std::isnan(v) ? "not a number" : "negative or beyond 1e30");
    }
  return {};
}

environment_map load_environment(std::string const& path, real intensity) {
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
  if (stbi_is_hdr_from_memory(bytes.data(), static_cast<int>(size)) == 0)
    fail("is not a picture in Radiance's .hdr format");
  byte_stream stream{bytes, 0, false};
  int width = 0, height = 0, channels = 0;
  std::unique_ptr<float, void (*)(void*)> const values(
      stbi_loadf_from_callbacks(&stream_calls, &stream, &width, &height, &channels, 3),
      stbi_image_free);
  if (!values) fail(std::string("cannot be decoded: ") + stbi_failure_reason());
  if (stream.has_ended) fail("is truncated");
  if (width < 1 || height < 1) fail("has no pixels");
  if (std::int64_t{width} * height > most_texels) fail("has more than 2^24 pixels");
  environment_map result;
  result.width = static_cast<std::uint32_t>(width);
  result.height = static_cast<std::uint32_t>(height);
  result.texels.resize(std::size_t{result.width} * result.height);
  for (std::size_t k = 0; k < result.texels.size(); ++k) {
    float const* const v = values.get() + 3 * k;
    result.texels[k] = {v[0], v[1], v[2]};
  }
  if (std::string const fault = fault_of(result, intensity); !fault.empty()) fail(fault);
  return result;
}

}  // namespace path_tracer
