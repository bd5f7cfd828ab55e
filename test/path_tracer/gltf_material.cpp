// SPDX-License-Identifier: Apache-2.0
// Materials, textures and warnings as the loader leaves them, and whole scenes.
#include <algorithm>
#include <set>

#include "catch.hpp"
#include "path_tracer/load.hpp"

using namespace path_tracer;
using namespace path_tracer_test;

namespace {

material load_material(char const* text) {
  gltf_fixture f;
  f.at("/materials/0") = json::parse(text);
  return load(f).materials.at(0);
}

shader kind(std::string const& metallic, std::string const& roughness, std::string const& rest) {
  return load_material((R"({"pbrMetallicRoughness": {"metallicFactor": )" + metallic +
                        R"(, "roughnessFactor": )" + roughness + "}" + rest + "}")
                           .c_str())
      .kind;
}

bool warns(scene const& s, std::string const& words) {
  return std::count_if(s.warnings.begin(), s.warnings.end(), [&](std::string const& w) {
           return w.find(words) != std::string::npos;
         }) == 1;
}

TEST_CASE("a material runs the shader that fits it") {
  std::string const specular0 =
      R"(, "extensions": {"KHR_materials_specular": {"specularFactor": 0}})";
  std::string const glass =
      R"(, "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}})";
  std::string const coat =
      R"(, "extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 0.5}})";
  std::string const sheen =
      R"(, "extensions": {"KHR_materials_sheen": {"sheenColorFactor": [0, 0.5, 0]}})";
  CHECK(kind("0", "1", "") == shader_of<effects::plastic>);
  CHECK(kind("0.5", "1", "") == shader_of<effects::plastic>);
  CHECK(kind("0.5", "1", specular0) == shader_of<effects::plastic>);
  CHECK(kind("0", "1", specular0) == shader_of<effects::matte>);
  CHECK(kind("1", "0.3", "") == shader_of<effects::metal>);
  CHECK(kind("1", "0.3", specular0) == shader_of<effects::metal>);
  CHECK(kind("0", "0", glass) == shader_of<effects::smooth_glass>);
  CHECK(kind("0", "0.02", glass) == shader_of<effects::smooth_glass>);
  CHECK(kind("0", "0.03", glass) == shader_of<effects::rough_glass>);
  CHECK(kind("1", "0.3", glass) == shader_of<effects::metal>);
  CHECK(kind("0.6", "0.5", coat) == shader_of<effects::clearcoat>);
  CHECK(kind("0", "0.5", sheen) == shader_of<effects::sheen>);
  std::string const emissive = R"(, "emissiveFactor": [0, 0, 0.1])";
  CHECK(kind("0", "0.5", specular0 + emissive) == shader_of<effects::emitters>);
  CHECK(kind("0", "0.5", emissive) == shader_of<effects::plastic>);
  CHECK(kind("1", "0.5", emissive) == shader_of<effects::metal>);
  CHECK(kind("0", "0", glass + emissive) == shader_of<effects::smooth_glass>);
  CHECK(kind("0", "0.5", R"(, "extras": {"shader": "wood"})") == shader_of<effects::wood>);
  CHECK(kind("1", "0.5", R"(, "extras": {"shader": "marble"})") == shader_of<effects::marble>);
}

TEST_CASE("a textured metal is left to the shader that mixes") {
  CHECK(load_material(R"({"pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": 0}}})")
            .kind == shader_of<effects::plastic>);
}

