// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>
#include <utility>

#include "io/gltf_parts.hpp"

namespace path_tracer::gltf {
namespace {

/// The smallest box that holds what was added.
struct box {
  glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-low};

  void add(glm::dvec3 p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
};

void add_mesh(document const& d, std::size_t mesh, glm::dmat4 const& to_world, box& all) {
  for (tinygltf::Primitive const& primitive : d.model.meshes[mesh].primitives) {
    auto const position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) continue;
    tinygltf::Accessor const& a = d.model.accessors[static_cast<std::size_t>(position->second)];
    std::vector<double> const &low = a.minValues, &high = a.maxValues;
    if (a.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT || low.size() != 3 || high.size() != 3)
      continue;
    for (int corner = 0; corner < 8; ++corner) {
      glm::dvec4 p(0, 0, 0, 1);
      for (int k = 0; k < 3; ++k)
        p[k] = (corner >> k & 1) != 0 ? high[std::size_t(k)] : low[std::size_t(k)];
      all.add(glm::dvec3(to_world * p));
    }
  }
}

}  // namespace

glm::dvec3 centre_far_away(document const& d, std::vector<int> const& roots) {
  box all;
  std::vector<bool> seen(d.model.nodes.size());
  std::vector<std::pair<std::size_t, glm::dmat4>> stack;
  auto const push = [&](std::vector<int> const& nodes, glm::dmat4 const& to_parent) {
    for (int const n : nodes) stack.push_back({static_cast<std::size_t>(n), to_parent});
  };
  push(roots, glm::dmat4(1));
  while (!stack.empty()) {
    auto const [index, to_parent] = stack.back();
    stack.pop_back();
    if (seen[index]) continue;
    seen[index] = true;
    tinygltf::Node const& node = d.model.nodes[index];
    glm::dmat4 const to_world = to_parent * local_transform(d, index);
    if (node.mesh >= 0) add_mesh(d, static_cast<std::size_t>(node.mesh), to_world, all);
    push(node.children, to_world);
  }
  glm::dvec3 const centre = 0.5 * (all.low + all.high);
  double const radius = 0.5 * glm::length(all.high - all.low), away = glm::length(centre);
  bool const is_far = radius > 0 && away > 8 * radius && away <= farthest;
  return is_far ? centre : glm::dvec3(0);
}

}  // namespace path_tracer::gltf
