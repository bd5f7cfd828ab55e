// SPDX-License-Identifier: Apache-2.0
// Scenes that break a rule, one each: exit code 1, one line on stderr that names the element, no
// picture.
#include "catch.hpp"
#include "path_tracer/fixture.hpp"
#include "path_tracer/process.hpp"

using namespace path_tracer_test;

namespace {

void check_refused(outcome const& result, std::string const& words) {
  CAPTURE(result.err);
  CHECK(result.exit_code == 1);
  CHECK(result.out.empty());
  CHECK(result.err.rfind("gltf_path_tracer: ", 0) == 0);
  CHECK(result.err.find('\n') == result.err.size() - 1);
  CHECK(result.err.find(words) != std::string::npos);
}

void check_scene(std::string const& bytes, std::string const& words) {
  temporary_folder const folder;
  write_bytes(folder / "scene.gltf", bytes);
  outcome const result =
      run_path_tracer({folder / "scene.gltf", "-o", folder / "picture.png", "--width", "8"});
  INFO("expected: " + words);
  check_refused(result, words);
  if (result.exit_code == 1) CHECK(result.err.find("scene.gltf: ") != std::string::npos);
  CHECK(folder.names() == std::vector<std::string>{"scene.gltf"});
}

/// One value of the fixture's JSON replaced, or removed if there is none.
struct spoiled {
  char const *pointer, *value, *words;
};

constexpr spoiled cases[] = {
    {"/asset", nullptr, "it has no \"asset\""},
    {"/asset/version", nullptr, "no asset.version"},
    {"/asset/version", "\"1.0\"", "is glTF 1.0, not glTF 2"},
    {"/extensionsRequired", R"(["KHR_draco_mesh_compression"])", "KHR_draco_mesh_compression"},
    {"/scenes", nullptr, "scene is 0, but the file has 0 scenes"},
    {"/scene", "1", "scene is 1, but the file has 1 scenes"},
    {"/scene", "-1", "scene is -1, but the file has 1 scenes"},
    {"/scenes/0/nodes", "[1]", "has no camera"},
    {"/scenes/0/nodes", "[0]", "has no triangles"},
    {"/scenes/0/nodes", "[0, 9]", "scene 0: nodes[1] is 9, but the file has 3 nodes"},
    {"/scenes/0/nodes", "{}", "scene 0: nodes is not an array"},
    {"/scenes/0/extras", R"({"background": [0, -1, 0]})", "scene 0: extras.background holds -1"},
    {"/nodes/0/camera", "1", "node 0: camera is 1, but the file has 1 cameras"},
    {"/nodes/1/mesh", "1", "node 1 \"thing\": mesh is 1, but the file has 1 meshes"},
    {"/nodes/1/mesh", "\"0\"", "node 1 \"thing\": mesh is not an integer"},
    {"/nodes/1/mesh", "0.5", "node 1 \"thing\": mesh is not an integer"},
    {"/nodes/1/mesh", "4294967296", "mesh is 4294967296, but the file has 1 meshes"},
    {"/nodes/1/children", "[7]", "node 1 \"thing\": children[0] is 7"},
    {"/nodes/1/children", "[1]", "node 1 \"thing\": is reached twice"},
    {"/nodes/0/children", "[1]", "node 1 \"thing\": is reached twice"},
    {"/nodes/1/scale", "[1, 0, 1]", "node 1 \"thing\": its transform cannot be inverted"},
    {"/nodes/1/scale", "[1e30, 1e30, 1e30]", "a vertex lies more than 1e9 units"},
    {"/nodes/2/translation", "[0, 2e9, 0]", "node 2: lies more than 1e9 units"},
    {"/nodes/1/translation", "[\"a\", 0, 0]", "translation is not a number"},
    {"/nodes/1/translation", "[1e39, 0, 0]", "translation holds 1e+39"},
    {"/nodes/1/rotation", "[0, 0, 0, 0.5]", "not a unit quaternion"},
    {"/nodes/1/matrix", "[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0]", "not an array of 16 numbers"},
    {"/nodes/1/matrix", "[1,0,0,0, 2,0,0,0, 0,0,1,0, 0,0,0,1]", "cannot be inverted"},
    {"/nodes/1/matrix", "[1,0,0,1, 0,1,0,0, 0,0,1,0, 0,0,0,1]", "the last row of its matrix"},
    {"/nodes/2/extensions/KHR_lights_punctual/light", "3", "but the file has 1 lights"},
    {"/extensions/KHR_lights_punctual/lights/0/type", "\"laser\"", "light 0 \"bulb\": its type"},
    {"/extensions/KHR_lights_punctual/lights/0/intensity", "-2", "intensity holds -2"},
    {"/extensions/KHR_lights_punctual/lights/0",
     R"({"type": "spot", "spot": {"innerConeAngle": 1, "outerConeAngle": 0.5}})", "innerConeAngle"},
    {"/cameras/0/type", "\"fisheye\"", "fisheye"},
    {"/cameras/0/perspective/yfov", "0", "camera 0: perspective.yfov holds 0"},
    {"/cameras/0/perspective/yfov", "3.2", "camera 0: perspective.yfov holds 3.2"},
    {"/cameras/0",
     R"({"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 0, "znear": 0, "zfar": 9}})",
     "camera 0: its ymag is 0"},

    {"/cameras/0/extras", R"({"shutter_open": 1, "shutter_close": 0.5})",
     "camera 0: its shutter closes before it opens"},
    {"/scenes/0/extras", R"({"environment": "no.hdr"})", "no.hdr\": there is no such file"},
    {"/scenes/0/extras", R"({"environment": "scene.gltf"})", "is not a picture in Radiance's"},
    {"/scenes/0/extras", R"({"environment": 3})", "scene 0: extras.environment is not a string"},
    {"/scenes/0/extras", R"({"medium_anisotropy": 1})", "extras.medium_anisotropy holds 1"},
    {"/materials/0/extensions/KHR_materials_volume", "3", "is not an object"},
    {"/materials/0/extensions/KHR_materials_volume/attenuationDistance", "0",
     "attenuationDistance holds 0"},
    {"/materials/0/extensions/KHR_materials_iridescence/iridescenceIor", "0.5",
     "iridescenceIor holds 0.5"},
    {"/animations", R"([{"channels": []}])", "animation 0 has no \"samplers\""},

    {"/meshes/0/primitives", nullptr, "mesh 0 \"patch\" has no \"primitives\""},
    {"/meshes/0/primitives/0/attributes/POSITION", nullptr, "has no \"POSITION\""},
    {"/meshes/0/primitives/0/attributes/POSITION", "4",
     "attributes.POSITION is 4, but the file has 4"},
    {"/meshes/0/primitives/0/attributes/COLOR_0", "\"x\"", "'attributes' value"},
    {"/meshes/0/primitives/0/indices", "99", "mesh 0 \"patch\": primitives[0].indices is 99"},
    {"/meshes/0/primitives/0/material", "1", "primitives[0].material is 1"},
    {"/meshes/0/primitives/0/mode", "9", "primitives[0].mode holds 9"},
    {"/meshes/0/primitives/0/mode", "1", "has no triangles"},
    {"/accessors/0/bufferView", "5",
     "mesh 0 \"patch\", primitive 0: POSITION of vertex 2 is not finite"},
    {"/accessors/0/bufferView", "7", "POSITION of vertex 1 is not finite"},
    {"/accessors/1/bufferView", "5", "NORMAL of vertex 2 is not finite"},
    {"/accessors/2/bufferView", "7", "TEXCOORD_0 of vertex 2 is not finite"},
    {"/accessors/3/bufferView", "6", "primitive 0: index 7 is outside its 3 vertices"},
    {"/accessors/3/count", "2", "2 indices are not a multiple of 3"},
    {"/accessors/0/bufferView", "50", "accessor 0: bufferView is 50"},
    {"/accessors/0/bufferView", nullptr, "POSITION (accessor 0) has no bufferView"},
    {"/accessors/0/count", "4", "ends at byte 48 of a buffer view of 36"},
    {"/accessors/0/count", "4294967295", "of a buffer view of 36"},
    {"/accessors/0/count", "0", "accessor 0: count holds 0"},
    {"/accessors/0/count", nullptr, "accessor 0 has no \"count\""},
    {"/accessors/0/byteOffset", "18446744073709551615", "accessor 0: byteOffset holds"},
    {"/accessors/0/type", "\"VEC2\"", "POSITION (accessor 0) has not the type"},
    {"/accessors/0/componentType", "5125", "POSITION (accessor 0) has a component type"},
    {"/accessors/0/componentType", "5127", "componentType holds 5127"},
    {"/accessors/0/sparse",
     R"({"count": 1, "indices": {"bufferView": 3, "componentType": 5123}, "values": {"bufferView": 0}})",
     "POSITION (accessor 0) is sparse"},
    {"/accessors/1/count", "2", "NORMAL has 2 elements for 3 vertices"},
    {"/bufferViews/0/byteStride", "4", "its byteStride is too small"},
    {"/bufferViews/0/byteLength", "1000000", "bufferView 0 ends at byte 1000000, but buffer 0 has"},
    {"/bufferViews/4/byteOffset", "4294967295", "bufferView 4 ends at byte"},
    {"/bufferViews/4/byteOffset", "-8", "byteOffset holds -8"},
    {"/bufferViews/0/buffer", "1", "bufferView 0: buffer is 1, but the file has 1 buffers"},
    {"/buffers", R"([{"byteLength": 4000, "uri": "no_such_file.bin"}])", "buffer 0 is not there"},
    {"/buffers", R"([{"byteLength": 4000, "uri": "data:application/octet-stream;base64,AAAA"}])",
     "buffer 0 is not there, or has not the length"},
    {"/buffers", R"([{"byteLength": 4000}])", "buffer 0 is not there"},

    {"/materials/0/pbrMetallicRoughness/baseColorTexture/index", "1",
     "baseColorTexture.index is 1"},
    {"/materials/0/pbrMetallicRoughness/baseColorTexture/index", nullptr, "has no \"index\""},
    {"/materials/0/pbrMetallicRoughness/baseColorFactor", "[1, -1, 1, 1]",
     "baseColorFactor holds -1"},
    {"/materials/0/pbrMetallicRoughness/baseColorFactor", "[1, 1, 1]", "not an array of 4 numbers"},
    {"/materials/0/pbrMetallicRoughness/roughnessFactor", "-0.5", "material 0 \"paint\": pbr"},
    {"/materials/0/pbrMetallicRoughness/roughnessFactor", "\"matte\"", "is not a number"},
    {"/materials/0/emissiveFactor", "[0, 0, -3]", "material 0 \"paint\": emissiveFactor holds -3"},
    {"/materials/0/extensions", R"({"KHR_materials_ior": {"ior": 0.5}})", "ior is between 0 and 1"},
    {"/textures/0/source", "1", "texture 0: source is 1, but the file has 1 images"},
    {"/textures/0/source", nullptr, "its texture 0 has no PNG or JPEG image"},
    {"/textures/0/sampler", "1", "texture 0: sampler is 1, but the file has 1 samplers"},
    {"/samplers/0/wrapS", "20000", "wrap mode 20000"},
    {"/images/0/bufferView", "44", "image 0: bufferView is 44"},
    {"/images/0/bufferView", "0", "its image 0 cannot be decoded"},
    {"/images/0", R"({"uri": "no_such_file.png"})", "cannot be read from \"no_such_file.png\""},
    {"/bufferViews/4/byteLength", "40", "its image 0 cannot be decoded"},
};