TEST_CASE("factors of a material") {
  material const m = load_material(R"({
    "doubleSided": true, "emissiveFactor": [1, 0.5, 0],
    "normalTexture": {"index": 0, "scale": 0.7},
    "pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 1], "metallicFactor": 0.4,
                             "roughnessFactor": 0.6},
    "extensions": {
      "KHR_materials_emissive_strength": {"emissiveStrength": 12},
      "KHR_materials_ior": {"ior": 1.33},
      "KHR_materials_specular": {"specularFactor": 0.8, "specularColorFactor": [1, 0.9, 0.8]},
      "KHR_materials_clearcoat": {"clearcoatFactor": 0.5, "clearcoatRoughnessFactor": 0.25},
      "KHR_materials_sheen": {"sheenColorFactor": [0.2, 0.3, 0.4], "sheenRoughnessFactor": 0.35}},
    "extras": {"second_color": [0.5, 0.6, 0.7], "pattern_scale": 3}})");
  CHECK(m.base_color == vec3(0.1f, 0.2f, 0.3f));
  CHECK(m.metallic == 0.4f);
  CHECK(m.roughness == 0.6f);
  CHECK(m.two_sided);
  CHECK(m.emission == vec3(12, 6, 0));
  CHECK(m.ior == 1.33f);
  CHECK(m.specular == 0.8f);
  CHECK(m.specular_color == vec3(1, 0.9f, 0.8f));
  CHECK(m.clearcoat == 0.5f);
  CHECK(m.clearcoat_roughness == 0.25f);
  CHECK(m.sheen_color == vec3(0.2f, 0.3f, 0.4f));
  CHECK(m.sheen_roughness == 0.35f);
  CHECK(m.normal_texture == 0);
  CHECK(m.normal_scale == 0.7f);
  CHECK(m.second_color == vec3(0.5f, 0.6f, 0.7f));
  CHECK(m.pattern_scale == 3);
}

TEST_CASE("an emissive texture is loaded, with its mean") {
  material const m =
      load_material(R"({"emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": 0}})");
  CHECK(m.emissive_texture == 0);
  CHECK(m.base_color_texture == no_texture);
  // Of red, green, blue and white.
  for (int c = 0; c < 3; ++c) CHECK_THAT(m.mean_emissive[c], WithinAbs(0.5, 1e-6));
  CHECK(load_material("{}").mean_emissive == vec3(1));
}

TEST_CASE("glass without a volume is thin") {
  std::string const glass = R"({"extensions": {
    "KHR_materials_transmission": {"transmissionFactor": 1},
    "KHR_materials_volume": {"thicknessFactor": )";
  CHECK(load_material((glass + "0}}}").c_str()).thin);
  CHECK_FALSE(load_material((glass + "0.5}}}").c_str()).thin);
  CHECK(load_material("{}").thin);
}

TEST_CASE("specular of glass is one warning") {
  gltf_fixture f;
  f.at("/materials/0") =
      json::parse(R"({"pbrMetallicRoughness": {"metallicFactor": 0.5}, "extensions": {
    "KHR_materials_transmission": {"transmissionFactor": 1},
    "KHR_materials_specular": {"specularFactor": 0.5}}})");
  scene const s = load(f);
  CHECK(s.warnings.size() == 1);
  CHECK(warns(s, "KHR_materials_specular of glass (material 0) is left out"));
}

TEST_CASE("a primitive without a material has the default one") {
  gltf_fixture f;
  f.at("/meshes/0/primitives/0").erase("material");
  scene const s = load(f);
  REQUIRE(s.triangles[0].material == 1);
  CHECK(s.materials.at(1).kind == shader_of<effects::metal>);
  CHECK(s.materials.at(1).base_color == vec3(1));
  CHECK(s.materials.at(1).roughness == 1);
}

TEST_CASE("textures share their texels and keep their samplers") {
  gltf_fixture f;
  f.at("/samplers/0") = {{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}};
  f.at("/materials/0/normalTexture") = {{"index", 0}};
  f.root["textures"].push_back({{"source", 0}});
  f.at("/materials/0/pbrMetallicRoughness/metallicRoughnessTexture") = {{"index", 1}};
  f.root["materials"].push_back(f.root["materials"][0]);
  scene const s = load(f);
  REQUIRE(s.texels.size() == 4);
  CHECK(s.texels[0] == 0xff0000ffu);  // red: row 0 is on top
  CHECK(s.texels[1] == 0xff00ff00u);
  CHECK(s.texels[2] == 0xffff0000u);
  REQUIRE(s.textures.size() == 3);
  material const& m = s.materials[1];
  texture const& color = s.textures[static_cast<std::size_t>(m.base_color_texture)];
  texture const& normal = s.textures[static_cast<std::size_t>(m.normal_texture)];
  texture const& rough = s.textures[static_cast<std::size_t>(m.metallic_roughness_texture)];
  CHECK((color.srgb && !normal.srgb && !rough.srgb));
  CHECK((color.width == 2 && color.height == 2 && color.offset == 0));
  CHECK((color.wrap_s == 1 && color.wrap_t == 2 && color.nearest));
  CHECK((rough.wrap_s == 0 && rough.wrap_t == 0 && !rough.nearest));
}

