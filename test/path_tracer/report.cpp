// SPDX-License-Identifier: Apache-2.0
// What the path tracer says about its work: JSON and progress.
#include "app/report.hpp"

#include <cstdio>
#include <stdexcept>

#include "app/progress.hpp"
#include "catch.hpp"
#include "path_tracer/fixture.hpp"

using namespace path_tracer;
using namespace path_tracer_test;

namespace {

run example(std::string const& schedule) {
  run r{schedule, {}};
  r.result.pixels = {{1, 2, 3}, {4, 5, 6}};
  r.result.seconds = 1.5;
  r.result.rays = 1234;
  r.result.discarded_samples = 2;
  r.result.bounces = {{100, 1.25, 10, 11.25, 0.98, {}, {70, 30}},
                      {50, 0.75, 5, 5.75, 0.56, {}, {50}}};
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

TEST_CASE("the JSON report holds what was asked for and what was measured") {
  options o;
  o.scene = "a\xff.gltf";  // a name need not be UTF-8
  o.settings.seed = 18446744073709551615u;
  o.repeat = 3;
  o.exposure = -1.5f;
  json const report = json::parse(json_report(o, 42, {example("local"), example("sort")}));
  CHECK(report["triangles"] == 42);
  CHECK(report["settings"]["spp"] == 16);
  CHECK(report["settings"]["seed"] == 18446744073709551615u);
  REQUIRE(report["schedules"].size() == 2);
  json const& second = report["schedules"][1];
  CHECK(second["schedule"] == "sort");
  CHECK(second["repetition"] == 1);
  CHECK(report["settings"]["repeat"] == 3);
  CHECK(report["settings"]["exposure"] == -1.5);
  CHECK(second["rays"] == 1234);
  CHECK(second["discarded_samples"] == 2);
  CHECK(second["bounces"][1]["requests"] == 50);
  CHECK(second["bounces"][0]["group_ms"] == 1.25);
  CHECK(second["bounces"][0]["efficiency"] == 0.98);
  CHECK(second["bounces"][0]["first_batch_by_shader"] == json{{"marble", 70}, {"wood", 30}});
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

}  // namespace