TEST_CASE("the scene that the cases spoil is a good one") {
  temporary_folder const folder;
  for (bool const binary : {false, true}) {
    gltf_fixture const f;
    write_bytes(folder / "scene.gltf", binary ? f.binary() : f.text());
    outcome const result = run_path_tracer(
        {folder / "scene.gltf", "-o", folder / "picture.png", "--width", "8", "--spp", "1", "-q"});
    CHECK(result.exit_code == 0);
    CHECK(result.err.empty());
    CHECK(folder.names() == std::vector<std::string>{"picture.png", "scene.gltf"});
  }
}

TEST_CASE("a scene with one thing wrong is refused in one line") {
  for (spoiled const& c : cases) {
    gltf_fixture f;
    json::json_pointer const pointer(c.pointer);
    if (c.value != nullptr)
      f.root[pointer] = json::parse(c.value);
    else if (pointer.parent_pointer().empty())
      f.root.erase(pointer.back());
    else
      f.root[pointer.parent_pointer()].erase(pointer.back());
    INFO(std::string(c.pointer) + " = " + (c.value == nullptr ? "nothing" : c.value));
    check_scene(f.text(), c.words);
  }
}

TEST_CASE("a file that is no glTF is refused in one line") {
  std::string const text = gltf_fixture().text(), glb = gltf_fixture().binary();
  check_scene("", "is empty");
  check_scene("solid cube\n facet normal 0 0 1\n", "is not a glTF file");
  check_scene("[1, 2]", "is not a glTF file");
  check_scene(text.substr(0, text.size() / 2), "is truncated");
  check_scene(text + "}", "is not a glTF file");
  check_scene("{\"asset\": " + std::string(100000, '['), "nested too deeply");
  check_scene(R"({"asset": {"version": "2.0"}, "x": 1e999})", "beyond the range of a double");
  check_scene("{\"asset\": \"\xff\xfe\"}", "is not a glTF file");
  check_scene(glb.substr(0, 16), "is truncated");
  check_scene(glb.substr(0, glb.size() - 8), "is truncated");
  auto const with = [&](std::size_t offset, std::string const& bytes) {
    std::string result = glb;
    return result.replace(offset, bytes.size(), bytes);
  };
  check_scene(with(4, std::string("\1\0\0\0", 4)), "version 1, not of version 2");
  check_scene(with(8, "\xff\xff\xff\x7f"), "is truncated");
  check_scene(with(12, "\xff\xff\xff\xff"), "JSON chunk that ends after");
  check_scene(with(16, "BIN "), "no JSON in its first chunk");
  std::size_t const chunk = glb.find(std::string("BIN\0", 4)) - 4;
  check_scene(with(chunk, "\xff\xff\xff\xff"), "binary chunk that ends after");
}

TEST_CASE("a picture in a scene that claims a huge size is refused") {
  gltf_fixture f;
  std::string png = gltf_fixture::png();
  png.replace(16, 8, std::string("\0\1\x86\xa0\0\1\x86\xa0", 8));  // 100000 x 100000
  f.root["images"][0]["bufferView"] = f.add_view(png);
  check_scene(f.text(), "its image 0 cannot be decoded");
}

TEST_CASE("a scene that is not there, or is a folder, is refused") {
  temporary_folder const folder;
  check_refused(run_path_tracer({folder / "none.glb", "-o", folder / "a.png"}), "no such file");
  check_refused(run_path_tracer({folder / "", "-o", folder / "a.png"}), "not a regular file");
  CHECK(folder.names().empty());
}

}  // namespace
