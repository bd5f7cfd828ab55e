// SPDX-License-Identifier: Apache-2.0
#include "effects/scene_effects.hpp"

#include <algorithm>
#include <deferred_shade/specialized.hpp>
#include <stdexcept>
#include <type_traits>

namespace path_tracer {
namespace {

template <class Function>
void for_each(Function const& f) {
  for_each_effect(all_effects{}, f);
}

// Which of the members in effect.hpp an effect has.
template <class E, class = void>
constexpr bool has_prepare = false;
template <class E>
constexpr bool has_prepare<E, std::void_t<decltype(&E::template prepare<material>)>> = true;
template <class E, class = void>
constexpr bool has_in_material = false;
template <class E>
constexpr bool has_in_material<E, std::void_t<decltype(&E::template in_material<material>)>> = true;
template <class E, class = void>
constexpr bool has_in_camera = false;
template <class E>
constexpr bool has_in_camera<E, std::void_t<decltype(&E::template in_camera<camera>)>> = true;
template <class E, class = void>
constexpr bool has_in_scene = false;
template <class E>
constexpr bool has_in_scene<E, std::void_t<decltype(&E::template in_scene<scene>)>> = true;
template <class E, class = void>
constexpr bool has_callers = false;
template <class E>
constexpr bool has_callers<E, std::void_t<decltype(&E::template callers<scene>)>> = true;
template <class E, class = void>
constexpr bool has_leave_out = false;
template <class E>
constexpr bool has_leave_out<E, std::void_t<decltype(&E::template leave_out<scene>)>> = true;

/// Whether a material calls for an effect.
template <class Effect>
bool calls_for(material const& m) {
  bool calls = false;
  if constexpr (detail::has_shader<Effect>) calls = m.kind == shader_of<Effect>;
  if constexpr (has_in_material<Effect>) calls = calls || Effect::in_material(m);
  return calls;
}

template <class Effect>
bool calls_for(camera const& c) {
  if constexpr (has_in_camera<Effect>) return Effect::in_camera(c);
  return false;
}

template <class Effect>
bool calls_for(scene const& s) {
  if constexpr (has_in_scene<Effect>) return Effect::in_scene(s);
  return false;
}

std::vector<bool> used_materials(scene const& s) {
  std::vector<bool> used(s.materials.size());
  for (triangle const& t : s.triangles) used[t.material] = true;
  return used;
}

template <class... Effects>
effect_bits bits_of(effects_of<Effects...>) {
  return {set_of<effects_of<Effects...>>::bits};
}

/// The declared sets, in terms of the library's variants of a table.
template <class Set>
struct ids_of;
template <class... Effects>
struct ids_of<effects_of<Effects...>> {
  using type = deferred_shade::ids<number_of<Effects>...>;
};
template <class... Sets>
deferred_shade::variants<typename ids_of<Sets>::type...> variants_of(effect_list<Sets...>) {
  return {};
}

/// What calls for an effect, as `material 3 "lamp" and 2 more`; empty if nothing does.
template <class Effect>
std::string callers(scene const& s, std::vector<bool> const& used) {
  std::string result;
  std::size_t first = 0, count = 0;
  for (std::size_t k = 0; k < s.materials.size(); ++k) {
    if (!used[k] || !calls_for<Effect>(s.materials[k])) continue;
    if (count++ == 0) first = k;
  }
  auto const add = [&](std::string const& who) { result += (result.empty() ? "" : ", ") + who; };
  if (count > 0) add(some_of("material", first, s.material_names, count));
  if (calls_for<Effect>(s.view)) add("the camera");
  if (calls_for<Effect>(s)) {
    if constexpr (has_callers<Effect>) {
      add(Effect::callers(s));
    } else {
      add("the scene");
    }
  }
  return result;
}

}  // namespace

std::vector<std::string_view> effect_names() {
  std::vector<std::string_view> names;
  for_each([&](auto e) { names.push_back(decltype(e)::name); });
  return names;
}

std::string join_names(effect_bits effects) {
  auto const names = effect_names();
  std::string result;
  for (std::size_t k = 0; k < names.size(); ++k)
    if (effects[k]) result += (result.empty() ? "" : ", ") + std::string(names[k]);
  return result;
}

effect_bits effects_named(std::string_view list) {
  auto const names = effect_names();
  effect_bits result;
  while (true) {
    std::string_view const name = list.substr(0, list.find(','));
    auto const found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
      throw std::invalid_argument("there is no effect \"" + std::string(name) + "\", only " +
                                  join_names(effect_bits().set()));
    result.set(static_cast<std::size_t>(found - names.begin()));
    if (name.size() == list.size()) return result;
    list.remove_prefix(name.size() + 1);
  }
}

void choose_shader(material& m, effect_bits allowed) {
  bool found = false;
  m.kind = shader_of<effects::matte>;
  for_each([&](auto e) {
    using effect = decltype(e);
    if constexpr (has_prepare<effect> && !detail::has_shader<effect>) effect::prepare(m);
    if constexpr (detail::has_shader<effect>) {
      if (found || !allowed[number_of<effect>] || !effect::fits(m)) return;
      found = true;
      m.kind = shader_of<effect>;
      if constexpr (has_prepare<effect>) effect::prepare(m);
    }
  });
}

void leave_out_others(scene& s, effect_bits allowed) {
  for_each([&](auto e) {
    using effect = decltype(e);
    if (allowed[number_of<effect>]) return;
    using material_part = typename detail::material_part_of<effect>::type;
    for (material& m : s.materials) static_cast<material_part&>(m) = material_part{};
    using camera_part = typename detail::camera_part_of<effect>::type;
    static_cast<camera_part&>(s.view) = camera_part{};
    using scene_part = typename detail::scene_part_of<effect>::type;
    static_cast<scene_part&>(s) = scene_part{};
    if constexpr (has_leave_out<effect>) effect::leave_out(s);
  });
  for (material& m : s.materials) choose_shader(m, allowed);
}

effect_bits called_for(scene const& s) {
  effect_bits result;
  auto const used = used_materials(s);
  for_each([&](auto e) {
    using effect = decltype(e);
    bool calls = calls_for<effect>(s) || calls_for<effect>(s.view);
    for (std::size_t k = 0; k < s.materials.size() && !calls; ++k)
      calls = used[k] && calls_for<effect>(s.materials[k]);
    result[number_of<effect>] = calls;
  });
  return result;
}

std::bitset<shader_count> shaders_of(effect_bits effects) {
  std::bitset<shader_count> result;
  for (std::size_t k = 0; k + 1 < result.size(); ++k) result[k] = effects[k];
  return result.set(static_cast<std::size_t>(miss));
}

std::vector<std::string_view> shader_names() {
  auto names = effect_names();
  names.resize(shader_count);
  names.back() = "miss";
  return names;
}

std::size_t variant_for(effect_bits effects) {
  return decltype(variants_of(declared_sets{}))::covering(effects);
}

effect_bits effects_of_variant(std::size_t variant) {
  effect_bits result = effect_bits().set();
  std::size_t number = 0;
  for_each_effect(declared_sets{}, [&](auto set) {
    if (number++ == variant) result = bits_of(set);
  });
  return result;
}

std::string explain(scene const& s, std::size_t variant) {
  auto const used = used_materials(s);
  auto const names = effect_names();
  std::size_t width = 0;
  for (std::string_view const name : names) width = std::max(width, name.size());
  std::string result = "The scene calls for\n";
  for_each([&](auto e) {
    std::string const by = callers<decltype(e)>(s, used);
    std::string const name = decltype(e)::name;
    if (!by.empty()) result += "  " + name + std::string(width + 2 - name.size(), ' ') + by + "\n";
  });
  effect_bits const called = called_for(s);
  effect_bits const shaders = called & effect_bits((1u << (shader_count - 1)) - 1);
  result += "Its shaders: " + std::to_string(shaders.count()) + " (" + join_names(shaders) +
            "), and that of rays which leave it\n";
  effect_bits const compiled = effects_of_variant(variant);
  result += "It runs code for " + (compiled.all() ? "all effects" : join_names(compiled)) + "\n";
  if (effect_bits const others = compiled & ~called; others.any())
    result += "... of which it does not call for " + join_names(others) + "\n";
  if (!compiled.all()) result += "Left out: " + join_names(~compiled) + "\n";
  return result;
}

}  // namespace path_tracer
