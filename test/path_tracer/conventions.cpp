// SPDX-License-Identifier: Apache-2.0
// Conventions of glTF and of estimators that a picture shows only to those who know what is right:
// senses, channels, factors and weights, each by one hit.
#include <cmath>
#include <vector>

#include "catch.hpp"
#include "hard_support.hpp"
#include "shading/scattering.hpp"
#include "shading/shaders.hpp"

using namespace path_tracer;

namespace {

/// A triangle in the plane z = 0 with one material, its textures, and a path that meets it.
struct one_hit {
  material m;
  triangle t{};
  std::vector<texture> textures = std::vector<texture>(1);
  std::vector<std::uint32_t> texels = {0xff8040c0u};
  std::vector<real> linear = std::vector<real>(256);
  scene_view view{};

  /// u runs along +x, and v along `v_along`.
  explicit one_hit(vec2 v_along = {0, -1}) {
    vec2 const corners[3] = {{0, 0}, {1, 0}, {0, 1}};
    for (int k = 0; k < 3; ++k) {
      t.position[k] = {corners[k].x, corners[k].y, 0};
      t.normal[k] = {0, 0, 1};
      t.uv[k] = {corners[k].x, corners[k].y * v_along.y};
    }
    textures[0].width = textures[0].height = 1;
  }
  surface seen(vec3 direction = {0, 0, -1}) {
    view.materials = &m;
    view.textures = {textures.data(), texels.data(), linear.data()};
    view.tables = &host_albedo_tables();
    return load_surface<every_effect>(view, t, {0.25f, 0.25f}, direction);
  }
};

/// One path of a batch.
struct one_path {
  vec3 origin{0}, shadow_origin{0}, shadow_vector{0};
  stored_direction direction = vec3{0, 0, -1};
  stored_color throughput = vec3{1}, radiance = vec3{0}, shadow_light = vec3{0};
  real pdf = 0, passed = 0;

  void put_into(batch_view<every_effect>& b, std::uint64_t seed) {
    static_cast<path_array<effects::smooth_glass, every_effect>&>(b).states = &passed;
    b.origin = &origin;
    b.shadow_origin = &shadow_origin;
    b.shadow_vector = &shadow_vector;
    b.direction = &direction;
    b.throughput = &throughput;
    b.radiance = &radiance;
    b.shadow_light = &shadow_light;
    b.pdf = &pdf;
    b.seed = seed;
    b.pixels = 1;
    b.max_depth = 100;
    b.roulette_from = 1;
  }
};

}  // namespace

TEST_CASE("anisotropy turns counter-clockwise from u towards where an image is up",
          "[conventions]") {
  for (float const v : {-1.0f, 1.0f})  // as glTF's images lie; mirrored
    for (float const turn : {0.5f, -1.0f}) {
      one_hit hit({0, v});
      hit.m.metallic = 1;
      hit.m.roughness = 0.3f;
      hit.m.anisotropy = 0.8f;
      hit.m.anisotropy_rotation = turn;
      surface const s = hit.seen();
      shading_point<every_effect> const point(hit.view, s, hit.t);
      auto const bsdf = effects::anisotropy::bsdf(point);
      // Wide along its direction, whose angle from +x is that one; up is against v.
      auto const light = [&](float angle) {
        return bsdf.value(s.wo, s.to_local(polar(std::cos(0.8f), angle))).f_cos.x;
      };
      CAPTURE(v, turn);
      float const along = light(-v * turn), other = light(v * turn);
      CHECK(along > 2 * other);
      CHECK(along > light(-v * turn + 0.2f));
      CHECK(along > light(-v * turn - 0.2f));
    }
}

