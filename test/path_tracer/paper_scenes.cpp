// SPDX-License-Identifier: Apache-2.0
// The scenes with as many shaders as those of the paper (docs/paper.md).
#include <filesystem>
#include <string>

#include "catch.hpp"
#include "effects/scene_effects.hpp"
#include "io/gltf.hpp"
#include "path_tracer/fixture.hpp"
#include "path_tracer/process.hpp"
#include "render_support.hpp"

using namespace path_tracer;
using namespace path_tracer_test;

namespace {

/// A scene, and the shaders that run in it, in the order of the table.
struct paper_scene {
  char const* name;
  std::vector<std::string> shaders;

  std::string path() const {
    return (std::filesystem::path(PATH_TRACER_SCENES) / "paper" / (std::string(name) + ".gltf"))
        .string();
  }
};

std::vector<paper_scene> const& paper_scenes() {
  static std::vector<paper_scene> const scenes = {
      {"3-simple", {"metal", "emitters", "matte"}},
      {"6-simple", {"smooth-glass", "metal", "emitters", "matte", "plastic", "miss"}},
      {"2-simple-2-procedural", {"marble", "wood", "metal", "emitters"}},
      {"3-simple-2-procedural", {"marble", "wood", "metal", "emitters", "matte"}},
      {"11-moderate",
       {"smooth-glass", "rough-glass", "clearcoat", "sheen", "iridescence", "anisotropy", "metal",
        "emitters", "matte", "plastic", "miss"}}};
  return scenes;
}

}  // namespace

TEST_CASE("the paper's scenes run as many shaders as theirs, by every schedule", "[paper]") {
  auto const expected = GENERATE(from_range(paper_scenes()));
  CAPTURE(expected.name);
  temporary_folder const folder;
  outcome const result =
      run_path_tracer({expected.path(), "-o", folder / "a.pfm", "--width", "96", "--height", "54",
                       "--spp", "2", "--schedule", "all", "--report", folder / "r.json"});
  CAPTURE(result.err, result.out);
  REQUIRE(result.exit_code == 0);
  CHECK(result.out.find("pictures are bit-identical.\n") != std::string::npos);

  // Of the table's shaders, those that requests ran.
  json const report = json::parse(read_bytes(folder / "r.json"));
  std::vector<std::string> ran;
  for (std::string_view const name : shader_names())
    for (json const& bounce : report["schedules"][0]["bounces"])
      if (bounce["first_batch_by_shader"].contains(std::string(name))) {
        ran.emplace_back(name);
        break;
      }
  CHECK(ran == expected.shaders);

  // And those that materials ask for.
  std::string list;
  std::size_t count = 0;
  for (std::string const& name : expected.shaders)
    if (name != "miss") list += (count++ > 0 ? ", " : "") + name;
  outcome const explained = run_path_tracer({expected.path(), "--explain"});
  CHECK(explained.out.find("Its shaders: " + std::to_string(count) + " (" + list + ")") !=
        std::string::npos);
}

TEST_CASE("the paper's scenes are less coherent at the second hit than at the first", "[paper]") {
  auto const expected = GENERATE(from_range(paper_scenes()));
  CAPTURE(expected.name);
  render_settings settings = small(1, 4);
  settings.width = 640;
  settings.height = 360;
  settings.schedule = "implicit";
  settings.statistics = true;
  auto const as_they_come = render(load_gltf(expected.path()), settings);
  REQUIRE(as_they_come.bounces.size() == 4);
  CHECK(as_they_come.bounces[1].efficiency < 0.8 * as_they_come.bounces[0].efficiency);
  settings.schedule = "bucket+explicit";
  auto const grouped = render(load_gltf(expected.path()), settings);
  REQUIRE(grouped.bounces.size() == 4);
  for (bounce const& b : grouped.bounces) CHECK(b.efficiency > 0.99);
}