TEST_CASE("what is left out is named once for each kind") {
  gltf_fixture f;
  f.root["skins"] = json::array();
  f.root["extensionsUsed"].push_back("EXT_unheard_of");
  f.root["scenes"].push_back(json::object());
  f.at("/meshes/0/primitives/0/attributes/COLOR_0") = 0;
  f.at("/meshes/0/primitives/0/attributes/TEXCOORD_1") = 2;
  f.at("/meshes/0/primitives/0/targets") = json::array();
  f.root["meshes"][0]["primitives"].push_back({{"mode", 0}, {"attributes", {{"POSITION", 0}}}});
  f.root["materials"] = json::parse(R"([
    {"name": "a", "alphaMode": "MASK", "occlusionTexture": {"index": 0}, "extras": {"shader": "lava"},
     "extensions": {"KHR_materials_unlit": {}, "KHR_materials_transmission":
       {"transmissionFactor": 0, "transmissionTexture": {"index": 0}}}},
    {"name": "b", "occlusionTexture": {"index": 0}, "normalTexture": {"index": 0, "texCoord": 1},
     "extras": {"shader": "wood"},
     "extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 1}}}])");
  scene const s = load(f);
  for (std::string const& w : s.warnings) INFO(w);
  CHECK(warns(s, "\"skins\" is left out"));
  CHECK(warns(s, "extension EXT_unheard_of is left out"));
  CHECK(warns(s, "scene that is not the default one (scene 1) is left out"));
  CHECK(warns(s, "attribute COLOR_0 (mesh 0 \"patch\") is left out"));
  CHECK(warns(s, "attribute TEXCOORD_1 (mesh 0 \"patch\") is left out"));
  CHECK(warns(s, "\"targets\" (mesh 0 \"patch\") is left out"));
  CHECK(warns(s, "points (mesh 0 \"patch\", primitive 1) is left out"));
  CHECK(warns(s, "alphaMode MASK (material 0 \"a\") is left out"));
  CHECK(warns(s, "\"occlusionTexture\" (material 0 \"a\" and 1 more) is left out"));
  CHECK(warns(s, "extras.shader \"lava\" (material 0 \"a\") is left out"));
  CHECK(warns(s, "extension KHR_materials_unlit (material 0 \"a\") is left out"));
  CHECK(warns(s, "\"transmissionTexture\" (material 0 \"a\") is left out"));
  CHECK(warns(s, "texture with TEXCOORD_1 (material 1 \"b\") is left out"));
  CHECK(warns(s, "clearcoat under another shader (material 1 \"b\") is left out"));
  CHECK(s.warnings.size() == 14);
}

TEST_CASE("names and extras of other programs pass") {
  gltf_fixture f;
  f.root["extras"] = {{"tool", {1, 2}}};
  f.at("/scenes/0/extras") = {{"background", {0.1, 0.2, 0.3}}, {"other", "x"}};
  f.at("/nodes/1/extras") = "free text";
  scene const s = load(f);
  CHECK(s.warnings.empty());
  CHECK(s.background == vec3(0.1f, 0.2f, 0.3f));
}

TEST_CASE("the scenes of the project have nothing that is left out") {
  std::string const folder = PATH_TRACER_SCENES;
  scene const box = load_gltf(folder + "/box.gltf");
  CHECK(box.triangles.size() == 6 * 2 + 2 * 12);
  CHECK(box.warnings.empty());
  scene const gallery = load_gltf(folder + "/gallery.gltf");
  CHECK(gallery.warnings.empty());
  CHECK(gallery.lights.size() == 1);
  CHECK(gallery.textures.size() == 4);
  std::set<std::uint32_t> materials;
  for (triangle const& t : gallery.triangles) materials.insert(t.material);
  CHECK(materials.size() >= 11);
}

TEST_CASE("scenes that another program exported load") {
  std::string const folder = DEFERRED_SHADE_SHARED_SCENES;
  for (char const* name : {"balls.glb", "cornell.glb", "studio.glb"}) {
    if (!std::filesystem::exists(folder + "/" + name)) continue;
    INFO(name);
    scene const s = load_gltf(folder + "/" + name);
    CHECK(!s.triangles.empty());
    CHECK(s.warnings.empty());
  }
}

}  // namespace
