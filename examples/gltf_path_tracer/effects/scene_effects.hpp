// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bitset>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.hpp"

namespace path_tracer {

/// A set of effects at run time: bit number_of<Effect>.
using effect_bits = std::bitset<effect_count>;

/// The names of all effects, in the order of their bits.
std::vector<std::string_view> effect_names();
std::string join_names(effect_bits effects);

/// The set of effects that `names`, separated by commas, lists. Throws std::invalid_argument.
effect_bits effects_named(std::string_view names);

/// Gives a material the first shader of `allowed` that fits it, matte if none does.
void choose_shader(material& m, effect_bits allowed);

/// Removes the effects that are not in `allowed` from a scene. Its materials get other shaders.
void leave_out_others(scene& s, effect_bits allowed);

/// The effects that a picture of the scene needs: those of its triangles' materials, its camera and
/// its lights.
effect_bits called_for(scene const& s);

/// Their shaders, and that of rays which leave the scene.
std::bitset<shader_count> shaders_of(effect_bits effects);

/// The names of all shaders, in the order of the table: those of their effects, then `miss`.
std::vector<std::string_view> shader_names();

/// The number of the smallest declared set that covers these effects; the number of declared sets,
/// for the set of all effects, if none does.
std::size_t variant_for(effect_bits effects);
effect_bits effects_of_variant(std::size_t variant);

/// Which effects the scene calls for and by what, the shaders among them, which variant was chosen,
/// and what it leaves out: lines of text.
std::string explain(scene const& s, std::size_t variant);

}  // namespace path_tracer
