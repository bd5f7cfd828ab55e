// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/gtc/quaternion.hpp>

#include "gltf_document.hpp"
#include "scene.hpp"

namespace path_tracer::gltf {

/// More triangles than this are refused: 100 bytes each, and instances multiply quickly.
inline constexpr std::size_t maximum_triangles = std::size_t{1} << 26;

/// Squares of squares of lengths have to fit into a float: no coordinate in world space is larger.
inline constexpr double farthest = 1e9;

/// Appends all triangles of a mesh, seen through `to_world`, whose determinant is not 0. Triangles
/// without an area are left out. Throws std::runtime_error.
void append_mesh(document& d, std::size_t mesh, glm::dmat4 const& to_world, scene& out);

/// Appends all materials of the file, the default one after them, and the textures they use.
void append_materials(document& d, scene& out);

/// Transform of a node to its parent. Throws std::runtime_error if it cannot be inverted.
glm::dmat4 local_transform(document const& d, std::size_t node);

/// The first camera of the traversal, and a light, as a node places them.
camera make_camera(document const& d, std::size_t index, glm::dmat4 const& to_world);
punctual_light make_light(document const& d, std::size_t index, glm::dmat4 const& to_world);

}  // namespace path_tracer::gltf
