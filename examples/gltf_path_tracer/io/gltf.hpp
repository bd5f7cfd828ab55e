// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "effects/scene_effects.hpp"
#include "scene/scene.hpp"

namespace path_tracer {

/// Reads a glTF 2.0 file, .gltf or .glb: its default scene, all nodes expanded to triangles in
/// world space, the first camera in depth-first order, and all materials.
///
/// Effects outside `allowed` are left out (leave_out_others), and files that only they need are not
/// read. A material runs the first allowed shader of `all_effects` that fits it:
/// | emissiveFactor * emissiveStrength > 0                      | emitters                      |
/// | extras: {"shader": "marble" or "wood"}                     | marble, wood                  |
/// | transmission > 0, metallic < 0.99                          | smooth_glass, or rough_glass  |
/// | clearcoat > 0                                              | clearcoat                     |
/// | sheen colour > 0                                           | sheen                         |
/// | iridescence > 0                                            | iridescence                   |
/// | anisotropy > 0                                             | anisotropy                    |
/// | metallic >= 0.99, no metallic-roughness texture            | metal                         |
/// | metallic = 0, specular factor = 0                          | matte                         |
/// | all else                                                   | plastic                       |
/// Glass is smooth when its roughness is below 0.03, where a GGX lobe (alpha < 0.0009) is narrower
/// than a pixel; that roughness then becomes 0.
///
/// `extras` understood: "shader", "second_color", "pattern_scale" of a material, "background" of a
/// scene, and those of the effects (docs/effects.md). Anything else in the file that a picture
/// could show is left out, and named in scene::warnings, in one line for each kind. Clipping
/// planes, aspect ratio and mip filters are left out silently.
///
/// Extensions understood: KHR_lights_punctual and KHR_materials_{emissive_strength, ior,
/// transmission, specular} and those of the effects, all without their textures. Sparse accessors
/// are refused.
///
/// Throws std::runtime_error with one line that names the file and the element: for a file that
/// cannot be read, that breaks the rules of glTF, that requires another extension, or that holds no
/// camera or no triangle.
scene load_gltf(std::string const& path, effect_bits allowed = effect_bits().set());

}  // namespace path_tracer
