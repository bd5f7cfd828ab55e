// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include <unistd.h>

#include "io/image.hpp"

namespace path_tracer_test {

using nlohmann::json;

/// A folder of its own that goes with the object.
class temporary_folder {
 public:
  temporary_folder() {
    static std::atomic<unsigned> count{0};
    path_ = std::filesystem::temp_directory_path() /
            ("path_tracer_test." + std::to_string(::getpid()) + "." + std::to_string(count++));
    std::filesystem::create_directory(path_);
  }
  temporary_folder(temporary_folder const&) = delete;
  temporary_folder& operator=(temporary_folder const&) = delete;
  ~temporary_folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  std::string operator/(std::string const& name) const { return (path_ / name).string(); }

  /// Names of all files in it, sorted.
  std::vector<std::string> names() const {
    std::vector<std::string> result;
    for (auto const& entry : std::filesystem::directory_iterator(path_))
      result.push_back(entry.path().filename().string());
    std::sort(result.begin(), result.end());
    return result;
  }

 private:
  std::filesystem::path path_;
};

inline void write_bytes(std::string const& path, std::string const& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

inline std::string read_bytes(std::string const& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

template <class T>
std::string bytes_of(std::vector<T> const& values) {
  return {reinterpret_cast<char const*>(values.data()), values.size() * sizeof(T)};
}

inline std::string base64(std::string const& bytes) {
  char const* const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      result += i + k > bytes.size() ? '=' : digits[word >> (18 - 6 * k) & 63u];
  }
  return result;
}

/// A valid scene to spoil: one textured triangle in the plane z = 0, a camera at (0, 0, 3), a point
/// light. Every kind of reference of glTF occurs in it once.
struct gltf_fixture {
  json root;
  std::string data;

  gltf_fixture() {
    float const nan = std::numeric_limits<float>::quiet_NaN();
    float const infinity = std::numeric_limits<float>::infinity();
    root = json::parse(R"({
      "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2]}],
      "nodes": [{"camera": 0, "translation": [0, 0, 3]}, {"mesh": 0, "name": "thing"},
                {"extensions": {"KHR_lights_punctual": {"light": 0}}}],
      "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}],
      "meshes": [{"name": "patch", "primitives": [{"material": 0, "indices": 3,
                  "attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}}]}],
      "materials": [{"name": "paint", "pbrMetallicRoughness": {"metallicFactor": 0,
                     "roughnessFactor": 0.5, "baseColorTexture": {"index": 0}}}],
      "textures": [{"source": 0, "sampler": 0}], "samplers": [{}],
      "images": [{"bufferView": 4, "mimeType": "image/png"}],
      "extensionsUsed": ["KHR_lights_punctual"],
      "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "name": "bulb"}]}}})");
    add_view(bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}));
    add_view(bytes_of<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}));
    add_view(bytes_of<float>({0, 0, 1, 0, 0, 1}));
    add_view(bytes_of<std::uint16_t>({0, 1, 2}));
    add_view(png());
    add_view(bytes_of<float>({0, 0, 0, 1, 0, 0, 0, nan, 0}));                  // view 5
    add_view(bytes_of<std::uint16_t>({0, 1, 7}));                              // view 6
    add_view(bytes_of<float>({0, 0, 0, 1, infinity, 0, 0, 1, 0}));             // view 7
    add_view(bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0}));  // view 8: 5 points
    add_accessor(0, 5126, 3, "VEC3");
    add_accessor(1, 5126, 3, "VEC3");
    add_accessor(2, 5126, 3, "VEC2");
    add_accessor(3, 5123, 3, "SCALAR");
  }

  std::size_t add_view(std::string const& bytes) {
    data.resize((data.size() + 3) / 4 * 4);
    root["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", data.size()}, {"byteLength", bytes.size()}});
    data += bytes;
    return root["bufferViews"].size() - 1;
  }

  std::size_t add_accessor(std::size_t view, int component, std::size_t count, char const* type) {
    root["accessors"].push_back(
        {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
    return root["accessors"].size() - 1;
  }

  json& at(char const* pointer) { return root[json::json_pointer(pointer)]; }

  /// .gltf text with the buffer as a data URI, unless the test has described the buffers itself.
  std::string text() const {
    json whole = root;
    if (!whole.contains("buffers"))
      whole["buffers"] = {{{"byteLength", data.size()},
                           {"uri", "data:application/octet-stream;base64," + base64(data)}}};
    return whole.dump();
  }

  /// The same as .glb.
  std::string binary() const {
    json whole = root;
    whole["buffers"] = {{{"byteLength", data.size()}}};
    std::string head = whole.dump(), tail = data;
    head.resize((head.size() + 3) / 4 * 4, ' ');
    tail.resize((tail.size() + 3) / 4 * 4);
    auto const word = [](std::size_t v) {
      return bytes_of<std::uint32_t>({static_cast<std::uint32_t>(v)});
    };
    return "glTF" + word(2) + word(28 + head.size() + tail.size()) + word(head.size()) + "JSON" +
           head + word(tail.size()) + std::string("BIN\0", 4) + tail;
  }

  /// 2 x 2: red, green; blue, white.
  static std::string png() {
    temporary_folder const folder;
    path_tracer::write_image(folder / "t.png",
                             {2, 2, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}});
    return read_bytes(folder / "t.png");
  }
};

}  // namespace path_tracer_test
