// SPDX-License-Identifier: Apache-2.0
#include "io/gltf_document.hpp"
#include "io/gltf_properties.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string_view>

namespace path_tracer::gltf {
namespace {

constexpr std::uintmax_t maximum_file_size = 0xffff'ffffu;  // tinygltf and .glb count 32 bits
constexpr int maximum_depth = 64;                           // of JSON; tinygltf recurses over it

/// Those that no effect brings.
constexpr std::string_view supported_extensions[] = {
    "KHR_materials_emissive_strength", "KHR_materials_ior", "KHR_materials_transmission",
    "KHR_materials_specular", "KHR_lights_punctual"};

std::string read_file(std::string const& path) {
  std::error_code error;
  std::filesystem::file_status const status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw std::runtime_error("there is no such file");
  if (!std::filesystem::is_regular_file(status)) throw std::runtime_error("is not a regular file");
  std::uintmax_t const size = std::filesystem::file_size(path, error);
  if (error) throw std::runtime_error(error.message());
  if (size > maximum_file_size) throw std::runtime_error("is larger than 4 GB");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  if (!file.read(bytes.data(), static_cast<std::streamsize>(size)))
    throw std::runtime_error(std::string("cannot be read: ") + std::strerror(errno));
  return bytes;
}

std::uint32_t word(std::string_view bytes, std::size_t offset) {
  auto const byte = [&](std::size_t i) {
    return std::uint32_t{static_cast<unsigned char>(bytes[offset + i])};
  };
  return byte(0) | byte(1) << 8 | byte(2) << 16 | byte(3) << 24;
}

/// The JSON chunk of a .glb file whose header and first two chunks lie inside the file.
std::string_view json_chunk(std::string_view glb) {
  if (glb.size() < 20) throw std::runtime_error("is truncated: a .glb file starts with 20 bytes");
  if (word(glb, 4) != 2)
    throw std::runtime_error("is a .glb file of version " + std::to_string(word(glb, 4)) +
                             ", not of version 2");
  std::uint64_t const length = word(glb, 8), json_length = word(glb, 12);
  if (length > glb.size())
    throw std::runtime_error("is truncated: its header says " + std::to_string(length) +
                             " bytes, but there are " + std::to_string(glb.size()));
  if (word(glb, 16) != 0x4e4f534a) throw std::runtime_error("has no JSON in its first chunk");
  if (20 + json_length > length)
    throw std::runtime_error("has a JSON chunk that ends after the file does");
  if (28 + json_length <= length &&
      28 + json_length + word(glb, static_cast<std::size_t>(20 + json_length)) > length)
    throw std::runtime_error("has a binary chunk that ends after the file does");
  return glb.substr(20, static_cast<std::size_t>(json_length));
}

json parse(std::string_view text) {
  auto const shallow = [](int depth, json::parse_event_t, json&) {
    if (depth > maximum_depth)
      throw std::runtime_error("is not a glTF file: its JSON is nested too deeply");
    return true;
  };
  try {
    return json::parse(text.begin(), text.end(), shallow);
  } catch (json::parse_error const& e) {
    if (e.byte > text.size()) throw std::runtime_error("is truncated: its JSON has no end");
    throw std::runtime_error("is not a glTF file: no valid JSON at byte " + std::to_string(e.byte));
  } catch (json::exception const&) {
    throw std::runtime_error("is not a glTF file: it holds a number beyond the range of a double");
  }
}

void check_asset(json const& root) {
  json const& asset = root.at("asset");
  auto const version = asset.is_object() ? asset.find("version") : asset.end();
  if (!asset.is_object() || version == asset.end() || !version->is_string())
    throw std::runtime_error("is not a glTF file: it has no asset.version");
  if (version->get<std::string>().rfind("2.", 0) != 0)
    throw std::runtime_error("is glTF " + version->get<std::string>() + ", not glTF 2");
}

void check_extensions(document& d) {
  std::vector<std::string> known(std::begin(supported_extensions), std::end(supported_extensions));
  std::string const holder = "/extensions/";
  for_each_property([&](std::string const& path, auto const&) {
    auto const at = path.find(holder);
    if (at == std::string::npos) return;
    std::string const name = path.substr(at + holder.size());
    known.push_back(name.substr(0, name.find('/')));
  });
  auto const supported = [&](std::string const& name) {
    return std::find(known.begin(), known.end(), name) != known.end();
  };
  for (std::string const& name :
       value_at(d.root, "/extensionsRequired", std::vector<std::string>{}))
    if (!supported(name)) throw std::runtime_error("requires the extension " + name);
  for (std::string const& name : value_at(d.root, "/extensionsUsed", std::vector<std::string>{}))
    if (!supported(name)) d.left_out.add("extension " + name, "");
}

void check_buffer_views(json const& root) {
  for (std::size_t i = 0; root.contains("bufferViews") && i < root["bufferViews"].size(); ++i) {
    json const& view = root["bufferViews"][i];
    auto const buffer = view["buffer"].get<std::size_t>();
    auto const size = root["buffers"][buffer]["byteLength"].get<std::uint64_t>();
    auto const end =
        value_at<std::uint64_t>(view, "/byteOffset", 0) + view["byteLength"].get<std::uint64_t>();
    if (end > size)
      throw std::runtime_error(element(root, "bufferViews", i) + " ends at byte " +
                               std::to_string(end) + ", but " + element(root, "buffers", buffer) +
                               " has " + std::to_string(size));
  }
}

/// Keeps the encoded bytes: only images that a material uses are decoded, and with checked sizes.
bool keep_encoded(tinygltf::Image* image, int, std::string*, std::string*, int, int,
                  unsigned char const* bytes, int size, void*) {
  if (size > 0) image->image.assign(bytes, bytes + size);
  return true;
}

/// tinygltf skips a primitive that it cannot read, and numbers the others anew.
bool lost_primitive(document const& d) {
  for (std::size_t i = 0; i < d.model.meshes.size(); ++i)
    if (d.model.meshes[i].primitives.size() != d.root["meshes"][i]["primitives"].size())
      return true;
  return false;
}

}  // namespace

document read_document(std::string const& path) {
  std::string const bytes = read_file(path);
  if (bytes.empty()) throw std::runtime_error("is empty");
  bool const binary = bytes.rfind("glTF", 0) == 0;
  document d;
  d.root = parse(binary ? json_chunk(bytes) : std::string_view(bytes));
  if (!d.root.is_object() || !d.root.contains("asset"))
    throw std::runtime_error("is not a glTF file: it has no \"asset\"");
  check_asset(d.root);
  d.left_out = check(d.root);
  check_extensions(d);
  check_buffer_views(d.root);

  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(keep_encoded, nullptr);
  std::string error, warning;
  std::string const folder = std::filesystem::path(path).parent_path().string();
  auto const size = static_cast<unsigned>(bytes.size());
  bool const loaded =
      binary ? loader.LoadBinaryFromMemory(&d.model, &error, &warning,
                                           reinterpret_cast<unsigned char const*>(bytes.data()),
                                           size, folder)
             : loader.LoadASCIIFromString(&d.model, &error, &warning, bytes.data(), size, folder);
  if (loaded && !lost_primitive(d)) return d;
  std::size_t const buffer = d.model.buffers.size();
  if (d.root.contains("buffers") && buffer < d.root["buffers"].size())
    error = element(d.root, "buffers", buffer) +
            " is not there, or has not the length that it says: " + error;
  throw std::runtime_error(error);
}

}  // namespace path_tracer::gltf
