// SPDX-License-Identifier: Apache-2.0
// Animated nodes through a shutter, and files beside a scene.
#include <string>
#include <vector>

#include "catch.hpp"
#include "io/gltf.hpp"
#include "path_tracer/fixture.hpp"
#include "scene/environment_map.hpp"

using namespace path_tracer_test;
using path_tracer::scene;

namespace {

/// The fixture with an animation of its mesh's node: keys at 0 and 2 seconds.
struct animated {
  gltf_fixture f;

  animated(std::string const& path, std::vector<std::vector<float>> const& values,
           std::string const& interpolation = "LINEAR") {
    std::vector<float> numbers;
    for (auto const& v : values) numbers.insert(numbers.end(), v.begin(), v.end());
    char const* const type = values[0].size() == 4 ? "VEC4" : "VEC3";
    auto const input = f.add_accessor(f.add_view(bytes_of<float>({0, 2})), 5126, 2, "SCALAR");
    auto const output = f.add_accessor(f.add_view(bytes_of(numbers)), 5126, values.size(), type);
    json sampler = {{"input", input}, {"output", output}, {"interpolation", interpolation}};
    json channel = {{"sampler", 0}, {"target", {{"node", 1}, {"path", path}}}};
    json animation = {{"name", "swing"}};
    animation["samplers"].push_back(sampler);
    animation["channels"].push_back(channel);
    f.root["animations"].push_back(animation);
    shutter(0, 1);
  }

  void shutter(double open, double close) {
    f.root["cameras"][0]["extras"] = {{"shutter_open", open}, {"shutter_close", close}};
  }

  scene load() const {
    temporary_folder const folder;
    write_bytes(folder / "scene.gltf", f.text());
    return path_tracer::load_gltf(folder / "scene.gltf");
  }
};

}  // namespace

TEST_CASE("a node is where its keys put it when the shutter opens and closes", "[animation]") {
  scene const still = animated("translation", {{0, 0, 0}, {0, 0, 0}}).load();
  CHECK(still.motion.empty());
  animated moving("translation", {{0, 0, 0}, {4, 0, 2}});
  SECTION("linear") {
    moving.shutter(0.5, 3);
    scene const s = moving.load();
    CHECK(s.warnings.empty());
    REQUIRE(s.motion.size() == s.triangles.size());
    for (std::size_t t = 0; t < s.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k) {
        auto const base = still.triangles[t].position[k];
        CHECK(s.triangles[t].position[k] == base + path_tracer::vec3(1, 0, 0.5f));
        CHECK(s.motion[t].position[k] == base + path_tracer::vec3(4, 0, 2));
      }
  }
  SECTION("in steps") {
    moving = animated("translation", {{0, 0, 0}, {4, 0, 2}}, "STEP");
    CHECK(moving.load().motion.empty());
    moving.shutter(0, 2);
    CHECK(moving.load().motion.size() == still.triangles.size());
  }
  SECTION("without a shutter, the node stays, and a warning says so") {
    moving.shutter(0, 0);
    scene const s = moving.load();
    CHECK(s.motion.empty());
    REQUIRE(s.warnings.size() == 1);
    CHECK(s.warnings[0].find("animation without a shutter is left out") != std::string::npos);
  }
}

TEST_CASE("a mesh without normals turns its own", "[animation]") {
  float const half = 0.70710678f;  // a quarter turn about x
  animated turning("rotation", {{0, 0, 0, 1}, {half, 0, 0, half}});
  turning.f.root["meshes"][0]["primitives"][0]["attributes"].erase("NORMAL");
  turning.shutter(0, 2);
  scene const s = turning.load();
  REQUIRE(!s.motion.empty());
  for (std::size_t t = 0; t < s.triangles.size(); ++t) {
    auto const& p = s.motion[t].position;
    auto const face = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
    CHECK(glm::dot(face, s.motion[t].normal[0]) > 0.9999f);
    CHECK(glm::dot(face, s.triangles[t].normal[0]) < 0.01f);
  }
}

TEST_CASE("an animation with something wrong is refused by name", "[animation]") {
  auto const check = [](animated const& a, std::string const& words) {
    std::string message;
    try {
      a.load();
    } catch (std::runtime_error const& e) {
      message = e.what();
    }
    CAPTURE(words, message);
    CHECK(message.find("animation 0 \"swing\": " + words) != std::string::npos);
  };
  animated const good("scale", {{1, 1, 1}, {2, 2, 2}});
  CHECK(!good.load().motion.empty());
  animated a = good;
  a.f.at("/animations/0/channels/0/sampler") = 1;
  check(a, "a channel refers to no sampler of it");
  check(animated("scale", {{1, 1, 1}}), "it has 1 values for 2 keys");
  check(animated("scale", {{1, 1, 1}, {2, 2, 2}}, "BOUNCE"), "its interpolation \"BOUNCE\"");
  check(animated("rotation", {{1, 1, 1}, {2, 2, 2}}), "its keys are not of the types");
  check(animated("scale", {{1, 1, 1, 1}, {2, 2, 2, 2}}), "its keys are not of the types");
  a = good;
  a.f.at("/animations/0/samplers/0/input") = 0;  // positions
  check(a, "its keys are not of the types");
}

TEST_CASE("a file of an effect that is left out is not read", "[environment]") {
  using namespace path_tracer;
  gltf_fixture f;
  f.root["scenes"][0]["extras"] = {{"environment", "nowhere.hdr"}};
  temporary_folder const folder;
  write_bytes(folder / "scene.gltf", f.text());
  CHECK_THROWS(load_gltf(folder / "scene.gltf"));
  effect_bits allowed = effect_bits().set();
  allowed.reset(number_of<effects::environment>);
  scene const s = load_gltf(folder / "scene.gltf", allowed);
  CHECK(s.environment_file.empty());
  CHECK((called_for(s) & ~allowed).none());
}

TEST_CASE("an environment is a whole picture in Radiance's format", "[environment]") {
  temporary_folder const folder;
  std::string const path = folder / "sky.hdr";
  auto const message = [&](std::string const& bytes) {
    write_bytes(path, bytes);
    try {
      path_tracer::load_environment(path, 1);
      return std::string("fine");
    } catch (std::runtime_error const& e) {
      return std::string(e.what());
    }
  };
  auto const hdr = [](int width, int height, std::size_t pixels) {
    std::string result = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) +
                         " +X " + std::to_string(width) + "\n";
    for (std::size_t k = 0; k < pixels; ++k) result += "\x80\x40\x20\x81";
    return result;
  };
  CHECK(message(hdr(4, 3, 12)) == "fine");
  CHECK(message(hdr(100, 50, 5000)).find("truncated") == std::string::npos);
  auto const sky = path_tracer::load_environment(path, 1);
  CHECK(sky.width == 100);
  CHECK(sky.texels.size() == 5000);
  CHECK(sky.texels[4999] == path_tracer::vec3(1, 0.5f, 0.25f));
  for (std::size_t const pixels : {0u, 1u, 11u})
    CHECK(message(hdr(4, 3, pixels)).find("is truncated") != std::string::npos);
  CHECK(message(hdr(5, 0, 0)).find("fine") == std::string::npos);
  CHECK(message(hdr(0, 5, 0)).find("fine") == std::string::npos);
  CHECK(message("no picture").find("is not a picture in Radiance's") != std::string::npos);
  CHECK(message("").find("is not a picture in Radiance's") != std::string::npos);
}
