// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

#include "io/gltf_document.hpp"
#include "scene/scene.hpp"

namespace path_tracer::gltf {

/// More triangles than this are refused: 100 bytes each, and instances multiply quickly.
inline constexpr std::size_t maximum_triangles = std::size_t{1} << 26;

/// Squares of squares of lengths have to fit into a float: no coordinate in world space is larger.
inline constexpr double farthest = 1e9;

/// Transforms to world space when the shutter opens and when it closes.
struct placement {
  glm::dmat4 open, close;
};

/// Appends all triangles of a mesh, with their motion, seen through transforms whose determinants
/// are not 0. Triangles without an area are left out. Throws std::runtime_error.
void append_mesh(document& d, std::size_t mesh, placement const& place, scene& out);

/// Appends all materials of the file, the default one after them, and the textures they use.
void append_materials(document& d, scene& out);

/// The animated values of a node at a moment; values that are not animated are empty.
struct pose {
  std::vector<double> translation, rotation, scale;
};

/// The animations of a file.
class animations {
 public:
  animations() = default;
  /// Throws std::runtime_error if an animation has keys that do not fit together.
  explicit animations(document& d);
  pose at(std::size_t node, double seconds) const;

 private:
  struct channel {
    std::size_t node;
    std::string path;
    bool steps;
    std::vector<double> times;
    std::vector<std::vector<double>> values;
  };
  void add(document& d, tinygltf::Animation const& animation,
           tinygltf::AnimationChannel const& from);
  [[noreturn]] void fail(std::string const& what) const;

  std::string where_;  ///< the animation at hand
  std::vector<channel> channels_;
};

/// The centre of the meshes below these nodes, by the bounds that their accessors state, if it is
/// far from the origin relative to their extent; else 0.
glm::dvec3 centre_far_away(document const& d, std::vector<int> const& roots);

/// Transform of a node to its parent. Throws std::runtime_error if it cannot be inverted.
glm::dmat4 local_transform(document const& d, std::size_t node, pose const& animated = {});

/// The first camera of the traversal, and a light, as a node places them.
camera make_camera(document const& d, std::size_t index, glm::dmat4 const& to_world);
punctual_light make_light(document const& d, std::size_t index, glm::dmat4 const& to_world);

}  // namespace path_tracer::gltf
