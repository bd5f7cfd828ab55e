// SPDX-License-Identifier: Apache-2.0
// Light that surfaces emit, besides what they reflect, and pictures of it.
#include <cmath>
#include <vector>

#include "effects/scene_effects.hpp"
#include "machines.hpp"

using namespace path_tracer;

namespace {

/// A plane that fills the view from two units above it.
scene plane_of(material const& m) {
  scene s;
  s.materials = {m};
  add_quad(s, {-50, -50, 0}, {100, 0, 0}, {0, 100, 0}, 0);
  s.view.position = {0, 0, 2};
  s.view.tan_half_yfov = 0.3f;
  s.background = {0.3f, 0.4f, 0.5f};
  return s;
}

/// A floor below a square lamp, or the four squares of one, seen at one point.
scene below_lamp(std::vector<vec3> const& texels, bool textured, bool two_sided) {
  scene s;
  s.materials.resize(5);
  s.materials[0].base_color = vec3{0.8f};
  for (std::size_t k = 1; k < 5; ++k) {
    material& m = s.materials[k];
    m.emission = textured ? vec3{4} : 4.0f * texels[k - 1];
    m.base_color = vec3{0};
    m.kind = shader_of<effects::emitters>;
    m.two_sided = two_sided;
  }
  add_quad(s, {-50, -50, 0}, {100, 0, 0}, {0, 100, 0}, 0);
  if (textured) {
    material& m = s.materials[1];
    m.emissive_texture = 0;
    s.textures.resize(1);
    s.textures[0].width = s.textures[0].height = 2;
    s.textures[0].nearest = true;
    vec3 sum{0};
    for (vec3 const& c : texels) {
      auto const code = [](float v) { return static_cast<std::uint32_t>(v * 255 + 0.5f); };
      s.texels.push_back(code(c.x) | code(c.y) << 8 | code(c.z) << 16 | 0xff000000u);
      sum += c;
    }
    m.mean_emissive = sum / 4.0f;
    // u grows along y and v along x: seen from below, it emits downwards.
    add_quad(s, {-1, -1, 1}, {0, 2, 0}, {2, 0, 0}, 1);
  } else {
    for (int v = 0; v < 2; ++v)
      for (int u = 0; u < 2; ++u)
        add_quad(s, {float(v) - 1, float(u) - 1, 1}, {0, 1, 0}, {1, 0, 0},
                 static_cast<std::uint32_t>(1 + 2 * v + u));
  }
  s.view.position = {0.3f, -0.2f, 0.5f};
  s.view.tan_half_yfov = 1e-4f;
  return s;
}

}  // namespace

TEST_CASE("emission is added to what every material reflects", "[emission]") {
  std::string const machine = GENERATE(from_range(machines()));
  CAPTURE(machine);
  scene const all = room();
  for (std::size_t k = 0; k + 1 < shader_count; ++k) {
    if (k == number_of<effects::medium>) continue;
    material m = all.materials[k];
    m.emission = vec3{0};
    m.base_color_texture = m.metallic_roughness_texture = m.normal_texture = no_texture;
    scene s = plane_of(m);
    CAPTURE(k, effect_names()[k]);
    render_result const dark = render(s, small(4, 2, machine));
    for (float const strength : {1e-6f, 2.0f}) {
      s.materials[0].emission = strength * vec3{1, 2, 3};
      render_result const lit = render(s, small(4, 2, machine));
      std::size_t wrong = 0;
      for (std::size_t i = 0; i < lit.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c)
          wrong +=
              std::abs(lit.pixels[i][c] - dark.pixels[i][c] - s.materials[0].emission[c]) > 1e-5f
                  ? 1u
                  : 0u;
      CHECK(wrong == 0);
      CHECK(called_for(s)[number_of<effects::emitters>]);
    }
    leave_out_others(s, effect_bits().set().reset(number_of<effects::emitters>));
    CHECK(s.materials[0].emission == vec3{0});
  }
}

TEST_CASE("an emissive texture lights as the lamps that it shows", "[emission]") {
  std::string const machine = GENERATE(from_range(machines()));
  bool const two_sided = GENERATE(false, true);
  CAPTURE(machine, two_sided);
  std::vector<vec3> const texels = {{1, 0, 0}, {0, 0, 0}, {0.2f, 1, 0}, {0.4f, 0.6f, 1}};
  scene const four = below_lamp(texels, false, two_sided),
              one = below_lamp(texels, true, two_sided);
  render_result const expected = render(four, small(256, 2, machine));
  for (estimator const how : {estimator::mis, estimator::bsdf, estimator::light}) {
    render_settings settings = small(256, 2, machine);
    settings.accuracy.light = how;
    render_result const found = render(one, settings);
    for (int c = 0; c < 3; ++c) {
      glm::dvec2 const a = mean_and_error(expected, c), b = mean_and_error(found, c);
      CAPTURE(static_cast<int>(how), c, a.x, b.x);
      CHECK_THAT(b.x, WithinAbs(a.x, a.y + b.y));
      CHECK(b.y < 0.03);
    }
  }
  // And it is seen as it is.
  scene seen = one;
  seen.view.position = {0, 0, 0.5f};
  seen.view.forward = {0, 0, 1};
  seen.view.right = {0, 1, 0};
  seen.view.up = {1, 0, 0};
  seen.view.tan_half_yfov = 0.9f;
  render_settings settings = small(1, 1, machine);
  settings.width = settings.height = 2;
  render_result const picture = render(seen, settings);
  for (std::size_t i = 0; i < 4; ++i) {
    std::size_t const texel = i < 2 ? 2 + i : i - 2;  // up is along v
    for (int c = 0; c < 3; ++c)
      CHECK_THAT(picture.pixels[i][c], WithinAbs(4 * texels[texel][c], 0.02));
  }
}
