// SPDX-License-Identifier: Apache-2.0
// What the options of the program do; bad_input.cpp has those that are wrong.
#include <algorithm>

#include "app/render.hpp"
#include "catch.hpp"
#include "path_tracer/fixture.hpp"
#include "path_tracer/png.hpp"
#include "path_tracer/process.hpp"

using namespace path_tracer;
using namespace path_tracer_test;

namespace {

/// A folder with a scene in it, and the arguments to render that quickly.
struct workplace {
  temporary_folder folder;
  workplace() { write_bytes(folder / "scene.gltf", gltf_fixture().text()); }
  outcome run(std::vector<std::string> const& more) const {
    std::vector<std::string> all = {
        folder / "scene.gltf", "--width", "40", "--height", "20", "--spp", "2"};
    all.insert(all.end(), more.begin(), more.end());
    outcome const result = run_path_tracer(all);
    CAPTURE(result.err, result.out);
    CHECK(result.exit_code == 0);
    return result;
  }
};

bool has(std::string const& text, std::string const& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("every schedule renders the same picture, with table, report and pictures of it",
          "[command]") {
  std::string const backend(GENERATE(from_range(backends())));
  workplace const w;
  outcome const result = w.run({"-o", w.folder / "a.pfm", "--backend", backend, "--schedule", "all",
                                "--report", w.folder / "r.json", "--heatmap-sheet",
                                w.folder / "h.png", "--shader-ids", w.folder / "i.png"});
  CAPTURE(backend, result.out);
  std::string const count = std::to_string(schedules().size());
  CHECK(has(result.out, "\nShading: "));
  CHECK(has(result.out, "All " + count + " pictures are bit-identical.\n"));
  CHECK(read_bytes(w.folder / "a.pfm").size() == 40 * 20 * 12 + 14);
  json const report = json::parse(read_bytes(w.folder / "r.json"));
  CHECK(report["settings"]["backend"] == backend);
  REQUIRE(report["schedules"].size() == schedules().size());
  for (std::string_view const name : schedules())
    CHECK(has(result.out, "\n" + std::string(name) + " "));
  CHECK(read_png(w.folder / "h.png").height > 20 * static_cast<int>(schedules().size()));
  CHECK(read_png(w.folder / "i.png").height > 20);
  CHECK(w.folder.names() ==
        std::vector<std::string>{"a.pfm", "h.png", "i.png", "r.json", "scene.gltf"});
}

TEST_CASE("a list of schedules is rendered in its order", "[command]") {
  workplace const w;
  outcome const result = w.run({"-o", w.folder / "a.pfm", "--schedule", "window,implicit,local",
                                "--report", w.folder / "r.json"});
  json const report = json::parse(read_bytes(w.folder / "r.json"));
  REQUIRE(report["schedules"].size() == 3);
  CHECK(report["schedules"][0]["schedule"] == "window");
  CHECK(report["schedules"][1]["schedule"] == "implicit");
  CHECK(report["schedules"][2]["schedule"] == "local");
  auto const window = result.out.find("\nwindow "), local = result.out.find("\nlocal ");
  REQUIRE(local != std::string::npos);
  CHECK(window < local);
  CHECK_FALSE(has(result.out, "\nexplicit "));
  CHECK(has(result.out, "All 3 pictures are bit-identical.\n"));
  // A list of one is a single rendering.
  outcome const one = w.run({"-o", w.folder / "b.pfm", "--schedule", "window"});
  CHECK_FALSE(has(one.out, "bit-identical"));
  CHECK(read_bytes(w.folder / "a.pfm") == read_bytes(w.folder / "b.pfm"));
}

TEST_CASE("renderings are repeated round by round", "[command]") {
  workplace const w;
  outcome const result =
      w.run({"-o", w.folder / "a.pfm", "--schedule", "local,implicit", "--repeat", "3", "--report",
             w.folder / "r.json", "--trace", w.folder / "t.json"});
  json const report = json::parse(read_bytes(w.folder / "r.json"));
  REQUIRE(report["schedules"].size() == 6);
  for (std::size_t k = 0; k < 6; ++k) {
    CHECK(report["schedules"][k]["schedule"] == (k % 2 == 0 ? "local" : "implicit"));
    CHECK(report["schedules"][k]["repetition"] == k / 2 + 1);
  }
  CHECK(has(result.out, "Medians of 3 renderings"));
  CHECK(has(result.out, "All 6 pictures are bit-identical.\n"));
  CHECK(has(read_bytes(w.folder / "t.json"), "\"schedule local, repetition 3\""));
  // One schedule has a table if it is repeated.
  CHECK(has(w.run({"-o", w.folder / "a.pfm", "--repeat", "2", "-q"}).out, "Medians of 2"));
}

TEST_CASE("a warm-up comes before what is timed, and leaves nothing", "[command]") {
  workplace const w;
  std::string const picture = w.folder / "a.pfm", trace = w.folder / "t.json";
  CHECK_FALSE(has(w.run({"-o", picture}).err, "warm-up"));
  std::string const without = read_bytes(picture);
  CHECK(w.run({"-o", picture, "--report", w.folder / "r.json"}).err.rfind("warm-up ", 0) == 0);
  CHECK(read_bytes(picture) == without);
  outcome const both = w.run({"-o", picture, "--schedule", "implicit,local", "--trace", trace});
  CHECK(both.err.rfind("warm-up ", 0) == 0);
  CHECK(both.err.find("warm-up 100 %") < both.err.find("implicit "));
  CHECK(read_bytes(picture) == without);
  std::size_t processes = 0;
  json const events = json::parse(read_bytes(trace))["traceEvents"];
  for (json const& event : events) processes += event["name"] == "process_name";
  CHECK(processes == 2);
}

TEST_CASE("--explain renders nothing", "[command]") {
  workplace const w;
  for (std::vector<std::string> const& more :
       {std::vector<std::string>{},
        {"-q"},
        {"-o", w.folder / "none/a.png"},
        {"--repeat", "9"},
        {"--schedule", "all", "--report", w.folder / "r.json"}}) {
    std::vector<std::string> arguments = {"--explain"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    outcome const result = w.run(arguments);
    CHECK(result.out.rfind("The scene calls for\n", 0) == 0);
    CHECK(has(result.out, "It runs code for "));
    CHECK(has(result.out, "nothing is rendered.\n"));
    CHECK(result.err.empty());
    CHECK(w.folder.names() == std::vector<std::string>{"scene.gltf"});
  }
}

TEST_CASE("--quiet leaves the table and nothing else", "[command]") {
  workplace const w;
  outcome const one = w.run({"-o", w.folder / "a.png", "--quiet"});
  CHECK(one.out.empty());
  CHECK(one.err.empty());
  outcome const several = w.run({"-o", w.folder / "a.png", "-q", "--schedule", "implicit,local"});
  CHECK(several.out.rfind("times: ", 0) == 0);
  CHECK(has(several.out, "\nlocal "));
  CHECK(has(several.out, "bit-identical.\n"));
  CHECK_FALSE(has(several.out, "samples per pixel"));
  CHECK(several.err.empty());
}

TEST_CASE("--exposure is for PNG alone", "[command]") {
  workplace const w;
  w.run({"-o", w.folder / "plain.pfm"});
  w.run({"-o", w.folder / "bright.pfm", "--exposure", "2.5"});
  CHECK(read_bytes(w.folder / "plain.pfm") == read_bytes(w.folder / "bright.pfm"));
  auto const brightness = [&](std::string const& stops) {
    outcome const result =
        run_path_tracer({PATH_TRACER_SCENES "/box.gltf", "-o", w.folder / "a.png", "--width", "40",
                         "--height", "20", "--spp", "2", "--exposure", stops});
    CHECK(result.exit_code == 0);
    png_picture const read = read_png(w.folder / "a.png");
    REQUIRE(read.values.size() == 40 * 20 * 3);
    long sum = 0;
    for (int const value : read.values) sum += value;
    return sum;
  };
  CHECK(brightness("-2") < brightness("0"));
  CHECK(brightness("0") < brightness("+1.5"));
}
