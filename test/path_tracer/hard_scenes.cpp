// SPDX-License-Identifier: Apache-2.0
// Every pixel of every scene is a number.
#include <cmath>
#include <filesystem>
#include <glm/gtc/quaternion.hpp>

#include "fixture.hpp"
#include "hard_support.hpp"
#include "io/gltf.hpp"
#include "machines.hpp"
#include "scene/surface.hpp"

using namespace path_tracer;

namespace {

void check_picture(scene const& s, std::string const& name, render_settings const& settings) {
  CAPTURE(name, settings.backend);
  render_result const r = render(s, settings);
  CHECK(r.discarded_samples == 0);
  std::size_t good = 0;
  for (vec3 const& p : r.pixels)
    for (int c = 0; c < 3; ++c) good += std::isfinite(p[c]) && p[c] >= 0 ? 1u : 0u;
  CHECK(good == 3 * r.pixels.size());
}

}  // namespace

TEST_CASE("no pixel of any scene is not a number, and no sample is discarded", "[hard]") {
  std::string const machine = GENERATE(from_range(machines()));
  int scenes = 0;
  for (char const* const folder : {PATH_TRACER_SCENES, DEFERRED_SHADE_SHARED_SCENES}) {
    if (!std::filesystem::exists(folder)) {
      WARN("skipped: there is no " << folder);
      continue;
    }
    for (auto const& entry : std::filesystem::recursive_directory_iterator(folder)) {
      std::string const ending = entry.path().extension().string();
      if (ending != ".gltf" && ending != ".glb") continue;
      check_picture(load_gltf(entry.path().string()), entry.path().filename().string(),
                    small(8, 32, machine));
      ++scenes;
    }
  }
  CHECK(scenes > 10);
  check_picture(room(), "room", small(32, 32, machine));
}

TEST_CASE("a furnace has the same radiance whatever its size and place", "[hard]") {
  std::string const machine = GENERATE(from_range(machines()));
  CAPTURE(machine);
  // Walls that emit E and reflect a share a: everywhere E / (1 - a), also in corners.
  double const e = 0.7, a = 0.6;
  for (double const size : {1e-4, 1.0, 1e6})
    for (double const away : {0.0, 1.0, 1e3, 1e6}) {
      if (away > size * 1e4) continue;
      material wall;
      wall.kind = shader_of<effects::emitters>;
      wall.emission = vec3{static_cast<float>(e)};
      wall.base_color = vec3{static_cast<float>(a)};
      scene s;
      s.materials = {wall};
      s.triangles = ball({0, 0, 0}, size, 1);
      for (triangle& t : s.triangles)  // turned inside out, with flat shading
        for (int k = 0; k < 3; ++k) t.normal[k] = vec3{0};
      for (triangle& t : s.triangles) std::swap(t.position[1], t.position[2]);
      s.view.position = vec3{static_cast<float>(0.1 * size)};
      CAPTURE(size, away);
      render_result const r =
          render(moved_by(s, away * glm::dvec3(1, -0.5, 0.25)), small(16, 60, machine));
      glm::dvec2 const mean = mean_and_error(r);
      CAPTURE(mean.x, mean.y);
      CHECK(r.discarded_samples == 0);
      CHECK_THAT(mean.x, WithinAbs(e / (1 - a), mean.y));
      CHECK(mean.y < 0.1);
    }
}

TEST_CASE("meshes with negative and very uneven scale keep their shape and their outside",
          "[hard]") {
  // The plane of each triangle, against the transform of its corners in double; and which side is
  // outside, which a mirror image turns over.
  path_tracer_test::gltf_fixture f;
  std::vector<triangle> const original = [&] {
    path_tracer_test::temporary_folder const folder;
    path_tracer_test::write_bytes(folder / "a.gltf", f.text());
    return load_gltf(folder / "a.gltf").triangles;
  }();
  REQUIRE(original.size() == 1);
  glm::dquat const turn = glm::normalize(glm::dquat(0.3, 0.5, -0.2, 0.7));
  for (glm::dvec3 const scale :
       {glm::dvec3(-1, 1, 1), glm::dvec3(-1, -1, -1), glm::dvec3(1e-4, 1, 1e4),
        glm::dvec3(1e-6, -1e3, 1), glm::dvec3(-1e5, 1e-3, -1e-5), glm::dvec3(1e-4)}) {
    CAPTURE(scale.x, scale.y, scale.z);
    f.at("/nodes/1")["scale"] = {scale.x, scale.y, scale.z};
    f.at("/nodes/1")["rotation"] = {turn.x, turn.y, turn.z, turn.w};
    path_tracer_test::temporary_folder const folder;
    path_tracer_test::write_bytes(folder / "a.gltf", f.text());
    scene const s = load_gltf(folder / "a.gltf");
    REQUIRE(s.triangles.size() == 1);
    triangle const& t = s.triangles[0];
    glm::dvec3 corners[3];
    for (int k = 0; k < 3; ++k) corners[k] = turn * (scale * glm::dvec3(original[0].position[k]));
    // As seen from the front, with corners to the left; the file's normals are along its z.
    bool const mirrored = scale.x * scale.y * scale.z < 0;
    glm::dvec3 const outside =
        glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0])) *
        (mirrored ? -1.0 : 1.0);
    double const size = std::max(glm::length(corners[1]), glm::length(corners[2]));
    for (int k = 0; k < 3; ++k) {
      double nearest = INFINITY;
      for (glm::dvec3 const& c : corners)
        nearest = std::min(nearest, glm::length(glm::dvec3(t.position[k]) - c));
      CHECK(nearest < 1e-6 * size);
      CHECK(glm::length(glm::dvec3(t.normal[k]) -
                        glm::normalize(turn * (glm::dvec3(original[0].normal[k]) / scale))) < 1e-6);
    }
    CHECK(glm::dot(glm::dvec3(geometric_normal(t)), outside) > 0.999);
    CHECK(glm::dot(glm::dvec3(t.normal[0]), outside) > 0.999);
    // Light from outside, along its normal, meets it from the front; of one thinner than a float's
    // last place of its length there is nothing to meet.
    if (std::min(glm::length(corners[1]), glm::length(corners[2])) < 1e-5 * size) continue;
    bvh const tree = build_bvh(s.triangles);
    vec3 const middle = (t.position[0] + t.position[1] + t.position[2]) / 3.0f;
    vec3 const from = middle + vec3(size * outside);
    hit const h = closest_hit(tree.view(), {from, middle - from, INFINITY});
    REQUIRE(h.primitive == 0);
    CHECK_THAT(h.t, WithinRel(1.0f, 1e-4f));
    CHECK(glm::dot(geometric_normal(t), middle - from) < 0);
  }
}
