// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <stdexcept>

#include "io/gltf_accessor.hpp"
#include "io/gltf_parts.hpp"

namespace path_tracer::gltf {
namespace {

/// Twice the area of a triangle that is left out: its square, too, has to fit into a float.
constexpr double smallest = 1e-18;

bool is_finite(vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

class primitive_reader {
 public:
  primitive_reader(document& d, std::size_t mesh, std::size_t primitive)
      : document_(d),
        primitive_(d.model.meshes[mesh].primitives[primitive]),
        where_(element(d.root, "meshes", mesh) + ", primitive " + std::to_string(primitive)) {}

  void append(placement const& place, scene& out) {
    if (primitive_.mode < TINYGLTF_MODE_TRIANGLES)
      return document_.left_out.add(primitive_.mode == TINYGLTF_MODE_POINTS ? "points" : "lines",
                                    where_);
    read_vertices(place.close);
    closing_positions_ = std::move(positions_);
    closing_normals_ = std::move(normals_);
    read_vertices(place.open);
    read_indices();
    emit(glm::determinant(glm::dmat3(place.open)) < 0, out);
  }

 private:
  [[noreturn]] void fail(std::string const& what) const {
    throw std::runtime_error(where_ + ": " + what);
  }

  elements open(int index, int type, std::string const& name) const {
    tinygltf::Accessor const& a = document_.model.accessors[static_cast<std::size_t>(index)];
    std::string const accessor = name + " (accessor " + std::to_string(index) + ") ";
    if (a.type != type) fail(accessor + "has not the type that glTF asks for");
    bool const position = name == "POSITION" || name == "NORMAL";
    bool const is_float = a.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT;
    bool const is_small = a.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                          a.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
    bool const valid = position ? is_float
                       : name == "indices"
                           ? is_small || a.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT
                           : is_float || (is_small && a.normalized);
    if (!valid) fail(accessor + "has a component type that glTF does not allow there");

    return open_accessor(document_, where_, index, name);
  }

  std::vector<vec3> read_vec3(std::string const& name) const {
    elements const e = open(primitive_.attributes.at(name), TINYGLTF_TYPE_VEC3, name);
    std::vector<vec3> result(e.count);
    for (std::size_t i = 0; i < e.count; ++i) {
      result[i] = {e.real_at(i, 0), e.real_at(i, 1), e.real_at(i, 2)};
      if (!is_finite(result[i])) fail(name + " of vertex " + std::to_string(i) + " is not finite");
    }
    return result;
  }

  void same_count(std::size_t count, std::string const& name) const {
    if (count != positions_.size())
      fail(name + " has " + std::to_string(count) + " elements for " +
           std::to_string(positions_.size()) + " vertices");
  }

  void read_vertices(glm::dmat4 const& to_world) {
    positions_ = read_vec3("POSITION");
    for (vec3& p : positions_) {
      p = vec3(to_world * glm::dvec4(p, 1));
      if (!(glm::length(glm::dvec3(p)) <= farthest))
        fail("a vertex lies more than 1e9 units from the origin of world space");
    }
    if (primitive_.attributes.count("NORMAL") != 0) {
      normals_ = read_vec3("NORMAL");
      same_count(normals_.size(), "NORMAL");
      glm::dmat3 const to_normal = glm::transpose(glm::inverse(glm::dmat3(to_world)));
      for (vec3& n : normals_) {
        glm::dvec3 const v = to_normal * glm::dvec3(n);
        double const length = glm::length(v);
        n = length > 0 && std::isfinite(length) ? vec3(v / length) : vec3(0);
      }
    }
    if (primitive_.attributes.count("TEXCOORD_0") != 0) {
      elements const e =
          open(primitive_.attributes.at("TEXCOORD_0"), TINYGLTF_TYPE_VEC2, "TEXCOORD_0");
      same_count(e.count, "TEXCOORD_0");
      uvs_.resize(e.count);
      for (std::size_t i = 0; i < e.count; ++i) {
        uvs_[i] = {e.real_at(i, 0), e.real_at(i, 1)};
        if (!std::isfinite(uvs_[i].x) || !std::isfinite(uvs_[i].y))
          fail("TEXCOORD_0 of vertex " + std::to_string(i) + " is not finite");
      }
    }
  }

  void read_indices() {
    if (primitive_.indices < 0) {
      indices_.resize(positions_.size());
      std::iota(indices_.begin(), indices_.end(), 0u);
    } else {
      elements const e = open(primitive_.indices, TINYGLTF_TYPE_SCALAR, "indices");
      indices_.resize(e.count);
      for (std::size_t i = 0; i < e.count; ++i) indices_[i] = e.unsigned_at(i, 0);
    }
    for (std::uint32_t const i : indices_)
      if (i >= positions_.size())
        fail("index " + std::to_string(i) + " is outside its " + std::to_string(positions_.size()) +
             " vertices");
    if (primitive_.mode == TINYGLTF_MODE_TRIANGLES && indices_.size() % 3 != 0)
      fail("its " + std::to_string(indices_.size()) + " indices are not a multiple of 3");
    if (indices_.size() < 3) fail("it has fewer than 3 indices");
  }

  /// Corners of triangle `t`, counter-clockwise from the front (glTF 2.0, section 3.7.2.1).
  void corners(std::size_t t, std::uint32_t* c) const {
    std::size_t a = 3 * t, b = a + 1, d = a + 2;
    if (primitive_.mode == TINYGLTF_MODE_TRIANGLE_STRIP)
      a = t, b = t + 1 + t % 2, d = t + 2 - t % 2;
    if (primitive_.mode == TINYGLTF_MODE_TRIANGLE_FAN) a = t + 1, b = t + 2, d = 0;
    c[0] = indices_[a], c[1] = indices_[b], c[2] = indices_[d];
  }

  void emit(bool mirrored, scene& out) {
    bool const list = primitive_.mode == TINYGLTF_MODE_TRIANGLES;
    std::size_t const count = list ? indices_.size() / 3 : indices_.size() - 2;
    if (count > maximum_triangles - out.triangles.size())
      fail("with it the scene has more than " + std::to_string(maximum_triangles) + " triangles");
    std::size_t const material = primitive_.material < 0
                                     ? document_.model.materials.size()
                                     : static_cast<std::size_t>(primitive_.material);
    for (std::size_t t = 0; t < count; ++t) {
      std::uint32_t c[3];
      corners(t, c);
      if (mirrored) std::swap(c[1], c[2]);
      triangle result{};
      triangle_motion motion{};
      result.material = static_cast<std::uint32_t>(material);
      glm::dvec3 const p(positions_[c[0]]);
      glm::dvec3 const face =
          glm::cross(glm::dvec3(positions_[c[1]]) - p, glm::dvec3(positions_[c[2]]) - p);
      double const length = glm::length(face);
      if (!(length > smallest)) {
        document_.left_out.add("triangle without an area", where_);
        continue;
      }
      glm::dvec3 const q(closing_positions_[c[0]]);
      vec3 const closing_face = vec3(glm::normalize(glm::cross(
          glm::dvec3(closing_positions_[c[1]]) - q, glm::dvec3(closing_positions_[c[2]]) - q)));
      auto const normal = [&](std::vector<vec3> const& normals, std::uint32_t corner, vec3 flat) {
        return normals.empty() || normals[corner] == vec3(0) ? flat : normals[corner];
      };
      for (int i = 0; i < 3; ++i) {
        result.position[i] = positions_[c[i]];
        result.normal[i] = normal(normals_, c[i], vec3(face / length));
        result.uv[i] = uvs_.empty() ? vec2(0) : uvs_[c[i]];
        motion.position[i] = closing_positions_[c[i]];
        motion.normal[i] = normal(closing_normals_, c[i], closing_face);
      }
      out.triangles.push_back(result);
      out.motion.push_back(motion);
    }
  }

  document& document_;
  tinygltf::Primitive const& primitive_;
  std::string where_;
  std::vector<vec3> positions_, normals_;                  // when the shutter opens
  std::vector<vec3> closing_positions_, closing_normals_;  // and when it closes
  std::vector<vec2> uvs_;
  std::vector<std::uint32_t> indices_;
};

}  // namespace

void append_mesh(document& d, std::size_t mesh, placement const& place, scene& out) {
  for (std::size_t i = 0; i < d.model.meshes[mesh].primitives.size(); ++i)
    primitive_reader(d, mesh, i).append(place, out);
}

}  // namespace path_tracer::gltf
