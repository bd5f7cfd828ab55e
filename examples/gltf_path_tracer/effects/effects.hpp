// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/specialized.hpp>
#include <tuple>
#include <type_traits>

#include "effects/absorption.hpp"
#include "effects/anisotropy.hpp"
#include "effects/clearcoat.hpp"
#include "effects/depth_of_field.hpp"
#include "effects/dispersion.hpp"
#include "effects/emitters.hpp"
#include "effects/environment.hpp"
#include "effects/glass.hpp"
#include "effects/iridescence.hpp"
#include "effects/marble.hpp"
#include "effects/medium.hpp"
#include "effects/motion_blur.hpp"
#include "effects/opaque.hpp"
#include "effects/punctual_lights.hpp"
#include "effects/sheen.hpp"
#include "effects/textures.hpp"
#include "effects/wood.hpp"

namespace path_tracer {

template <class... Effects>
struct effect_list {};

/// All effects. Those with a shader come first: a material runs the first that fits it.
// clang-format off
using all_effects = effect_list<
    effects::marble,
    effects::wood,
    effects::smooth_glass,
    effects::rough_glass,
    effects::clearcoat,
    effects::sheen,
    effects::iridescence,
    effects::anisotropy,
    effects::metal,
    effects::emitters,
    effects::matte,
    effects::plastic,
    effects::medium,
    effects::textures,
    effects::normal_maps,
    effects::punctual_lights,
    effects::environment,
    effects::absorption,
    effects::dispersion,
    effects::motion_blur,
    effects::depth_of_field>;
// clang-format on

/// The sets of effects that code is compiled for, besides the set of all. The smallest set that has
/// all effects of a scene renders it. Each set is compiled once per backend.
template <class... Effects>
struct effects_of {};
using declared_sets =
    effect_list<effects_of<effects::emitters, effects::matte>,
                effects_of<effects::emitters, effects::smooth_glass, effects::rough_glass,
                           effects::clearcoat, effects::sheen, effects::metal, effects::matte,
                           effects::plastic, effects::punctual_lights>>;

namespace detail {

template <class Effect, class... Effects>
constexpr int position_in(effect_list<Effects...>) {
  int position = 0;
  bool found = false;
  ((found = found || std::is_same_v<Effect, Effects>, position += found ? 0 : 1), ...);
  return position;
}
template <class... Effects>
constexpr int count_of(effect_list<Effects...>) {
  return static_cast<int>(sizeof...(Effects));
}

template <int Number, class Effects>
struct element_of;
template <int Number, class... Effects>
struct element_of<Number, effect_list<Effects...>> {
  using type = std::tuple_element_t<std::size_t{Number}, std::tuple<Effects...>>;
};

struct any;  // stands for whatever type an effect is called with
template <class Effect, class = void>
inline constexpr bool has_shader = false;
template <class Effect>
inline constexpr bool has_shader<Effect, std::void_t<decltype(&Effect::template fits<any>)>> = true;

// What an effect adds to a material and the like; nothing, of a type of its own, without a part.
template <class Effect, class = void>
struct material_part_of {
  struct type {};
};
template <class Effect>
struct material_part_of<Effect, std::void_t<typename Effect::material_part>> {
  using type = typename Effect::material_part;
};
template <class Effect, class = void>
struct camera_part_of {
  struct type {};
};
template <class Effect>
struct camera_part_of<Effect, std::void_t<typename Effect::camera_part>> {
  using type = typename Effect::camera_part;
};
template <class Effect, class = void>
struct scene_part_of {
  struct type {};
};
template <class Effect>
struct scene_part_of<Effect, std::void_t<typename Effect::scene_part>> {
  using type = typename Effect::scene_part;
};

template <class Effect, class = void>
inline constexpr bool has_path_state = false;
template <class Effect>
inline constexpr bool has_path_state<Effect, std::void_t<typename Effect::path_state>> = true;
template <class Effect, class = void>
inline constexpr bool changes_camera_rays = false;
template <class Effect>
inline constexpr bool changes_camera_rays<
    Effect, std::void_t<decltype(&Effect::template camera_ray<any, any, any>)>> = true;
template <class Effect, class = void>
inline constexpr bool changes_glass = false;
template <class Effect>
inline constexpr bool
    changes_glass<Effect, std::void_t<decltype(&Effect::template at_glass<any, any>)>> = true;

template <class... Effects>
constexpr int shaders_in(effect_list<Effects...>) {
  return (0 + ... + (has_shader<Effects> ? 1 : 0));
}

}  // namespace detail

inline constexpr int effect_count = detail::count_of(all_effects{});

/// The number of an effect, its bit in a set.
template <class Effect>
inline constexpr int number_of = detail::position_in<Effect>(all_effects{});

template <int Number>
using effect_at = typename detail::element_of<Number, all_effects>::type;

/// The shaders of the path tracer: one for each effect that has one, then that of rays which leave
/// the scene. The value is the position in the table.
enum class shader : std::uint8_t {};
template <class Effect>
inline constexpr shader shader_of{static_cast<std::uint8_t>(number_of<Effect>)};
inline constexpr int shader_count = detail::shaders_in(all_effects{}) + 1;
inline constexpr shader miss{static_cast<std::uint8_t>(shader_count - 1)};

/// The parts of all effects, as bases.
template <class Effects>
struct material_parts;
template <class... Effects>
struct material_parts<effect_list<Effects...>> : detail::material_part_of<Effects>::type... {};
template <class Effects>
struct camera_parts;
template <class... Effects>
struct camera_parts<effect_list<Effects...>> : detail::camera_part_of<Effects>::type... {};
template <class Effects>
struct scene_parts;
template <class... Effects>
struct scene_parts<effect_list<Effects...>> : detail::scene_part_of<Effects>::type... {};

/// A set of effects at compile time.
template <std::uint32_t Bits>
struct effect_set {
  static constexpr std::uint32_t bits = Bits;
  template <class Effect>
  static constexpr bool has = (Bits >> number_of<Effect> & 1u) != 0;
};
using every_effect = effect_set<(std::uint32_t{1} << effect_count) - 1>;

namespace detail {

template <class Set>
struct set_from;
template <class... Effects>
struct set_from<effects_of<Effects...>> {
  using type = effect_set<(0u | ... | (std::uint32_t{1} << number_of<Effects>))>;
};

}  // namespace detail
template <class Declared>
using set_of = typename detail::set_from<Declared>::type;

/// Whether light is sampled at all.
template <class Set>
inline constexpr bool has_lights =
    Set::template has<effects::emitters> || Set::template has<effects::punctual_lights> ||
    Set::template has<effects::environment>;

/// Calls f(effect) for every effect of a list, in order; the argument is an object without members.
template <class Function, class... Effects>
PT_HD constexpr void for_each_effect(effect_list<Effects...>, Function&& f) {
  (f(Effects{}), ...);
}

}  // namespace path_tracer
