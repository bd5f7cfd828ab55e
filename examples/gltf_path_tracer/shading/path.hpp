// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "effects/effects.hpp"
#include "scene/math.hpp"
#include "shading/packed.hpp"
#include "shading/random.hpp"

namespace path_tracer {

// The state of paths between stages, in memory.
#ifdef PATH_TRACER_COMPACT
using stored_direction = packed_direction;
using stored_color = packed_color;
#else
using stored_direction = vec3;
using stored_color = vec3;
#endif

/// The paths of one batch, an array per field; request i of the library is path i. A batch covers
/// the items first, first + 1, ... of the image, of which number k is sample k / pixels of the
/// pixel k % pixels: neighbours in a batch are neighbours in the picture.
struct basic_batch {
  vec3* origin;                 ///< the ray to trace next
  stored_direction* direction;  ///< a unit vector
  stored_color* throughput;     ///< 0: the path is finished
  stored_color* radiance;       ///< collected so far
  real* pdf;  ///< with which the BSDF took `direction`; 0: no light sample could have

  std::uint32_t* primitive;  ///< what the ray hit
  vec2* barycentric;
  std::uint8_t* id;  ///< the shader to run, or `finished`

  vec3* shadow_origin;
  vec3* shadow_vector;         ///< from there to the light
  stored_color* shadow_light;  ///< what arrives if nothing is between; 0: nothing to trace

  std::uint64_t first;
  std::uint64_t seed;
  std::uint32_t pixels;
  std::uint32_t bounce;  ///< 0 for rays from the camera
  std::uint32_t max_depth;
  std::uint32_t roulette_from;  ///< the surface hit from which on paths may end at random

  PT_HD std::uint32_t pixel(std::uint32_t i) const {
    return static_cast<std::uint32_t>((first + i) % pixels);
  }
  PT_HD random_stream random(std::uint32_t i) const {
    return {seed, pixel(i), static_cast<std::uint32_t>((first + i) / pixels)};
  }
};

/// The state of each path that an effect adds: an array, if the set has the effect and it needs
/// one.
template <class Effect, class Set,
          bool Exists = Set::template has<Effect>&& detail::has_path_state<Effect>>
struct path_array {
  static constexpr bool exists = false;
};
template <class Effect, class Set>
struct path_array<Effect, Set, true> {
  static constexpr bool exists = true;
  typename Effect::path_state* states;
};
template <class Set, class Effects>
struct path_arrays;
template <class Set, class... Effects>
struct path_arrays<Set, effect_list<Effects...>> : path_array<Effects, Set>... {};

/// The batch of a renderer that simulates a set of effects.
template <class Set>
struct batch_view : basic_batch, path_arrays<Set, all_effects> {
  template <class Effect>
  PT_HD auto& state(std::uint32_t i) const {
    return path_array<Effect, Set>::states[i];
  }
};

/// The use of each pair of random numbers. A bounce has four; the camera has one before them all.
enum class draw : std::uint32_t { light, light_point, direction, lobe_and_roulette };

PT_HD inline std::uint32_t pair_of(draw d, std::uint32_t bounce) {
  return 1 + 4 * bounce + static_cast<std::uint32_t>(d);
}

}  // namespace path_tracer
