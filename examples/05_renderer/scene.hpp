// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "vec.hpp"

enum material : std::uint8_t { matte, checker, mirror, glass, lamp };
constexpr auto ended = static_cast<material>(255);  // no material: the path has ended

struct ray {
  vec origin, direction;
};

/// A sphere of some material, or, if its radius is 0, the floor, y = 0.
struct object {
  material made_of;
  vec colour;  // a lamp's radiance, else what is reflected
  vec centre;
  float radius;
  vec dark{1, 1, 1};  // every other square of a checker
};

constexpr float infinity = std::numeric_limits<float>::infinity();

/// How far along a ray an object is hit; infinity if it is not.
HD inline float distance(object const& o, ray const& r) {
  if (o.radius == 0) {
    float const t = r.direction.y < 0 ? r.origin.y / -r.direction.y : infinity;
    return t > 0 ? t : infinity;
  }
  vec const to_centre = o.centre - r.origin;
  float const middle = dot(to_centre, r.direction);
  vec const beside = to_centre - middle * r.direction;
  float const square = o.radius * o.radius - dot(beside, beside);
  if (square < 0) return infinity;
  float const half = std::sqrt(square);
  return middle - half > 0 ? middle - half : middle + half > 0 ? middle + half : infinity;
}

/// Balls just above a floor, under a lamp. They do not touch: rays start a little off a surface,
/// and would get inside a touching ball. The first object is the sky, a ball around all paths:
/// every ray hits something. In the furnace, surfaces are white and all light has radiance 1: the
/// picture has radiance 1. A kernel may get a scene by value.
struct scene {
  object objects[6]{
      {lamp, {0.25F, 0.375F, 0.5F}, {0, 0, 0}, 1000},
      {checker, {0.8F, 0.8F, 0.75F}, {0, 0, 0}, 0, {0.2F, 0.1F, 0.1F}},
      {lamp, {16, 14, 10}, {-1.5F, 4.2F, 1}, 0.7F},
      {matte, {0.7F, 0.25F, 0.2F}, {-2.2F, 1.05F, 0}, 1},
      {mirror, {0.95F, 0.9F, 0.8F}, {0.2F, 1.25F, -1.5F}, 1.2F},
      {glass, {0.97F, 0.99F, 0.98F}, {1.9F, 0.95F, 0.8F}, 0.9F},
  };

  void make_furnace() {
    for (object& o : objects) o.colour = o.dark = {1, 1, 1};
  }

  /// The object that a ray hits first. Sets `t` to the distance along the ray.
  HD object const& first_hit(ray const& r, float& t) const {
    std::size_t first = 0;
    t = infinity;
    for (std::size_t k = 0; k < sizeof(objects) / sizeof(object); ++k) {
      float const d = distance(objects[k], r);
      if (!(d < t)) continue;
      first = k;
      t = d;
    }
    return objects[first];
  }
};
