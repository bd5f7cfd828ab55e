// SPDX-License-Identifier: Apache-2.0
// Geometry, transforms, cameras and lights as the loader leaves them.

#include <set>

#include "catch.hpp"
#include "path_tracer/load.hpp"

using namespace path_tracer;
using namespace path_tracer_test;

namespace {

template <class Vector>
bool near(Vector a, Vector b) {
  return glm::length(a - b) < 1e-5f;
}

vec3 face_normal(triangle const& t) {
  return glm::normalize(glm::cross(t.position[1] - t.position[0], t.position[2] - t.position[0]));
}

void add_five_points(gltf_fixture& f, int mode) {
  f.at("/meshes/0/primitives/0") = {
      {"mode", mode}, {"attributes", {{"POSITION", f.add_accessor(8, 5126, 5, "VEC3")}}}};
}

TEST_CASE("a triangle arrives with all it has") {
  for (bool const binary : {false, true}) {
    gltf_fixture const f;
    scene const s = load(binary ? f.binary() : f.text());
    REQUIRE(s.triangles.size() == 1);
    triangle const& t = s.triangles[0];
    CHECK(t.position[1] == vec3(1, 0, 0));
    CHECK(t.position[2] == vec3(0, 1, 0));
    CHECK(t.normal[0] == vec3(0, 0, 1));
    CHECK(t.uv[2] == vec2(0, 1));
    CHECK(t.material == 0);
    CHECK(s.background == vec3(0));
    CHECK(s.warnings.empty());
  }
}

TEST_CASE("indices of every width, and none") {
  gltf_fixture f;
  int component = 0;
  SECTION("8 bits") { component = 5121; }
  SECTION("32 bits") { component = 5125; }
  SECTION("none") {}
  if (component == 0)
    f.at("/meshes/0/primitives/0").erase("indices");
  else
    f.at("/meshes/0/primitives/0/indices") =
        f.add_accessor(f.add_view(component == 5121 ? bytes_of<std::uint8_t>({0, 1, 2})
                                                    : bytes_of<std::uint32_t>({0, 1, 2})),
                       component, 3, "SCALAR");
  scene const s = load(f);
  REQUIRE(s.triangles.size() == 1);
  CHECK(s.triangles[0].position[1] == vec3(1, 0, 0));
}

TEST_CASE("strips and fans keep the winding of their first triangle") {
  gltf_fixture f;
  SECTION("strip") {  // (0,0) (1,0) (0,1) (1,1) (2,1)
    add_five_points(f, 5);
    scene const s = load(f);
    REQUIRE(s.triangles.size() == 2);  // the last three points lie on a line
    for (triangle const& t : s.triangles) CHECK(near(face_normal(t), vec3(0, 0, 1)));
    CHECK(s.triangles[1].position[0] == vec3(1, 0, 0));
    CHECK(s.triangles[1].position[1] == vec3(1, 1, 0));
    REQUIRE(s.warnings.size() == 1);
    CHECK(s.warnings[0].find("triangle without an area (mesh 0 \"patch\", primitive 0)") !=
          std::string::npos);
  }
  SECTION("fan") {
    add_five_points(f, 6);
    scene const s = load(f);
    REQUIRE(s.triangles.size() == 3);
    CHECK(s.triangles[0].position[2] == vec3(0));
    CHECK(near(face_normal(s.triangles[0]), vec3(0, 0, 1)));
    CHECK(s.triangles[2].position[1] == vec3(2, 1, 0));
  }
}

TEST_CASE("missing normals are those of the face, missing texture coordinates 0") {
  gltf_fixture f;
  f.at("/meshes/0/primitives/0/attributes").erase("NORMAL");
  f.at("/meshes/0/primitives/0/attributes").erase("TEXCOORD_0");
  f.at("/nodes/1")["rotation"] = {0, std::sqrt(0.5), 0, std::sqrt(0.5)};
  scene const s = load(f);
  for (int i = 0; i < 3; ++i) {
    CHECK(near(s.triangles[0].normal[i], vec3(1, 0, 0)));
    CHECK(s.triangles[0].uv[i] == vec2(0));
  }
}

TEST_CASE("texture coordinates and strides in other layouts") {
  gltf_fixture f;
  std::size_t const view =
      f.add_view(bytes_of<std::uint8_t>({0, 255, 7, 7, 255, 0, 7, 7, 51, 102}));
  f.root["bufferViews"][view]["byteStride"] = 4;
  std::size_t const uv = f.add_accessor(view, 5121, 3, "VEC2");
  f.root["accessors"][uv]["normalized"] = true;
  f.at("/meshes/0/primitives/0/attributes/TEXCOORD_0") = uv;
  triangle const t = load(f).triangles[0];
  CHECK(near(t.uv[0], vec2(0, 1)));
  CHECK(near(t.uv[1], vec2(1, 0)));
  CHECK(near(t.uv[2], vec2(0.2f, 0.4f)));
}

TEST_CASE("transforms of a hierarchy multiply, as TRS and as matrix") {
  gltf_fixture f;
  f.at("/scenes/0/nodes") = {0, 2};
  f.at("/nodes/2") = {{"children", {1}}, {"translation", {10, 0, 0}}, {"scale", {2, 2, 2}}};
  SECTION("translation, rotation, scale") {
    f.at("/nodes/1")["rotation"] = {0, 0, std::sqrt(0.5), std::sqrt(0.5)};  // x -> y
    f.at("/nodes/1")["scale"] = {3, 1, 1};
    f.at("/nodes/1")["translation"] = {0, 0, 5};
  }
  SECTION("matrix, by columns") {
    f.at("/nodes/1")["matrix"] = {0, 3, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1};
  }
  triangle const t = load(f).triangles[0];
  CHECK(near(t.position[0], vec3(10, 0, 10)));
  CHECK(near(t.position[1], vec3(10, 6, 10)));
  CHECK(near(t.position[2], vec3(8, 0, 10)));
}

TEST_CASE("normals go by the inverse transpose") {
  gltf_fixture f;
  f.at("/accessors/1/bufferView") = f.add_view(bytes_of<float>({1, 1, 0, 1, 1, 0, 0, 0, 0}));
  f.at("/nodes/1")["scale"] = {2, 1, 1};
  triangle const t = load(f).triangles[0];
  CHECK(near(t.normal[0], glm::normalize(vec3(0.5f, 1, 0))));
  CHECK(near(t.normal[2], vec3(0, 0, 1)));  // no direction in the file: the face's
}

TEST_CASE("a mirrored triangle keeps its front") {
  gltf_fixture f;
  SECTION("in x") { f.at("/nodes/1")["scale"] = {-1, 1, 1}; }
  SECTION("in z") { f.at("/nodes/1")["scale"] = {1, 1, -2}; }
  SECTION("by a matrix") {
    f.at("/nodes/1")["matrix"] = {0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  }
  triangle const t = load(f).triangles[0];
  CHECK(near(face_normal(t), t.normal[0]));
  CHECK(std::fabs(t.normal[0].z) == 1);
}

TEST_CASE("the first camera in depth-first order is the view") {
  gltf_fixture f;
  f.root["nodes"].push_back({{"camera", 0}});
  f.root["scenes"][0]["nodes"].push_back(3);
  f.at("/nodes/0") = {{"camera", 0},
                      {"translation", {1, 2, 3}},
                      {"scale", {4, 4, 4}},
                      {"rotation", {0, std::sqrt(0.5), 0, std::sqrt(0.5)}}};  // -z -> -x
  scene const s = load(f);
  CHECK(near(s.view.position, vec3(1, 2, 3)));
  CHECK(near(s.view.forward, vec3(-1, 0, 0)));
  CHECK(near(s.view.right, vec3(0, 0, -1)));
  CHECK(near(s.view.up, vec3(0, 1, 0)));
  CHECK_THAT(s.view.tan_half_yfov, WithinRel(std::tan(0.4f), 1e-6f));
  CHECK(s.view.ortho_height == 0);
  REQUIRE(s.warnings.size() == 1);
  CHECK(s.warnings[0].find("further camera (node 3) is left out") != std::string::npos);
}

TEST_CASE("an orthographic camera") {
  gltf_fixture f;
  f.at("/cameras/0") = {{"type", "orthographic"},
                        {"orthographic", {{"xmag", 3}, {"ymag", 2}, {"znear", 0}, {"zfar", 9}}}};
  CHECK(load(f).view.ortho_height == 2);
}

TEST_CASE("punctual lights take place and direction from their node") {
  gltf_fixture f;
  json& light = f.at("/extensions/KHR_lights_punctual/lights/0");
  f.at("/nodes/2")["translation"] = {0, 4, 0};
  f.at("/nodes/2")["rotation"] = {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)};  // -z -> -y
  light["color"] = {1, 0.5, 0.25};
  light["intensity"] = 8;
  SECTION("point") {
    light["range"] = 12;
    punctual_light const l = load(f).lights.at(0);
    CHECK(l.kind == punctual_light::type::point);
    CHECK(near(l.position, vec3(0, 4, 0)));
    CHECK(l.intensity == vec3(8, 4, 2));
    CHECK(l.range == 12);
  }
  SECTION("spot") {
    light["type"] = "spot";
    light["spot"] = {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.5}};
    punctual_light const l = load(f).lights.at(0);
    CHECK(l.kind == punctual_light::type::spot);
    CHECK(near(l.direction, vec3(0, -1, 0)));
    CHECK_THAT(l.cos_inner, WithinRel(std::cos(0.2f), 1e-6f));
    CHECK_THAT(l.cos_outer, WithinRel(std::cos(0.5f), 1e-6f));
  }
  SECTION("directional") {
    light["type"] = "directional";
    punctual_light const l = load(f).lights.at(0);
    CHECK(l.kind == punctual_light::type::directional);
    CHECK(near(l.direction, vec3(0, -1, 0)));
  }
}

TEST_CASE("a buffer and a picture in files beside the scene") {
  temporary_folder const folder;
  gltf_fixture f;
  write_bytes(folder / "a b.bin", f.data);
  write_bytes(folder / "t.png", gltf_fixture::png());
  f.root["buffers"] = {{{"byteLength", f.data.size()}, {"uri", "a%20b.bin"}}};
  f.at("/images/0") = {{"uri", "t.png"}};
  write_bytes(folder / "scene.gltf", f.text());
  scene const s = load_gltf(folder / "scene.gltf");
  CHECK(s.triangles.size() == 1);
  CHECK(s.texels.size() == 4);
}

}  // namespace
