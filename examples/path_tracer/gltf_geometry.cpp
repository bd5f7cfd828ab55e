// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <stdexcept>

#include "gltf_parts.hpp"

namespace path_tracer::gltf {
namespace {

/// Twice the area of a triangle that is left out: its square, too, has to fit into a float.
constexpr double smallest = 1e-18;

bool is_finite(vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// The bytes of an accessor, known to lie inside their buffer.
struct elements {
  unsigned char const* data;
  std::size_t count, stride;
  int component_type;

  template <class T>
  T get(std::size_t i, std::size_t component) const {
    T value;
    std::memcpy(&value, data + i * stride + component * sizeof(T), sizeof(T));
    return value;
  }

  std::uint32_t unsigned_at(std::size_t i, std::size_t component) const {
    if (component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE)
      return get<std::uint8_t>(i, component);
    if (component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT)
      return get<std::uint16_t>(i, component);
    return get<std::uint32_t>(i, component);
  }

  /// A float, or a normalised unsigned integer.
  float float_at(std::size_t i, std::size_t component) const {
    if (component_type == TINYGLTF_COMPONENT_TYPE_FLOAT) return get<float>(i, component);
    float const largest =
        component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ? 255.0f : 65535.0f;
    return static_cast<float>(unsigned_at(i, component)) / largest;
  }
};

class primitive_reader {
 public:
  primitive_reader(document& d, std::size_t mesh, std::size_t primitive)
      : document_(d),
        primitive_(d.model.meshes[mesh].primitives[primitive]),
        where_(element(d.root, "meshes", mesh) + ", primitive " + std::to_string(primitive)) {}

  void append(glm::dmat4 const& to_world, scene& out) {
    if (primitive_.mode < TINYGLTF_MODE_TRIANGLES)
      return document_.left_out.add(primitive_.mode == TINYGLTF_MODE_POINTS ? "points" : "lines",
                                    where_);
    read_vertices(to_world);
    read_indices();
    emit(glm::determinant(glm::dmat3(to_world)) < 0, out);
  }

 private:
  [[noreturn]] void fail(std::string const& what) const {
    throw std::runtime_error(where_ + ": " + what);
  }

  elements open(int index, int type, std::string const& name) const {
    tinygltf::Accessor const& a = document_.model.accessors[static_cast<std::size_t>(index)];
    std::string const accessor = name + " (accessor " + std::to_string(index) + ") ";
    if (a.sparse.isSparse) fail(accessor + "is sparse, which is not supported");
    if (a.bufferView < 0) fail(accessor + "has no bufferView");
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

    tinygltf::BufferView const& view =
        document_.model.bufferViews[static_cast<std::size_t>(a.bufferView)];
    std::size_t const components = static_cast<std::size_t>(
                          tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(type))),
                      size =
                          components * static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(
                                           static_cast<std::uint32_t>(a.componentType)));
    std::size_t const stride = view.byteStride == 0 ? size : view.byteStride;
    if (stride < size) fail(accessor + "overlaps itself: its byteStride is too small");
    // check() bounds all three numbers to 32 bits, so that nothing here can overflow 64.
    std::size_t const end = a.byteOffset + (a.count - 1) * stride + size;
    if (end > view.byteLength)
      fail(accessor + "ends at byte " + std::to_string(end) + " of a buffer view of " +
           std::to_string(view.byteLength));
    auto const& bytes = document_.model.buffers[static_cast<std::size_t>(view.buffer)].data;
    return {bytes.data() + view.byteOffset + a.byteOffset, a.count, stride, a.componentType};
  }

  std::vector<vec3> read_vec3(std::string const& name) const {
    elements const e = open(primitive_.attributes.at(name), TINYGLTF_TYPE_VEC3, name);
    std::vector<vec3> result(e.count);
    for (std::size_t i = 0; i < e.count; ++i) {
      result[i] = {e.float_at(i, 0), e.float_at(i, 1), e.float_at(i, 2)};
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
        uvs_[i] = {e.float_at(i, 0), e.float_at(i, 1)};
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
      result.material = static_cast<std::uint32_t>(material);
      glm::dvec3 const p(positions_[c[0]]);
      glm::dvec3 const face =
          glm::cross(glm::dvec3(positions_[c[1]]) - p, glm::dvec3(positions_[c[2]]) - p);
      double const length = glm::length(face);
      if (!(length > smallest)) {
        document_.left_out.add("triangle without an area", where_);
        continue;
      }
      for (int i = 0; i < 3; ++i) {
        result.position[i] = positions_[c[i]];
        vec3 const normal = normals_.empty() ? vec3(0) : normals_[c[i]];
        result.normal[i] = normal == vec3(0) ? vec3(face / length) : normal;
        result.uv[i] = uvs_.empty() ? vec2(0) : uvs_[c[i]];
      }
      out.triangles.push_back(result);
    }
  }

  document& document_;
  tinygltf::Primitive const& primitive_;
  std::string where_;
  std::vector<vec3> positions_, normals_;
  std::vector<vec2> uvs_;
  std::vector<std::uint32_t> indices_;
};

}  // namespace

void append_mesh(document& d, std::size_t mesh, glm::dmat4 const& to_world, scene& out) {
  for (std::size_t i = 0; i < d.model.meshes[mesh].primitives.size(); ++i)
    primitive_reader(d, mesh, i).append(to_world, out);
}

}  // namespace path_tracer::gltf
