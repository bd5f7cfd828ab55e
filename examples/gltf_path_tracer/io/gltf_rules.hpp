// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

// The part of glTF 2.0 that the renderer understands, as data: one rule for each property. Effects
// bring the rules of their own properties. In a path, `*` stands for any element of an array, and
// `@` for the path before it that ends in `/*`.
namespace path_tracer::gltf {

enum class value_type { object, array, number, numbers, integer, index, boolean, text, anything };

struct rule {
  char const* path;
  value_type type;
  double low = 0, high = 0;    ///< inclusive range of a number
  unsigned length = 0;         ///< of `numbers`
  char const* into = nullptr;  ///< JSON pointer to the array that an `index` refers to
};

inline constexpr double any_size = 1e30;  // larger ones would overflow a float when multiplied
inline constexpr double byte_count = 4294967295.0;

constexpr rule object(char const* p) { return {p, value_type::object}; }
constexpr rule array(char const* p) { return {p, value_type::array}; }
constexpr rule text(char const* p) { return {p, value_type::text}; }
constexpr rule boolean(char const* p) { return {p, value_type::boolean}; }
constexpr rule anything(char const* p) { return {p, value_type::anything}; }
constexpr rule index(char const* p, char const* into) {
  return {p, value_type::index, 0, 0, 0, into};
}
constexpr rule integer(char const* p, double low, double high) {
  return {p, value_type::integer, low, high};
}
constexpr rule number(char const* p, double low, double high) {
  return {p, value_type::number, low, high};
}
constexpr rule numbers(char const* p, unsigned length, double low, double high) {
  return {p, value_type::numbers, low, high, length};
}

inline constexpr char const* lights = "/extensions/KHR_lights_punctual/lights";

inline constexpr rule rules[] = {
    object(""),
    anything("asset"),
    array("extensionsUsed"),
    text("extensionsUsed/*"),
    array("extensionsRequired"),
    text("extensionsRequired/*"),
    object("extensions"),
    object("extensions/KHR_lights_punctual"),
    array("extensions/KHR_lights_punctual/lights"),
    object("extensions/KHR_lights_punctual/lights/*"),
    numbers("@color", 3, 0, any_size),
    number("@intensity", 0, any_size),
    number("@range", 0, any_size),
    text("@type"),
    object("@spot"),
    number("@spot/innerConeAngle", 0, 1.5707964),
    number("@spot/outerConeAngle", 0, 1.5707964),

    index("scene", "/scenes"),
    array("scenes"),
    object("scenes/*"),
    array("@nodes"),
    index("@nodes/*", "/nodes"),
    numbers("@extras/background", 3, 0, any_size),
    array("nodes"),
    object("nodes/*"),
    array("@children"),
    index("@children/*", "/nodes"),
    index("@mesh", "/meshes"),
    index("@camera", "/cameras"),
    numbers("@matrix", 16, -any_size, any_size),
    numbers("@translation", 3, -any_size, any_size),
    numbers("@rotation", 4, -1.001, 1.001),
    numbers("@scale", 3, -any_size, any_size),
    object("@extensions"),
    object("@extensions/KHR_lights_punctual"),
    index("@extensions/KHR_lights_punctual/light", lights),
    array("cameras"),
    object("cameras/*"),
    text("@type"),
    object("@perspective"),
    number("@perspective/yfov", 1e-4, 3.14),
    number("@perspective/aspectRatio", 0, any_size),
    number("@perspective/znear", 0, any_size),
    number("@perspective/zfar", 0, any_size),
    object("@orthographic"),
    number("@orthographic/xmag", -any_size, any_size),
    number("@orthographic/ymag", -any_size, any_size),
    number("@orthographic/znear", 0, any_size),
    number("@orthographic/zfar", 0, any_size),

    array("meshes"),
    object("meshes/*"),
    array("@primitives"),
    object("meshes/*/primitives/*"),
    integer("@mode", 0, 6),
    index("@indices", "/accessors"),
    index("@material", "/materials"),
    object("@attributes"),
    index("@attributes/POSITION", "/accessors"),
    index("@attributes/NORMAL", "/accessors"),
    index("@attributes/TEXCOORD_0", "/accessors"),
    array("accessors"),
    object("accessors/*"),
    index("@bufferView", "/bufferViews"),
    integer("@byteOffset", 0, byte_count),
    integer("@componentType", 5120, 5126),
    boolean("@normalized"),
    integer("@count", 1, byte_count),
    text("@type"),
    anything("@min"),
    anything("@max"),
    anything("@sparse"),
    array("bufferViews"),
    object("bufferViews/*"),
    index("@buffer", "/buffers"),
    integer("@byteOffset", 0, byte_count),
    integer("@byteLength", 1, byte_count),
    integer("@byteStride", 4, 252),
    anything("@target"),
    array("buffers"),
    object("buffers/*"),
    text("@uri"),
    integer("@byteLength", 1, byte_count),

    array("animations"),
    object("animations/*"),
    array("@channels"),
    object("animations/*/channels/*"),
    integer("@sampler", 0, byte_count),
    object("@target"),
    index("@target/node", "/nodes"),
    text("@target/path"),
    array("animations/*/samplers"),
    object("animations/*/samplers/*"),
    index("@input", "/accessors"),
    index("@output", "/accessors"),
    text("@interpolation"),

    array("images"),
    object("images/*"),
    text("@uri"),
    text("@mimeType"),
    index("@bufferView", "/bufferViews"),
    array("samplers"),
    object("samplers/*"),
    integer("@magFilter", 9728, 9729),
    integer("@minFilter", 9728, 9987),
    integer("@wrapS", 10497, 33648),
    integer("@wrapT", 10497, 33648),
    array("textures"),
    object("textures/*"),
    index("@sampler", "/samplers"),
    index("@source", "/images"),

    array("materials"),
    object("materials/*"),
    boolean("@doubleSided"),
    numbers("@emissiveFactor", 3, 0, any_size),
    object("@emissiveTexture"),
    index("@emissiveTexture/index", "/textures"),
    integer("@emissiveTexture/texCoord", 0, 65535),
    text("@alphaMode"),
    number("@alphaCutoff", 0, any_size),
    object("@normalTexture"),
    index("@normalTexture/index", "/textures"),
    integer("@normalTexture/texCoord", 0, 65535),
    number("@normalTexture/scale", -any_size, any_size),
    object("@pbrMetallicRoughness"),
    numbers("@pbrMetallicRoughness/baseColorFactor", 4, 0, 1),
    number("@pbrMetallicRoughness/metallicFactor", 0, 1),
    number("@pbrMetallicRoughness/roughnessFactor", 0, 1),
    object("@pbrMetallicRoughness/baseColorTexture"),
    index("@pbrMetallicRoughness/baseColorTexture/index", "/textures"),
    integer("@pbrMetallicRoughness/baseColorTexture/texCoord", 0, 65535),
    object("@pbrMetallicRoughness/metallicRoughnessTexture"),
    index("@pbrMetallicRoughness/metallicRoughnessTexture/index", "/textures"),
    integer("@pbrMetallicRoughness/metallicRoughnessTexture/texCoord", 0, 65535),
    numbers("@extras/second_color", 3, 0, 1),
    number("@extras/pattern_scale", 1e-6, 1e6),
    object("@extensions"),
    object("@extensions/KHR_materials_emissive_strength"),
    number("@extensions/KHR_materials_emissive_strength/emissiveStrength", 0, any_size),
    object("@extensions/KHR_materials_ior"),
    number("@extensions/KHR_materials_ior/ior", 0, 1e6),
    object("@extensions/KHR_materials_transmission"),
    number("@extensions/KHR_materials_transmission/transmissionFactor", 0, 1),
    object("@extensions/KHR_materials_specular"),
    number("@extensions/KHR_materials_specular/specularFactor", 0, 1),
    numbers("@extensions/KHR_materials_specular/specularColorFactor", 3, 0, 1e6),
};

/// Members that an object must have.
struct requirement {
  char const *path, *key;
};

inline constexpr requirement required[] = {
    {"", "asset"},
    {"buffers/*", "byteLength"},
    {"bufferViews/*", "buffer"},
    {"bufferViews/*", "byteLength"},
    {"accessors/*", "componentType"},
    {"accessors/*", "count"},
    {"accessors/*", "type"},
    {"meshes/*", "primitives"},
    {"meshes/*/primitives/*", "attributes"},
    {"meshes/*/primitives/*/attributes", "POSITION"},
    {"animations/*", "channels"},
    {"animations/*", "samplers"},
    {"animations/*/channels/*", "sampler"},
    {"animations/*/channels/*", "target"},
    {"animations/*/channels/*/target", "path"},
    {"animations/*/samplers/*", "input"},
    {"animations/*/samplers/*", "output"},
    {"cameras/*", "type"},
    {"cameras/*/perspective", "yfov"},
    {"cameras/*/orthographic", "ymag"},
    {"materials/*/normalTexture", "index"},
    {"materials/*/emissiveTexture", "index"},
    {"materials/*/pbrMetallicRoughness/baseColorTexture", "index"},
    {"materials/*/pbrMetallicRoughness/metallicRoughnessTexture", "index"},
    {"nodes/*/extensions/KHR_lights_punctual", "light"},
    {"extensions/KHR_lights_punctual/lights/*", "type"},
};

}  // namespace path_tracer::gltf
