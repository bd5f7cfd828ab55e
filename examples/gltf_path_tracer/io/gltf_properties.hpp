// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <type_traits>

#include "effects/scene_effects.hpp"
#include "io/gltf_document.hpp"

// The properties that effects read from a file: see effect.hpp.
namespace path_tracer::gltf {

template <class Effect, class = void>
inline constexpr bool has_material_properties = false;
template <class Effect>
inline constexpr bool
    has_material_properties<Effect, std::void_t<decltype(Effect::material_properties)>> = true;
template <class Effect, class = void>
inline constexpr bool has_camera_properties = false;
template <class Effect>
inline constexpr bool
    has_camera_properties<Effect, std::void_t<decltype(Effect::camera_properties)>> = true;
template <class Effect, class = void>
inline constexpr bool has_scene_properties = false;
template <class Effect>
inline constexpr bool
    has_scene_properties<Effect, std::void_t<decltype(Effect::scene_properties)>> = true;

/// Calls `f(path, property)` for every property of every effect; `path` is that of a rule.
template <class Function>
void for_each_property(Function const& f) {
  for_each_effect(all_effects{}, [&](auto effect) {
    using type = decltype(effect);
    if constexpr (has_material_properties<type>)
      for (auto const& p : type::material_properties) f(std::string("materials/*/") + p.path, p);
    if constexpr (has_camera_properties<type>)
      for (auto const& p : type::camera_properties) f(std::string("cameras/*/") + p.path, p);
    if constexpr (has_scene_properties<type>)
      for (auto const& p : type::scene_properties) f(std::string("scenes/*/") + p.path, p);
  });
}

/// Takes the value of a property from the element `from` of a file, if it has one.
template <class Part>
void read_property(json const& from, property<Part> const& p, Part& part) {
  json::json_pointer const at("/" + std::string(p.path));
  if (!from.contains(at)) return;
  json const& value = from.at(at);
  if (p.number != nullptr) part.*p.number = static_cast<real>(value.get<double>());
  if (p.flag != nullptr) part.*p.flag = value == p.word;
  if (p.text != nullptr) part.*p.text = value.get<std::string>();
  if (p.color == nullptr) return;
  for (int k = 0; k < 3; ++k)
    (part.*p.color)[k] = static_cast<real>(value[static_cast<std::size_t>(k)].get<double>());
}

/// The same for all properties of a material, of a camera or of a scene.
inline void read_properties(json const& from, material& m) {
  for_each_effect(all_effects{}, [&](auto effect) {
    using type = decltype(effect);
    if constexpr (has_material_properties<type>)
      for (auto const& p : type::material_properties)
        read_property<typename type::material_part>(from, p, m);
  });
}
inline void read_properties(json const& from, camera& c) {
  for_each_effect(all_effects{}, [&](auto effect) {
    using type = decltype(effect);
    if constexpr (has_camera_properties<type>)
      for (auto const& p : type::camera_properties)
        read_property<typename type::camera_part>(from, p, c);
  });
}
inline void read_properties(json const& from, scene& s) {
  for_each_effect(all_effects{}, [&](auto effect) {
    using type = decltype(effect);
    if constexpr (has_scene_properties<type>)
      for (auto const& p : type::scene_properties)
        read_property<typename type::scene_part>(from, p, s);
  });
}

}  // namespace path_tracer::gltf
