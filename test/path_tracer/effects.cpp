// SPDX-License-Identifier: Apache-2.0
// Which effects a scene calls for, which code runs for them, and that it changes no bit.
#include <algorithm>
#include <filesystem>
#include <string>

#include "effects/scene_effects.hpp"
#include "io/gltf.hpp"
#include "machines.hpp"
#include "render_support.hpp"

using namespace path_tracer;

namespace {

constexpr auto bit = [](auto effect) { return std::size_t{number_of<decltype(effect)>}; };

template <class... Effects>
effect_bits bits(Effects... effects) {
  effect_bits result;
  (result.set(bit(effects)), ...);
  return result;
}

/// A wall and a lamp, of which only the wall's material is given.
scene wall_and_lamp(material const& wall) {
  scene s;
  s.materials = {wall, material{}, material{}};
  s.material_names = {"wall", "lamp"};
  s.materials[1].emission = vec3{5};
  s.materials[1].specular = 0;
  for (material& m : s.materials) choose_shader(m, effect_bits().set());
  add_quad(s, {-3, -3, -2}, {6, 0, 0}, {0, 6, 0}, 0);
  add_quad(s, {-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, 1);
  s.view.tan_half_yfov = 0.5f;
  return s;
}

material matte() {
  material m;
  m.specular = 0;
  return m;
}

}  // namespace

TEST_CASE("effects have names, and lists of them are read", "[effects]") {
  auto const names = effect_names();
  REQUIRE(names.size() == effect_count);
  for (std::size_t k = 0; k < names.size(); ++k) {
    effect_bits const one = effects_named(names[k]);
    CHECK(one.count() == 1);
    CHECK(one[k]);
    CHECK(join_names(one) == names[k]);
  }
  CHECK(effects_named("matte,sheen") == bits(effects::matte{}, effects::sheen{}));
  for (char const* wrong : {"", "mat", "matte,", ",matte", "matte, sheen", "MATTE"}) {
    CAPTURE(wrong);
    CHECK_THROWS_AS(effects_named(wrong), std::invalid_argument);
  }
  CHECK_THROWS_WITH(effects_named("satin"),
                    "there is no effect \"satin\", only " + join_names(effect_bits().set()));
}

TEST_CASE("a scene calls for what its materials, lights and camera have", "[effects]") {
  auto const base = bits(effects::matte{}, effects::emitters{});
  scene s = wall_and_lamp(matte());
  CHECK(called_for(s) == base);
  SECTION("not for materials that no triangle has") {
    s.materials[2].kind = shader_of<effects::clearcoat>;
    CHECK(called_for(s) == base);
  }
  SECTION("lights") {
    s.lights.resize(1);
    CHECK(called_for(s) == (base | bits(effects::punctual_lights{})));
  }
  SECTION("a lens") {
    s.view.aperture_radius = 0.1f;
    CHECK(called_for(s) == (base | bits(effects::depth_of_field{})));
    s.view.ortho_height = 1;
    CHECK(called_for(s) == base);
  }
  SECTION("glass that takes up and bends colours") {
    material m = matte();
    m.transmission = 1;
    m.dispersion = 1;
    m.thickness = 1;
    m.attenuation_distance = 1;
    m.attenuation_color = vec3{0.5f};
    auto const called = called_for(wall_and_lamp(m));
    CHECK(called == bits(effects::emitters{}, effects::rough_glass{}, effects::dispersion{},
                         effects::absorption{}));
    m.transmission = 0;
    CHECK(called_for(wall_and_lamp(m)) == base);
  }
  SECTION("fog, a sky, a texture, motion") {
    s.medium_absorption = vec3{0.1f};
    s.sky = {1, 1, {vec3{1}}};
    s.materials[0].normal_texture = 0;
    s.motion.resize(s.triangles.size());
    CHECK(called_for(s) == (base | bits(effects::medium{}, effects::environment{},
                                        effects::normal_maps{}, effects::motion_blur{})));
  }
}

TEST_CASE("the smallest declared set that covers the scene runs", "[effects]") {
  auto const base = bits(effects::matte{}, effects::emitters{});
  CHECK(effects_of_variant(variant_for(base)) == base);
  CHECK(effects_of_variant(variant_for(bits(effects::matte{}))) == base);
  CHECK(effects_of_variant(variant_for(base | bits(effects::medium{}))).all());
  std::size_t const larger = variant_for(base | bits(effects::sheen{}));
  CHECK(larger != variant_for(base));
  CHECK_FALSE(effects_of_variant(larger).all());
  CHECK(effects_of_variant(larger)[number_of<effects::sheen>]);
  CHECK(effects_of_variant(~std::size_t{0}).all());
}

TEST_CASE("code that lacks an effect refuses the scene", "[effects]") {
  scene s = wall_and_lamp(matte());
  render_settings settings = small(1, 2);
  specialize(settings, s);
  s.lights.resize(1);
  CHECK_THROWS_WITH(render(s, settings),
                    "the variant has no code for punctual-lights, which the scene calls for");
  s.lights.clear();
  settings.expected.reset(number_of<effects::matte>);
  CHECK_THROWS_WITH(render(s, settings), "a shader is not expected that the scene calls for");
}

TEST_CASE("an effect that is left out is gone from the scene", "[effects]") {
  scene s = room();
  auto const kept = bits(effects::matte{}, effects::plastic{}, effects::emitters{});
  leave_out_others(s, kept);
  CHECK((called_for(s) & ~kept).none());
  CHECK(s.lights.empty());
  CHECK(s.sky.texels.empty());
  CHECK(s.materials[0].base_color_texture == no_texture);
  render_settings settings = small(1, 4);
  specialize(settings, s);
  CHECK(render(s, settings).discarded_samples == 0);
}

TEST_CASE("code for the effects of a scene gives the bits of code for all", "[effects]") {
  std::string const machine = GENERATE(from_range(machines()));
  CAPTURE(machine);
  auto const check = [&](scene const& s, std::string const& name) {
    render_settings settings = small(2, 8, machine);
    auto const all = render(s, settings);
    CHECK(all.discarded_samples == 0);
    specialize(settings, s);
    CAPTURE(name, explain(s, settings.variant));
    for (char const* schedule : {"local", "explicit", "compact+explicit"}) {
      CAPTURE(schedule);
      settings.schedule = schedule;
      CHECK(same_bits(all, render(s, settings)));
    }
  };
  material shiny = matte();
  shiny.clearcoat = 1;
  check(wall_and_lamp(matte()), "matte");
  check(wall_and_lamp(shiny), "clearcoat");
  check(room(), "room");
  std::filesystem::path const scenes = PATH_TRACER_SCENES;
  for (auto const& entry : std::filesystem::recursive_directory_iterator(scenes))
    if (entry.path().extension() == ".gltf")
      check(load_gltf(entry.path().string()), entry.path().filename().string());
}

TEST_CASE("the explanation says who calls for what", "[effects]") {
  scene s = wall_and_lamp(matte());
  s.view.aperture_radius = 0.1f;
  s.lights.resize(2);
  s.light_names = {"sun", ""};
  s.sky.texels = {vec3{1}};
  s.environment_file = "sky.hdr";
  std::string const text = explain(s, variant_for(called_for(s)));
  CAPTURE(text);
  CHECK(text.find("  emitters         material 1 \"lamp\"\n") != std::string::npos);
  CHECK(text.find("  depth-of-field   the camera\n") != std::string::npos);
  CHECK(text.find("  punctual-lights  light 0 \"sun\" and 1 more\n") != std::string::npos);
  CHECK(text.find("  environment      the environment \"sky.hdr\"\n") != std::string::npos);
  CHECK(text.find("It runs code for all effects\n") != std::string::npos);
  s.lights = {s.lights[0]};
  s.light_names.clear();
  CHECK(explain(s, 2).find("  punctual-lights  light 0\n") != std::string::npos);
  s.lights.clear();
  s.sky = environment_map{};
  s.view.aperture_radius = 0;
  std::string const less = explain(s, variant_for(called_for(s)));
  CAPTURE(less);
  CHECK(less.find("It runs code for emitters, matte\n") != std::string::npos);
  CHECK(less.find("Left out: marble, ") != std::string::npos);
}
