// SPDX-License-Identifier: Apache-2.0
// Scenes from a modelling tool, where they lie beside the project; skipped where they do not.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "io/gltf.hpp"
#include "machines.hpp"

using namespace path_tracer;

namespace {

std::filesystem::path shared_scene(std::string const& name) {
  std::filesystem::path const path = std::filesystem::path(DEFERRED_SHADE_SHARED_SCENES) / name;
  if (!std::filesystem::exists(path)) WARN("skipped: there is no " << path.string());
  return path;
}

/// The pixels of a three-channel little-endian PFM, row 0 on top.
std::vector<vec3> read_pfm(std::filesystem::path const& path, std::uint32_t width,
                           std::uint32_t height) {
  std::ifstream file(path, std::ios::binary);
  std::string magic;
  std::uint32_t w = 0, h = 0;
  float scale = 0;
  file >> magic >> w >> h >> scale;
  file.get();
  REQUIRE(magic == "PF");
  REQUIRE(w == width);
  REQUIRE(h == height);
  REQUIRE(scale < 0);
  std::vector<vec3> pixels(std::size_t{width} * height);
  for (std::uint32_t y = height; y-- > 0;)
    file.read(reinterpret_cast<char*>(&pixels[std::size_t{y} * width]),
              static_cast<std::streamsize>(width * sizeof(vec3)));
  REQUIRE(file.good());
  return pixels;
}

}  // namespace

TEST_CASE("a scene of a modelling tool has the same bits whatever runs", "[shared]") {
  for (char const* const name : {"studio.glb", "balls.glb", "cornell.glb"}) {
    auto const path = shared_scene(name);
    if (!std::filesystem::exists(path)) continue;
    CAPTURE(name);
    check_same_bits(load_gltf(path.string()), small(2, 16), {1, 2});
  }
}

TEST_CASE("a scene of a modelling tool has the same bits by code for its effects alone",
          "[shared]") {
  for (char const* const name : {"studio.glb", "balls.glb", "cornell.glb"}) {
    auto const path = shared_scene(name);
    if (!std::filesystem::exists(path)) continue;
    CAPTURE(name);
    scene const s = load_gltf(path.string());
    for (std::string const& machine : machines()) {
      render_settings settings = small(2, 16, machine);
      auto const all = render(s, settings);
      specialize(settings, s);
      CHECK(same_bits(all, render(s, settings)));
    }
  }
}

// Minutes of work: hidden, and run by name. The reference is by Blender Cycles, 2048 samples and 64
// bounces, with emission on both sides.
TEST_CASE("cornell.glb agrees with the picture of another renderer", "[.][reference]") {
  auto const path = shared_scene("cornell.glb");
  auto const reference_path = shared_scene("cornell-reference.pfm");
  if (!std::filesystem::exists(path) || !std::filesystem::exists(reference_path)) return;
  std::uint32_t const size = 256;
  std::uint32_t const block = 16;
  std::vector<vec3> const reference = read_pfm(reference_path, size, size);
  render_settings settings;
  settings.width = settings.height = size;
  settings.samples = 1024;
  settings.max_depth = 64;
  settings.backend = backends().back();
  render_result const result = render(load_gltf(path.string()), settings);
  CHECK(result.discarded_samples == 0);

  for (int channel = 0; channel < 3; ++channel) {
    double sum = 0;
    double reference_sum = 0;
    double worst_block = 0;
    for (std::uint32_t y = 0; y < size; y += block) {
      for (std::uint32_t x = 0; x < size; x += block) {
        double here = 0;
        double expected = 0;
        for (std::uint32_t k = 0; k < block * block; ++k) {
          std::size_t const at = std::size_t{y + k / block} * size + x + k % block;
          here += static_cast<double>(result.pixels[at][channel]);
          expected += static_cast<double>(reference[at][channel]);
        }
        sum += here;
        reference_sum += expected;
        if (expected > 0.02 * block * block)
          worst_block = std::max(worst_block, std::abs(here / expected - 1));
      }
    }
    WARN("channel " << channel << ": mean over reference " << sum / reference_sum
                    << ", largest error of a block " << worst_block);
    CHECK(std::abs(sum / reference_sum - 1) < 0.005);
    CHECK(worst_block < 0.05);
  }
}
