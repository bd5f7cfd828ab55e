// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "scene/math.hpp"

namespace path_tracer {

// An effect is a struct in a file of its own under effects/, with a line in the list of
// effects.hpp. It has
//   static constexpr char const* name                  for --effects and --explain
// and of the following what it needs; what it leaves out costs nothing:
//   struct material_part, camera_part, scene_part      what it adds to a material, the camera, ...
//   ..._properties                                     ... and where glTF has that
//   static bool fits(material)                         of a shader: whether it is this material's
//   static auto bsdf(point)                            makes it a shader, which gives this BSDF
//   static void prepare(material&)                     what is computed once per material
//   static bool in_material, in_camera, in_scene       of what is no shader: who calls for it
//   static std::string callers(scene)                  who that is, if not just "the scene"
//   static void load(scene&, folder)                   reads other files, beside that of the scene
//   static void leave_out(scene&)                      takes away what is not in its parts
//   using path_state                                   what a path remembers, zero at first
//   static void camera_ray(camera, random, ray&)       changes a ray from the camera
//   static void at_glass(batch, i, point&)              changes a hit on glass
// Arguments are templates, because an effect comes before the material that it is a part of. A
// part as it is constructed means that there is no such effect.

inline constexpr std::int32_t no_texture = -1;

/// From this share of metal on, a material is a conductor.
inline constexpr real metal_from = real(0.99);

/// Some of a scene's elements: the first by its number and, where it has one, its name, and how
/// many more: `light 0 "sun" and 2 more`.
inline std::string some_of(char const* kind, std::size_t first,
                           std::vector<std::string> const& names, std::size_t count) {
  std::string result = std::string(kind) + " " + std::to_string(first);
  if (first < names.size() && !names[first].empty()) result += " \"" + names[first] + "\"";
  if (count > 1) result += " and " + std::to_string(count - 1) + " more";
  return result;
}

template <class Part, class T>
using member_of = T Part::*;

/// A property of glTF: a path below a material, a camera or a scene, `extras` among it, and the
/// member of `Part` that takes its value. A number or colour has a range.
template <class Part>
struct property {
  char const* path;
  member_of<Part, real> number = nullptr;
  member_of<Part, vec3> color = nullptr;
  member_of<Part, bool> flag = nullptr;
  double low = 0, high = 0;
  char const* word = nullptr;  ///< the text that sets the flag
  member_of<Part, std::string> text = nullptr;
};

template <class Part>
constexpr property<Part> number_property(char const* path, real Part::*member, double low,
                                         double high) {
  return {path, member, nullptr, nullptr, low, high, nullptr};
}
template <class Part>
constexpr property<Part> color_property(char const* path, vec3 Part::*member, double low,
                                        double high) {
  return {path, nullptr, member, nullptr, low, high, nullptr};
}
template <class Part>
constexpr property<Part> word_property(char const* path, char const* word, bool Part::*member) {
  return {path, nullptr, nullptr, member, 0, 0, word};
}
template <class Part>
constexpr property<Part> text_property(char const* path, std::string Part::*member) {
  return {path, nullptr, nullptr, nullptr, 0, 0, nullptr, member};
}

}  // namespace path_tracer
