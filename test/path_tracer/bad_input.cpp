// SPDX-License-Identifier: Apache-2.0
// Command lines that are wrong (exit code 2) and files that cannot be written (exit code 1).
#include <algorithm>
#include <sstream>

#include "app/render.hpp"
#include "catch.hpp"
#include "path_tracer/fixture.hpp"
#include "path_tracer/process.hpp"

using namespace path_tracer_test;

namespace {

struct bad_command {
  std::vector<std::string> arguments;
  std::string words;
};

void check_refused(outcome const& result, int code, std::string const& words) {
  CAPTURE(result.err, words);
  CHECK(result.exit_code == code);
  CHECK(result.err.rfind("gltf_path_tracer: ", 0) == 0);
  CHECK(result.err.find('\n') == result.err.size() - 1);
  CHECK(result.err.find(words) != std::string::npos);
}

TEST_CASE("a wrong command line is refused in one line with exit code 2") {
  std::vector<bad_command> const cases = {
      {{}, "scene is required"},
      {{"a.gltf", "b.gltf"}, "b.gltf"},
      {{""}, "scene"},
      {{"a.gltf", "--bogus"}, "--bogus"},
      {{"a.gltf", "-x"}, "-x"},
      {{"a.gltf", "--width"}, "--width"},
      {{"a.gltf", "--width", "abc"}, "\"abc\" is not a whole number from 1 to"},
      {{"a.gltf", "--width", "0"}, "--width"},
      {{"a.gltf", "--width", "-5"}, "--width"},
      {{"a.gltf", "--width", "1.5"}, "\"1.5\" is not a whole number"},
      {{"a.gltf", "--width", "12px"}, "\"12px\" is not a whole number"},
      {{"a.gltf", "--width", "1000000"}, "from 1 to 16384"},
      {{"a.gltf", "--width", "4294967297"}, "from 1 to 16384"},
      {{"a.gltf", "--width", "99999999999999999999999"}, "from 1 to 16384"},
      {{"a.gltf", "--width", "8", "--width", "9"}, "--width"},
      {{"a.gltf", "--height", "0"}, "--height"},
      {{"a.gltf", "--height", "nan"}, "--height"},
      {{"a.gltf", "--width", "16384", "--height", "16384"}, "--width times --height"},
      {{"a.gltf", "--spp", "0"}, "--spp"},
      {{"a.gltf", "--spp", "1e3"}, "\"1e3\" is not a whole number"},
      {{"a.gltf", "--max-depth", "0"}, "--max-depth"},
      {{"a.gltf", "--max-depth", "100000"}, "--max-depth"},
      {{"a.gltf", "--seed", "-1"}, "--seed"},
      {{"a.gltf", "--seed", "18446744073709551616"}, "--seed"},
      {{"a.gltf", "--threads", "many"}, "--threads"},
      {{"a.gltf", "--threads", "5000"}, "from 0 to 1024"},
      {{"a.gltf", "--backend", "abacus"}, std::string(path_tracer::backends().front())},
      {{"a.gltf", "--schedule", "random"}, std::string(path_tracer::schedules().back())},
      {{"a.gltf", "--schedule", "ALL"}, "there is no \"ALL\""},
      {{"a.gltf", "--schedule", "local,chaos,sort"}, "there is no \"chaos\", only implicit"},
      {{"a.gltf", "--schedule", "local,"}, "there is no \"\""},
      {{"a.gltf", "--schedule", ""}, "there is no \"\""},
      {{"a.gltf", "--schedule", "local, window"}, "there is no \" window\""},
      {{"a.gltf", "--schedule", "local,window,local"}, "\"local\" is named twice"},
      {{"a.gltf", "--schedule", "local,all"}, "\"all\" is every one of them"},
      {{"a.gltf", "--schedule", "all,local"}, "\"all\" is every one of them"},
      {{"a.gltf", "--schedule", "all", "--schedule", "local"}, "--schedule"},
      {{"a.gltf", "--schedule"}, "--schedule"},
      {{"a.gltf", "--repeat", "0"}, "\"0\" is not a whole number from 1 to 1000"},
      {{"a.gltf", "--repeat", "-1"}, "--repeat"},
      {{"a.gltf", "--repeat", "1001"}, "from 1 to 1000"},
      {{"a.gltf", "--repeat", "2.5"}, "--repeat"},
      {{"a.gltf", "--repeat"}, "--repeat"},
      {{"a.gltf", "--exposure", "bright"}, "\"bright\" is not a number from -20 to 20"},
      {{"a.gltf", "--exposure", "20.5"}, "from -20 to 20"},
      {{"a.gltf", "--exposure", "-21"}, "from -20 to 20"},
      {{"a.gltf", "--exposure", "nan"}, "from -20 to 20"},
      {{"a.gltf", "--exposure", "0x1"}, "from -20 to 20"},
      {{"a.gltf", "--exposure", "1e"}, "from -20 to 20"},
      {{"a.gltf", "--exposure="}, "--exposure"},
      {{"a.gltf", "--exposure"}, "--exposure"},
      {{"a.gltf", "--explain=maybe"}, "--explain"},
      {{"a.gltf", "--heatmap-sheet"}, "--heatmap-sheet"},
      {{"a.gltf", "--heatmap-sheet="}, "--heatmap-sheet"},
      {{"a.gltf", "--heatmap-sheet", "folder/"}, "does not"},
      {{"a.gltf", "--shader-ids"}, "--shader-ids"},
      {{"a.gltf", "--shader-ids", "ids.jpg"}, "the name of a picture ends in .png"},
      {{"a.gltf", "-o", "a.png", "--heatmap-sheet", "a.png"}, "two pictures have the name a.png"},
      {{"a.gltf", "--shader-ids", "render.png"}, "two pictures have the name render.png"},
      {{"a.gltf", "--shader-ids", "b.png", "--heatmap-sheet", "b.png"}, "two pictures"},
      {{"a.gltf", "--estimator", "both"}, "there is no \"both\", only mis, bsdf, light"},
      {{"a.gltf", "--sums", "long"}, "there is no \"long\""},
      {{"a.gltf", "--roulette", "0"}, "--roulette"},
      {{"a.gltf", "--octaves", "17"}, "from 1 to 16"},
      {{"a.gltf", "-o", "picture.jpg"}, ".png"},
      {{"a.gltf", "-o", "picture"}, "does not"},
      {{"a.gltf", "--output="}, "--output"},
      {{"a.gltf", "--quiet=maybe"}, "--quiet"},
  };
  for (bad_command const& c : cases) {
    outcome const result = run_path_tracer(c.arguments);
    check_refused(result, 2, c.words);
    CHECK(result.out.empty());
  }
}

TEST_CASE("help and version go to standard output") {
  outcome const help = run_path_tracer({"--help"});
  CHECK(help.exit_code == 0);
  CHECK(help.err.empty());
  for (std::string_view const name : path_tracer::schedules())
    CHECK(help.out.find(name) != std::string::npos);
  for (char const* word :
       {"--output",        "--width",      "--height",  "--spp",      "--max-depth",
        "--seed",          "--backend",    "--threads", "--schedule", "--report",
        "--heatmap-sheet", "--shader-ids", "--repeat",  "--exposure", "--explain",
        "--trace",         "--quiet",      "--version", "[512]",      "Example"})
    CHECK(help.out.find(word) != std::string::npos);
  std::istringstream lines(help.out);
  for (std::string line; std::getline(lines, line);) CHECK(line.size() <= 80);
  outcome const version = run_path_tracer({"--version"});
  CHECK(version.exit_code == 0);
  CHECK(version.out.rfind("gltf_path_tracer ", 0) == 0);
}

/// A folder with a good scene in it, and the arguments to render that quickly.
struct workplace {
  temporary_folder folder;
  workplace() { write_bytes(folder / "scene.gltf", gltf_fixture().text()); }
  std::vector<std::string> arguments(std::vector<std::string> more) const {
    std::vector<std::string> result = {
        folder / "scene.gltf", "--width", "64", "--height", "64", "--spp", "1", "--quiet"};
    result.insert(result.end(), more.begin(), more.end());
    return result;
  }
};

TEST_CASE("an output that cannot be written is refused in one line with exit code 1") {
  workplace const w;
  std::filesystem::create_directory(w.folder / "folder.png");
  std::filesystem::create_symlink("/dev/full", w.folder / "full.png");
  std::filesystem::create_symlink("/dev/full", w.folder / "full.json");
  std::filesystem::create_symlink("/dev/full", w.folder / "full.pfm");
  auto const before = w.folder.names();
  std::string const good = w.folder / "good.png";
  std::vector<bad_command> const cases = {
      {{"-o", w.folder / "none/picture.png"}, "none/picture.png: No such file or directory"},
      {{"-o", w.folder / "scene.gltf/picture.png"}, "Not a directory"},
      {{"-o", w.folder / "folder.png"}, "folder.png: Is a directory"},
      {{"-o", w.folder / "full.png"}, "full.png: No space left on device"},
      {{"-o", w.folder / "full.pfm"}, "full.pfm: No space left on device"},
      {{"-o", "/proc/picture.png"}, "cannot write /proc/picture.png"},
      {{"-o", w.folder / (std::string(300, 'x') + ".png")}, "File name too long"},
      {{"-o", good, "--report", w.folder / "none/r.json"}, "none/r.json: No such file"},
      {{"-o", good, "--report", w.folder / "folder.png"}, "folder.png: Is a directory"},
      {{"-o", good, "--trace", w.folder / "none/t.json"}, "none/t.json: No such file"},
      {{"-o", good, "--trace", w.folder / "folder.png"}, "folder.png: Is a directory"},
      {{"-o", good, "--heatmap-sheet", w.folder / "none/h.png"}, "none/h.png: No such file"},
      {{"-o", good, "--heatmap-sheet", w.folder / "folder.png"}, "folder.png: Is a directory"},
      {{"-o", good, "--heatmap-sheet", "/proc/heat.png"}, "/proc/heat.png"},
      {{"-o", good, "--shader-ids", w.folder / "none/i.png"}, "none/i.png: No such file"},
      {{"-o", good, "--shader-ids", w.folder / "folder.png"}, "folder.png: Is a directory"},
  };
  for (bad_command const& c : cases) {
    check_refused(run_path_tracer(w.arguments(c.arguments)), 1, c.words);
    CHECK(w.folder.names() == before);
  }
  for (char const* option : {"--heatmap-sheet", "--shader-ids"})
    check_refused(run_path_tracer(w.arguments({"-o", good, option, w.folder / "full.png"})), 1,
                  "full.png: No space left on device");
  for (char const* option : {"--report", "--trace"})
    check_refused(run_path_tracer(w.arguments({"-o", good, option, w.folder / "full.json"})), 1,
                  "full.json: No space left on device");
}

TEST_CASE("a picture that does not fit on the disk leaves the older one as it was") {
  workplace const w;
  std::string const target = w.folder / "picture.pfm";
  write_bytes(target, "older");
  auto const before = w.folder.names();
  // No file may be larger than 8 blocks of 512 or 1024 bytes; the picture needs 48 KiB.
  std::vector<std::string> command = {"/bin/sh", "-c", "ulimit -f 8; trap '' XFSZ; exec \"$@\"",
                                      "sh", PATH_TRACER_EXECUTABLE};
  for (std::string const& a : w.arguments({"-o", target})) command.push_back(a);
  check_refused(run_program(command), 1, "picture.pfm: File too large");
  CHECK(read_bytes(target) == "older");
  CHECK(w.folder.names() == before);
}

TEST_CASE("a full standard output is an error") {
  outcome const result =
      run_program({"/bin/sh", "-c", "exec \"$0\" --help > /dev/full", PATH_TRACER_EXECUTABLE});
  check_refused(result, 1, "standard output");
}

TEST_CASE("what a scene holds and the picture leaves out is one warning line each") {
  workplace const w;
  gltf_fixture f;
  f.root["skins"] = json::array();
  f.root["materials"][0]["occlusionTexture"] = {{"index", 0}};
  write_bytes(w.folder / "scene.gltf", f.text());
  auto arguments = w.arguments({"-o", w.folder / "picture.png"});
  CHECK(run_path_tracer(arguments).err.empty());
  arguments.erase(std::find(arguments.begin(), arguments.end(), "--quiet"));
  outcome const result = run_path_tracer(arguments);
  CHECK(result.exit_code == 0);
  CHECK(result.err.find("gltf_path_tracer: warning: ") == 0);
  CHECK(result.err.find("\"skins\" is left out\n") != std::string::npos);
  CHECK(result.err.find("\"occlusionTexture\" (material 0 \"paint\") is left out\n") !=
        std::string::npos);
}

}  // namespace
