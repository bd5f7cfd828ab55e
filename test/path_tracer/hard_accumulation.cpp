// SPDX-License-Identifier: Apache-2.0
// Sums of many samples, throughput next to nothing, and counts over many threads.
#include <cmath>
#include <vector>

#include "hard_support.hpp"
#include "machines.hpp"
#include "shading/scattering.hpp"
#include "shading/stages.hpp"

using namespace path_tracer;

namespace {

/// A batch of one path that the host runs shader by shader.
struct lone_path {
  vec3 vectors[7] = {};
  float pdf = 0, wavelength = 0, passed = 0;
  std::uint32_t primitive = 0;
  vec2 barycentric{0};
  std::uint8_t id = finished;
  batch_view<every_effect> batch{};

  lone_path() {
    batch.origin = &vectors[0];
    batch.direction = &vectors[1];
    batch.throughput = &vectors[2];
    batch.radiance = &vectors[3];
    batch.shadow_origin = &vectors[4];
    batch.shadow_vector = &vectors[5];
    batch.shadow_light = &vectors[6];
    batch.pdf = &pdf;
    batch.primitive = &primitive;
    batch.barycentric = &barycentric;
    batch.id = &id;
    batch.pixels = 1;
    batch.max_depth = batch.roulette_from = 1u << 30;
    static_cast<path_array<effects::dispersion, every_effect>&>(batch).states = &wavelength;
    static_cast<path_array<effects::smooth_glass, every_effect>&>(batch).states = &passed;
  }
};

}  // namespace

TEST_CASE("the mean of ten million samples is right to the last digit of a float", "[hard]") {
  std::uint64_t const seed = 631;
  fine_numbers n(seed);
  // Of mean about 1; multiples of 2^-23, so that their sum is exact in 64 bits of an integer.
  std::uint32_t const paths = 100000, batches = 100;
  std::vector<vec3> radiance(paths);
  std::uint64_t exact = 0;
  for (vec3& r : radiance) {
    auto const steps = static_cast<std::uint32_t>(n.uniform() * 0x1p24);
    exact += steps;
    r = vec3{static_cast<float>(steps) * 0x1p-23f};
  }
  basic_batch batch{};
  batch.radiance = radiance.data();
  batch.pixels = 1;
  using sum_type = pixel_sum<summation::in_double>;
  sum_type sum;
  for (std::uint32_t k = 0; k < batches; ++k) accumulate_samples<sum_type>{batch, paths, &sum}(0);
  CAPTURE(seed);
  CHECK_THAT(double{static_cast<float>(sum.total.x / (double{paths} * batches))},
             WithinRel(static_cast<double>(exact) * 0x1p-23 / paths, 6.1e-8));
}

TEST_CASE("ten million samples of a render lose less than 1e-5", "[hard]") {
  std::string const machine = GENERATE(from_range(machines()));
  CAPTURE(machine);
  scene s;
  s.background = {1, 1.1f, 0.1f};
  render_settings settings = small(10000000, 1, machine);
  settings.width = settings.height = 1;
  render_result const r = render(s, settings);
  CHECK(r.discarded_samples == 0);
  for (int c = 0; c < 3; ++c) CHECK_THAT(r.pixels[0][c], WithinRel(s.background[c], 1e-7f));
}

TEST_CASE("throughput next to nothing goes a thousand bounces without a trap", "[hard]") {
  // In a closed box with a lamp. The bounce is held at 0, no roulette ends the path, and the
  // seed changes instead.
  for (float const albedo : {1.0f, 0.93f, 0.5f, 1e-3f})
    for (auto const kind : {shader_of<effects::matte>, shader_of<effects::plastic>,
                            shader_of<effects::metal>, shader_of<effects::smooth_glass>}) {
      scene s;
      s.materials.resize(2);
      s.materials[0].kind = kind;
      s.materials[0].base_color = vec3{albedo};
      s.materials[0].metallic = kind == shader_of<effects::metal> ? 1.0f : 0.0f;
      s.materials[0].transmission = 1;
      s.materials[1].kind = shader_of<effects::emitters>;
      s.materials[1].emission = vec3{1e4f};
      add_box(s, {0, 0, 0}, vec3{1}, 0, kind != shader_of<effects::smooth_glass>);
      add_quad(s, {-0.1f, 0.9f, -0.1f}, {0.2f, 0, 0}, {0, 0, 0.2f}, 1);
      bvh const tree = build_bvh(s.triangles);
      light_list const lights(s);
      scene_view view{};
      view.bvh = tree.view();
      view.triangles = s.triangles.data();
      view.materials = s.materials.data();
      view.lights = lights.view(s);
      view.tables = &host_albedo_tables();
      lone_path path;
      *path.batch.origin = {0.1f, 0, 0.2f};
      *path.batch.direction = glm::normalize(vec3{1, 0.7f, -0.4f});
      *path.batch.throughput = vec3{1e-30f, 1, 1};
      int bounce = 0;
      for (; bounce < 1000; ++bounce) {
        path.batch.seed = static_cast<std::uint64_t>(bounce);
        find_hits<every_effect>{path.batch, view}(0);
        if (path.id == finished) break;
        float const before = path.batch.throughput->x;
        CAPTURE(albedo, static_cast<int>(kind), bounce, before);
        if (path.id == static_cast<std::uint8_t>(miss)) break;  // out of the glass
        for_each_effect(all_effects{}, [&](auto effect) {
          using type = decltype(effect);
          if constexpr (detail::has_shader<type>)
            if (path.id == static_cast<std::uint8_t>(shader_of<type>))
              surface_shader<type, every_effect>{path.batch, view}(0);
        });
        trace_shadows<every_effect>{path.batch, view}(0);
        REQUIRE(path.batch.throughput->x >= 0);
        REQUIRE(path.batch.throughput->x <= before * 2);
        REQUIRE(is_finite(*path.batch.throughput));
        REQUIRE(is_finite(*path.batch.radiance));
        REQUIRE(path.batch.radiance->x >= 0);
      }
      // What stays above the least float arrives; what does not ends the path, or never gets out.
      CAPTURE(albedo, static_cast<int>(kind));
      if (albedo == 1 && kind == shader_of<effects::matte>) CHECK(bounce == 1000);
      if (albedo == 1e-3f && kind == shader_of<effects::matte>) CHECK(bounce < 100);
    }
}

TEST_CASE("counts of rays and requests are exact over threads and batches", "[hard]") {
  // A closed white box of depth 3: every path lives for three bounces, in several batches.
  material wall;
  wall.kind = shader_of<effects::matte>;
  wall.base_color = vec3{1};
  scene s = box_of(wall);
  s.lights.resize(1);
  s.lights[0].position = {0.1f, 0.2f, 0.3f};
  s.lights[0].intensity = vec3{1};
  for (auto const backend : backends())
    for (unsigned const threads : {1u, 3u}) {
      render_settings settings = small(300, 3, std::string(backend));
      settings.threads = threads;
      settings.statistics = true;
      std::uint64_t const paths = std::uint64_t{settings.width} * settings.height * 300;
      render_result const r = render(s, settings);
      CAPTURE(backend, threads);
      CHECK(r.discarded_samples == 0);
      REQUIRE(r.bounces.size() == 3);
      // The walls are one shader: all lanes work, and each path has a shadow ray at the first two.
      for (bounce const& b : r.bounces) {
        CHECK(b.requests == paths);
        CHECK(b.efficiency == 1);
      }
      CHECK(r.rays == 5 * paths);
    }
}
