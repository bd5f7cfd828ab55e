// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <stdexcept>

#include "io/gltf_parts.hpp"
#include "io/gltf_properties.hpp"

namespace path_tracer::gltf {
namespace {

glm::dvec3 vector(std::vector<double> const& v) { return {v[0], v[1], v[2]}; }

}  // namespace

glm::dmat4 local_transform(document const& d, std::size_t index, pose const& animated) {
  tinygltf::Node const& node = d.model.nodes[index];
  auto const fail = [&](char const* what) {
    throw std::runtime_error(element(d.root, "nodes", index) + ": " + what);
  };
  glm::dmat4 result(1);
  if (!node.matrix.empty()) {
    for (int i = 0; i < 16; ++i) result[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
    if (result[0][3] != 0 || result[1][3] != 0 || result[2][3] != 0 || result[3][3] != 1)
      fail("the last row of its matrix is not 0 0 0 1");
  } else {
    auto const or_own = [](std::vector<double> const& a, std::vector<double> const& own) {
      return a.empty() ? own : a;
    };
    std::vector<double> const r = or_own(animated.rotation, node.rotation),
                              scale = or_own(animated.scale, node.scale),
                              translation = or_own(animated.translation, node.translation);
    if (!r.empty()) {
      glm::dquat const q(r[3], r[0], r[1], r[2]);
      double const length = glm::length(q);
      if (std::fabs(length - 1) > 0.01) fail("its rotation is not a unit quaternion");
      result = glm::mat4_cast(q / length);
    }
    if (!scale.empty())
      for (int i = 0; i < 3; ++i) result[i] *= scale[static_cast<std::size_t>(i)];
    if (!translation.empty()) result[3] = glm::dvec4(vector(translation), 1);
  }
  // Relative to the box that the columns span, so that a small scale is no reason.
  glm::dmat3 const linear(result);
  double const box = glm::length(linear[0]) * glm::length(linear[1]) * glm::length(linear[2]);
  if (!(std::fabs(glm::determinant(linear)) > 1e-10 * box))
    fail("its transform cannot be inverted: the determinant is 0");
  return result;
}

camera make_camera(document const& d, std::size_t index, glm::dmat4 const& to_world) {
  tinygltf::Camera const& from = d.model.cameras[index];
  glm::dvec3 const forward = -glm::normalize(glm::dvec3(to_world[2]));
  glm::dvec3 const right = glm::normalize(glm::cross(forward, glm::dvec3(to_world[1])));
  camera result;
  read_properties(d.root["cameras"][index], result);
  result.position = vec3(glm::dvec3(to_world[3]));
  result.forward = vec3(forward);
  result.right = vec3(right);
  result.up = vec3(glm::cross(right, forward));
  if (from.type == "perspective") {
    result.tan_half_yfov = static_cast<real>(std::tan(from.perspective.yfov / 2));
  } else {
    double const height = std::fabs(from.orthographic.ymag) * glm::length(glm::dvec3(to_world[1]));
    if (!(height > 0))
      throw std::runtime_error(element(d.root, "cameras", index) + ": its ymag is 0");
    result.ortho_height = static_cast<real>(height);
  }
  return result;
}

punctual_light make_light(document const& d, std::size_t index, glm::dmat4 const& to_world) {
  tinygltf::Light const& from = d.model.lights[index];
  auto const fail = [&](std::string const& what) {
    throw std::runtime_error("light " + std::to_string(index) + " \"" + from.name + "\": " + what);
  };
  punctual_light result;
  result.position = vec3(glm::dvec3(to_world[3]));
  result.direction = vec3(-glm::normalize(glm::dvec3(to_world[2])));
  glm::dvec3 const color = from.color.empty() ? glm::dvec3(1) : vector(from.color);
  result.intensity = vec3(color * from.intensity);
  if (!(max_component(result.intensity) <= real(1e30)))
    fail("its intensity is beyond the range of a float");
  if (from.type == "directional") {
    result.kind = punctual_light::type::directional;
    return result;
  }
  result.range = static_cast<real>(from.range);
  if (from.type == "point") return result;
  if (from.type != "spot") fail("its type \"" + from.type + "\" is none of glTF's");
  if (!(from.spot.innerConeAngle < from.spot.outerConeAngle))
    fail("its innerConeAngle is not less than its outerConeAngle");
  result.kind = punctual_light::type::spot;
  result.cos_inner = static_cast<real>(std::cos(from.spot.innerConeAngle));
  result.cos_outer = static_cast<real>(std::cos(from.spot.outerConeAngle));
  return result;
}

}  // namespace path_tracer::gltf
