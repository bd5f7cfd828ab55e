// SPDX-License-Identifier: Apache-2.0
#include "io/image.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#ifdef PATH_TRACER_HAS_OPENEXR
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#endif

#include "io/output_file.hpp"
#include "io/third_party.hpp"

namespace path_tracer {
namespace {

std::string ending(std::string const& path) {
  auto const dot = path.rfind('.');
  std::string result = dot == std::string::npos ? "" : path.substr(dot);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

/// IEC 61966-2-1.
std::uint8_t encode_srgb(float linear) {
  float const v = linear > 0 ? std::min(linear, 1.0f) : 0.0f;  // NaN: 0
  float const encoded = v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
  return static_cast<std::uint8_t>(std::lround(encoded * 255.0f));
}

std::string encode_png(image const& picture, float exposure) {
  float const scale = std::exp2(exposure);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(3 * picture.pixels.size());
  for (rgb const& p : picture.pixels)
    for (int i = 0; i < 3; ++i) bytes.push_back(encode_srgb(scale * p[i]));
  std::string result;
  auto const append = [](void* to, void* data, int size) {
    static_cast<std::string*>(to)->append(static_cast<char const*>(data),
                                          static_cast<std::size_t>(size));
  };
  auto const width = static_cast<int>(picture.width), height = static_cast<int>(picture.height);
  if (stbi_write_png_to_func(append, &result, width, height, 3, bytes.data(), 3 * width) == 0)
    throw std::runtime_error("the PNG encoder ran out of memory");
  return result;
}

std::string encode_pfm(image const& picture) {
  std::string result =
      "PF\n" + std::to_string(picture.width) + " " + std::to_string(picture.height) + "\n-1.0\n";
  result.reserve(result.size() + 12 * picture.pixels.size());
  for (std::size_t row = picture.height; row-- > 0;)
    for (std::size_t x = 0; x < picture.width; ++x)
      for (int i = 0; i < 3; ++i) {
        std::uint32_t bits;
        std::memcpy(&bits, &picture.pixels[row * picture.width + x][i], sizeof(bits));
        for (int shift = 0; shift < 32; shift += 8)
          result.push_back(static_cast<char>(bits >> shift & 255u));
      }
  return result;
}

#ifdef PATH_TRACER_HAS_OPENEXR
class memory_stream : public Imf::OStream {
 public:
  memory_stream() : Imf::OStream("picture") {}

  void write(char const* bytes, int count) override {
    auto const size = static_cast<std::size_t>(count);
    if (position_ + size > bytes_.size()) bytes_.resize(position_ + size);
    std::memcpy(&bytes_[position_], bytes, size);
    position_ += size;
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = static_cast<std::size_t>(position); }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
  std::size_t position_ = 0;
};

std::string encode_exr(image const& picture) {
  int const width = static_cast<int>(picture.width), height = static_cast<int>(picture.height);
  Imf::Header header(width, height);
  Imf::FrameBuffer pixels;
  char const* const names[] = {"R", "G", "B"};
  char const* const data = reinterpret_cast<char const*>(picture.pixels.data());
  for (std::size_t i = 0; i < 3; ++i) {
    header.channels().insert(names[i], Imf::Channel(Imf::FLOAT));
    // A frame buffer is for reading and writing alike; an output file only reads from it.
    pixels.insert(names[i], Imf::Slice(Imf::FLOAT, const_cast<char*>(data) + i * sizeof(float),
                                       sizeof(rgb), sizeof(rgb) * picture.width));
  }
  memory_stream stream;
  {
    Imf::OutputFile file(stream, header, 0);
    file.setFrameBuffer(pixels);
    file.writePixels(height);
  }
  return stream.take();
}
#endif

std::string encode(std::string const& format, image const& picture, float exposure) {
  if (format == ".png") return encode_png(picture, exposure);
  if (format == ".pfm") return encode_pfm(picture);
#ifdef PATH_TRACER_HAS_OPENEXR
  if (format == ".exr") return encode_exr(picture);
#endif
  throw std::invalid_argument("no format for a picture named *" + format);
}

}  // namespace

std::vector<std::string_view> image_endings() {
#ifdef PATH_TRACER_HAS_OPENEXR
  return {".png", ".exr", ".pfm"};
#else
  return {".png", ".pfm"};
#endif
}

bool has_image_ending(std::string const& path) {
  auto const endings = image_endings();
  return std::find(endings.begin(), endings.end(), ending(path)) != endings.end();
}

void write_image(std::string const& path, image const& picture, float exposure) {
  write_file(path, encode(ending(path), picture, exposure));
}

}  // namespace path_tracer
