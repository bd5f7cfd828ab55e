// SPDX-License-Identifier: Apache-2.0
#include "scene/bvh_builder.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace path_tracer {
namespace {

constexpr int bin_count = 16;
constexpr std::uint32_t good_leaf_size = 2;
constexpr real infinity = std::numeric_limits<real>::infinity();

struct box {
  vec3 lower{infinity};
  vec3 upper{-infinity};

  void add(vec3 p) {
    lower = glm::min(lower, p);
    upper = glm::max(upper, p);
  }
  void add(box const& b) {
    lower = glm::min(lower, b.lower);
    upper = glm::max(upper, b.upper);
  }
  double half_area() const {  // in double: no overflow for any finite box
    if (!(lower.x <= upper.x)) return 0;
    glm::dvec3 const e = glm::dvec3(upper) - glm::dvec3(lower);
    return e.x * e.y + e.y * e.z + e.z * e.x;
  }
};

void store(vec3 v, real (&to)[3]) {
  for (int k = 0; k < 3; ++k) to[k] = v[k];
}
void store(box const& b, real (&to)[2][3]) {
  store(b.lower, to[0]);
  store(b.upper, to[1]);
}

struct item {
  box bounds;
  vec3 centroid;
  std::uint32_t primitive;
};

struct split {
  double cost = std::numeric_limits<double>::infinity();
  int axis = 0;
  int bin = 0;  ///< items in bins below this one go left
};

int levels_for(std::size_t count) {  // of a balanced tree
  int levels = 0;
  while ((std::size_t{1} << levels) < count) ++levels;
  return levels;
}

class builder {
 public:
  builder(std::vector<triangle> const& triangles, std::vector<triangle_motion> const& motion)
      : triangles_(triangles) {
    items_.reserve(triangles.size());
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
      item it;
      for (vec3 const& p : triangles[i].position) it.bounds.add(p);
      if (!motion.empty())
        for (vec3 const& p : motion[i].position) it.bounds.add(p);
      it.centroid = it.bounds.lower * real(0.5) + it.bounds.upper * real(0.5);
      it.primitive = i;
      items_.push_back(it);
    }
    result_.triangles.reserve(items_.size());
  }

  bvh run() {
    if (items_.size() <= good_leaf_size) {  // the root is always an inner node
      bvh_node root = empty_node();
      if (!items_.empty()) set_child(root, 0, 0, items_.size(), 1);
      result_.nodes.push_back(root);
    } else {
      build(0, items_.size(), 1);
    }
    return std::move(result_);
  }

 private:
  static bvh_node empty_node() {
    bvh_node node;
    for (int k = 0; k < 2; ++k) {
      store(box{}, node.corner[k]);
      node.child[k] = 0;
    }
    return node;
  }

  /// The inner node over [first, last) at this depth; the root has depth 1.
  std::uint32_t build(std::size_t first, std::size_t last, int depth) {
    auto const index = static_cast<std::uint32_t>(result_.nodes.size());
    result_.nodes.push_back(empty_node());
    std::size_t const middle = partition(first, last, depth);
    bvh_node node = empty_node();
    set_child(node, 0, first, middle, depth + 1);
    set_child(node, 1, middle, last, depth + 1);
    result_.nodes[index] = node;
    return index;
  }

  void set_child(bvh_node& node, int side, std::size_t first, std::size_t last, int depth) {
    box bounds;
    for (std::size_t i = first; i < last; ++i) bounds.add(items_[i].bounds);
    store(bounds, node.corner[side]);
    std::size_t const count = last - first;
    if (count > good_leaf_size) {
      node.child[side] = build(first, last, depth);
      return;
    }
    auto const start = static_cast<std::uint32_t>(result_.triangles.size());
    node.child[side] = leaf_flag | (static_cast<std::uint32_t>(count - 1) << 28) | start;
    for (std::size_t i = first; i < last; ++i) {
      bvh_triangle t{{}, items_[i].primitive};
      for (int k = 0; k < 3; ++k) store(triangles_[t.primitive].position[k], t.corner[k]);
      result_.triangles.push_back(t);
    }
  }

  /// Orders [first, last) so that the left child is [first, result): by the surface area heuristic,
  /// or in equal halves when that finds nothing or the levels left would not suffice.
  std::size_t partition(std::size_t first, std::size_t last, int depth) {
    std::size_t const half = first + (last - first) / 2;
    box centroids;
    for (std::size_t i = first; i < last; ++i) centroids.add(items_[i].centroid);
    auto const begin = items_.begin() + static_cast<std::ptrdiff_t>(first);
    auto const end = items_.begin() + static_cast<std::ptrdiff_t>(last);
    if (depth + levels_for(last - first) < max_bvh_depth) {
      split const best = find_split(first, last, centroids);
      if (best.cost < std::numeric_limits<double>::infinity())
        return static_cast<std::size_t>(std::partition(begin, end,
                                                       [&](item const& it) {
                                                         return bin_of(it, best.axis, centroids) <
                                                                best.bin;
                                                       }) -
                                        items_.begin());
    }
    vec3 const extent = centroids.upper - centroids.lower;
    int const axis =
        extent.x > extent.y ? (extent.x > extent.z ? 0 : 2) : (extent.y > extent.z ? 1 : 2);
    std::nth_element(begin, items_.begin() + static_cast<std::ptrdiff_t>(half), end,
                     [axis](item const& a, item const& b) {
                       return a.centroid[axis] != b.centroid[axis]
                                  ? a.centroid[axis] < b.centroid[axis]
                                  : a.primitive < b.primitive;
                     });
    return half;
  }

  static int bin_of(item const& it, int axis, box const& centroids) {  // in double: never 0 / 0
    double const extent = double{centroids.upper[axis]} - double{centroids.lower[axis]};
    double const offset = double{it.centroid[axis]} - double{centroids.lower[axis]};
    return std::min(static_cast<int>(offset / extent * bin_count), bin_count - 1);
  }

  split find_split(std::size_t first, std::size_t last, box const& centroids) const {
    split best;
    for (int axis = 0; axis < 3; ++axis) {
      if (!(centroids.lower[axis] < centroids.upper[axis])) continue;
      box bounds[bin_count];
      std::size_t count[bin_count] = {};
      for (std::size_t i = first; i < last; ++i) {
        int const bin = bin_of(items_[i], axis, centroids);
        bounds[bin].add(items_[i].bounds);
        ++count[bin];
      }
      double right_cost[bin_count] = {};
      box right;
      std::size_t right_count = 0;
      for (int bin = bin_count - 1; bin > 0; --bin) {
        right.add(bounds[bin]);
        right_count += count[bin];
        right_cost[bin] = right.half_area() * static_cast<double>(right_count);
      }
      box left;
      std::size_t left_count = 0;
      for (int bin = 1; bin < bin_count; ++bin) {
        left.add(bounds[bin - 1]);
        left_count += count[bin - 1];
        if (left_count == 0 || left_count == last - first) continue;
        double const cost = left.half_area() * static_cast<double>(left_count) + right_cost[bin];
        if (cost < best.cost) best = {cost, axis, bin};
      }
    }
    return best;
  }

  std::vector<triangle> const& triangles_;
  std::vector<item> items_;
  bvh result_;
};

}  // namespace

bvh build_bvh(std::vector<triangle> const& triangles, std::vector<triangle_motion> const& motion) {
  if (triangles.size() > max_bvh_triangles)
    throw std::length_error("build_bvh: " + std::to_string(triangles.size()) +
                            " triangles, at most 2^28 are possible");
  return builder{triangles, motion}.run();
}

}  // namespace path_tracer