TEST_CASE("roughness is read from green and metal from blue", "[conventions]") {
  one_hit hit;
  hit.m.metallic = 0.5f;
  hit.m.roughness = 0.75f;
  hit.m.metallic_roughness_texture = 0;
  surface const s = hit.seen();
  shading_point<every_effect> const point(hit.view, s, hit.t);
  auto const p = point.plastic_parameters(vec3{1});
  CHECK_THAT(p.roughness, WithinRel(0.75f * 0x40 / 255, 1e-6f));
  CHECK_THAT(p.metallic, WithinRel(0.5f * 0x80 / 255, 1e-6f));
}

TEST_CASE("the scale of a normal texture is that of x and y", "[conventions]") {
  for (float const scale : {0.0f, 0.5f, 1.0f, 2.0f}) {
    one_hit hit;
    hit.m.normal_texture = 0;
    hit.m.normal_scale = scale;
    glm::dvec3 const texel(2 * 0xc0 / 255.0 - 1, 2 * 0x40 / 255.0 - 1, 2 * 0x80 / 255.0 - 1);
    double const k = double{scale};
    glm::dvec3 const expected = glm::normalize(glm::dvec3(k * texel.x, k * texel.y, texel.z));
    // In the tangent space of glTF: x along u, y against v, which here are the axes.
    vec3 const found =
        mapped_normal((hit.seen(), hit.view), hit.t, hit.m, {0.25f, -0.25f}, vec3{0, 0, 1});
    CAPTURE(scale, found.x, found.y, found.z);
    for (int c = 0; c < 3; ++c) CHECK_THAT(double{found[c]}, WithinAbs(expected[c], 1e-6));
  }
}

TEST_CASE("a path that survives roulette has the weight of those that did not", "[conventions]") {
  vec3 const color{0.5f, 0.25f, 0.125f};
  int survived = 0, in_fog = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    one_hit hit;
    surface const s = hit.seen();
    one_path path;
    batch_view<every_effect> batch{};
    path.put_into(batch, seed);
    extend_path(batch, 0, s, bsdf_matte{color});
    vec3 const left = path.throughput;
    CAPTURE(seed);
    if (left != vec3{0}) {
      ++survived;
      for (int c = 0; c < 3; ++c) REQUIRE_THAT(left[c], WithinRel(2 * color[c], 1e-5f));
    }
    one_path scattered;
    scattered.throughput = color;
    batch_view<every_effect> all{};
    scattered.put_into(all, seed);
    surface_shader<effects::medium, every_effect>{all, hit.view}(0);
    vec3 const rest = scattered.throughput;
    if (rest == vec3{0}) continue;
    ++in_fog;
    for (int c = 0; c < 3; ++c) REQUIRE_THAT(rest[c], WithinRel(2 * color[c], 1e-5f));
  }
  CHECK_THAT(survived / 400.0, WithinAbs(0.5, 0.1));
  CHECK_THAT(in_fog / 400.0, WithinAbs(0.5, 0.1));
}

TEST_CASE("corners and normals of a moving triangle go in straight lines", "[conventions]") {
  std::uint64_t const seed = 681;
  fine_numbers n(seed);
  for (int i = 0; i < 1000; ++i) {
    triangle t{};
    triangle_motion motion{};
    for (int k = 0; k < 3; ++k) {
      t.position[k] = vec3(3.0 * n.on_sphere());
      motion.position[k] = vec3(3.0 * n.on_sphere());
      t.normal[k] = vec3(n.on_sphere());
      motion.normal[k] = vec3(n.on_sphere());
    }
    double const time = n.uniform();
    triangle const at = triangle_at(t, motion, static_cast<float>(time));
    CAPTURE(seed, i, time);
    for (int k = 0; k < 3; ++k) {
      glm::dvec3 const p =
          glm::mix(glm::dvec3(t.position[k]), glm::dvec3(motion.position[k]), time);
      glm::dvec3 const m = glm::mix(glm::dvec3(t.normal[k]), glm::dvec3(motion.normal[k]), time);
      REQUIRE(glm::length(glm::dvec3(at.position[k]) - p) < 1e-5);
      REQUIRE(glm::length(glm::dvec3(at.normal[k]) - m) < 1e-5);
    }
  }
}
