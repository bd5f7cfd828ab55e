// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/bvh.hpp"
#include "scene/scene.hpp"

namespace path_tracer {

/// A bounding volume hierarchy in host memory.
struct bvh {
  std::vector<bvh_node> nodes;
  std::vector<bvh_triangle> triangles;  ///< in the order of the leaves
  bvh_view view() const { return {nodes.data(), triangles.data()}; }
};

/// Builds a hierarchy by the surface area heuristic over 16 bins per axis (Wald 2007). The same
/// input gives the same hierarchy. Any finite input is valid: a triangle without area is kept and
/// never hit, and no hierarchy is deeper than max_bvh_depth. A box holds its triangles at all times
/// between their own place and that of `motion`, which is empty if nothing moves. Throws
/// std::length_error for more than 2^28 triangles.
bvh build_bvh(std::vector<triangle> const& triangles,
              std::vector<triangle_motion> const& motion = {});

}  // namespace path_tracer
