// SPDX-License-Identifier: Apache-2.0
// What the path tracer says about its work: table, JSON, heat maps, progress.
#include "app/report.hpp"

#include <cstdio>
#include <limits>
#include <stdexcept>

#include "app/progress.hpp"
#include "catch.hpp"
#include "path_tracer/fixture.hpp"
#include "path_tracer/process.hpp"

using namespace path_tracer;
using namespace path_tracer_test;

namespace {

run example(std::string const& schedule) {
  run r{schedule, {}};
  r.result.pixels = {{1, 2, 3}, {4, 5, 6}};
  r.result.seconds = 1.5;
  r.result.rays = 1234;
  r.result.discarded_samples = 2;
  float const nan = std::numeric_limits<float>::quiet_NaN();
  r.result.bounces = {{100, 1.25, 10, 11.25, 0.98, {1, nan}, {70, 30}},
                      {50, 0.75, 5, 5.75, 0.56, {0, 0.5f}, {50}}};
  return r;
}

std::size_t lines(std::string const& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

std::string shown(bool terminal, std::vector<double> const& fractions) {
  std::FILE* const file = std::tmpfile();
  REQUIRE(file != nullptr);
  {
    progress p("label", file, terminal);
    for (double const f : fractions) p(f);
  }
  std::string result(static_cast<std::size_t>(std::ftell(file)), '\0');
  std::rewind(file);
  result.resize(std::fread(result.data(), 1, result.size(), file));
  std::fclose(file);
  return result;
}

/// Lightness in Oklab of linear RGB (Ottosson 2020), from the published matrices.
double lightness(vec3 c) {
  double const l = std::cbrt(0.4122214708 * c.x + 0.5363325363 * c.y + 0.0514459929 * c.z);
  double const m = std::cbrt(0.2119034982 * c.x + 0.6806995451 * c.y + 0.1073969566 * c.z);
  double const s = std::cbrt(0.0883024619 * c.x + 0.2817188376 * c.y + 0.6299787005 * c.z);
  return 0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s;
}

TEST_CASE("pictures that differ in one bit are told apart") {
  run const a = example("local");
  run b = example("sort");
  CHECK_NOTHROW(require_identical(a, b));
  b.result.pixels[1].y = std::nextafter(5.0f, 6.0f);
  CHECK_THROWS_WITH(require_identical(a, b),
                    "the pictures of schedules local and sort differ, "
                    "first at pixel 1 from the upper left");
  b = example("sort");
  b.result.pixels[0].x = -0.0f;
  run c = a;
  c.result.pixels[0].x = 0.0f;
  CHECK_THROWS_AS(require_identical(b, c), std::runtime_error);
  b.result.pixels.pop_back();
  CHECK_THROWS_AS(require_identical(a, b), std::runtime_error);
}

TEST_CASE("the table sums over bounces") {
  std::string const text = table({example("local"), example("a longer name")});
  CAPTURE(text);
  CHECK(lines(text) == 4);
  CHECK(text.find("local                2.0       15.0       17.0     98 %    56 %\n") !=
        std::string::npos);
}

TEST_CASE("the JSON report holds what was asked for and what was measured") {
  options o;
  o.scene = "a\xff.gltf";  // a name need not be UTF-8
  o.settings.seed = 18446744073709551615u;
  json const report = json::parse(json_report(o, 42, {example("local"), example("sort")}));
  CHECK(report["triangles"] == 42);
  CHECK(report["settings"]["spp"] == 16);
  CHECK(report["settings"]["seed"] == 18446744073709551615u);
  REQUIRE(report["schedules"].size() == 2);
  json const& second = report["schedules"][1];
  CHECK(second["schedule"] == "sort");
  CHECK(second["rays"] == 1234);
  CHECK(second["discarded_samples"] == 2);
  CHECK(second["bounces"][1]["requests"] == 50);
  CHECK(second["bounces"][0]["group_ms"] == 1.25);
  CHECK(second["bounces"][0]["efficiency"] == 0.98);
  CHECK(second["bounces"][0]["first_batch_by_shader"] == json{{"emitters", 70}, {"marble", 30}});
}

TEST_CASE("the colours of a heat map rise evenly in lightness") {
  for (int i = 0; i <= 100; ++i) {
    vec3 const c = heat_color(static_cast<float>(i) / 100);
    CAPTURE(i, c.x, c.y, c.z);
    CHECK_THAT(lightness(c), WithinAbs(0.25 + 0.70 * i / 100, 0.002));
  }
}

TEST_CASE("a heat map is one picture for each bounce") {
  temporary_folder const folder;
  render_settings settings;
  settings.width = 2;
  settings.height = 1;
  write_heatmaps(folder / "", settings, example("local"), false);
  write_heatmaps(folder / "", settings, example("sort"), true);
  CHECK(folder.names() == std::vector<std::string>{"bounce_01.png", "bounce_02.png",
                                                   "sort_bounce_01.png", "sort_bounce_02.png"});
  CHECK(read_bytes(folder / "bounce_01.png") == read_bytes(folder / "sort_bounce_01.png"));
  CHECK(read_bytes(folder / "bounce_01.png") != read_bytes(folder / "bounce_02.png"));
  settings.width = 3;
  CHECK_THROWS_AS(write_heatmaps(folder / "", settings, example("local"), false),
                  std::runtime_error);
}

TEST_CASE("progress is a line every ten percent where there is no terminal") {
  std::vector<double> fractions;
  for (int i = 0; i <= 1000; ++i) fractions.push_back(i / 1000.0);
  std::string const text = shown(false, fractions);
  CHECK(lines(text) == 11);
  CHECK(text.rfind("label   0 %\nlabel  10 %  0 s left\n", 0) == 0);
  CHECK(text.find("label 100 %  0 s\n") != std::string::npos);
}

TEST_CASE("progress is one line that rewrites itself on a terminal") {
  std::string const text = shown(true, {0, 0.5, 0.5, 1});
  CHECK(lines(text) == 1);
  CHECK(std::count(text.begin(), text.end(), '\r') == 3);
  CHECK(text.find("[###############...............]  50 %") != std::string::npos);
  CHECK(shown(true, {}).empty());
}

TEST_CASE("durations") {
  CHECK(duration(-1) == "0 s");
  CHECK(duration(59.4) == "59 s");
  CHECK(duration(185) == "3 min 05 s");
  CHECK(duration(7805) == "2 h 10 min");
}

TEST_CASE("every schedule renders the same picture, with table, report and heat maps") {
  std::string const backend(GENERATE(from_range(backends())));
  temporary_folder const folder;
  write_bytes(folder / "scene.gltf", gltf_fixture().text());
  outcome const result =
      run_path_tracer({folder / "scene.gltf", "-o", folder / "a.pfm", "--width", "40", "--height",
                       "20", "--spp", "2", "--backend", backend, "--schedule", "all", "--report",
                       folder / "r.json", "--heatmap", folder / "heat/maps"});
  CAPTURE(backend, result.err, result.out);
  REQUIRE(result.exit_code == 0);
  std::string const count = std::to_string(schedules().size());
  CHECK(result.out.find("all " + count + " pictures are bit-identical\n") != std::string::npos);
  CHECK(read_bytes(folder / "a.pfm").size() == 40 * 20 * 12 + 14);
  json const report = json::parse(read_bytes(folder / "r.json"));
  CHECK(report["settings"]["backend"] == backend);
  REQUIRE(report["schedules"].size() == schedules().size());
  for (std::string_view const name : schedules()) {
    CHECK(result.out.find("\n" + std::string(name) + " ") != std::string::npos);
    CHECK(std::filesystem::exists(folder / ("heat/maps/" + std::string(name) + "_bounce_01.png")));
  }
  CHECK(folder.names() == std::vector<std::string>{"a.pfm", "heat", "r.json", "scene.gltf"});
}

}  // namespace
