// SPDX-License-Identifier: Apache-2.0
// What the backends have in common, and what a GPU may do otherwise.
#include <algorithm>
#include <cmath>

#include "io/gltf.hpp"
#include "machines.hpp"
#include "path_tracer/process.hpp"

using namespace path_tracer;
using namespace path_tracer_test;

namespace {

scene gallery() { return load_gltf(std::string(PATH_TRACER_SCENES) + "/gallery.gltf"); }

TEST_CASE("the gallery has the same bits by every schedule of a machine") {
  check_same_bits(gallery(), small(2, 16), {2});
}

TEST_CASE("all machines render one picture, up to the rounding of a few functions") {
  scene const s = gallery();
  render_settings settings = small(4, 16);
  settings.width = 128;
  settings.height = 72;
  render_result const reference = render(s, settings);
  for (std::string const& machine : machines()) {
    CAPTURE(machine);
    settings.backend = machine;
    settings.seed = 1;
    render_result const result = render(s, settings);
    likeness const same = compare(reference, result);
    CAPTURE(same.same_pixels, same.mean_ratio);
    CHECK(same.same_pixels >= 0.995);
    CHECK_THAT(same.mean_ratio, WithinAbs(1, 0.002));
    auto const rays = static_cast<double>(reference.rays);
    CHECK_THAT(static_cast<double>(result.rays), WithinRel(rays, 0.001));
    // Other random numbers make another picture: the bounds above mean something.
    settings.seed = 2;
    CHECK(compare(reference, render(s, settings)).same_pixels < 0.5);
  }
}

TEST_CASE("a GPU that is not there is an error of one line") {
  temporary_folder const folder;
  write_bytes(folder / "scene.gltf", gltf_fixture().text());
  outcome const result =
      run_program({"/usr/bin/env", "CUDA_VISIBLE_DEVICES=", PATH_TRACER_EXECUTABLE,
                   folder / "scene.gltf", "-o", folder / "a.png", "--backend", "cuda", "-q"});
  CAPTURE(result.err);
  auto const names = backends();
  bool const has_cuda = std::find(names.begin(), names.end(), "cuda") != names.end();
  CHECK(result.exit_code == (has_cuda ? 1 : 2));
  CHECK(result.err.rfind("gltf_path_tracer: ", 0) == 0);
  CHECK(result.err.find('\n') == result.err.size() - 1);
  CHECK(result.err.find(has_cuda ? "CUDA" : "there is no \"cuda\"") != std::string::npos);
  CHECK(folder.names() == std::vector<std::string>{"scene.gltf"});
}

}  // namespace
