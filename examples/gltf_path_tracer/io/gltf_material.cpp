// SPDX-License-Identifier: Apache-2.0
#include <cstring>
#include <map>
#include <memory>
#include <stdexcept>
#include <utility>

#include "io/gltf_parts.hpp"
#include "io/gltf_properties.hpp"
#include "scene/texture.hpp"

namespace path_tracer::gltf {
namespace {

constexpr real infinite_ior = real(1000);  // what KHR_materials_ior means by an ior of 0

real number_at(json const& from, char const* pointer, real otherwise) {
  return static_cast<real>(value_at(from, pointer, double{otherwise}));
}

vec3 color_at(json const& from, char const* pointer, vec3 otherwise) {
  auto const v = value_at(from, pointer, std::vector<double>{});
  return v.size() < 3 ? otherwise : vec3(glm::dvec3(v[0], v[1], v[2]));
}

class material_reader {
 public:
  material_reader(document& d, scene& out) : document_(d), scene_(out) {}

  void append(std::size_t index) {
    json const& from = document_.root["materials"][index];
    where_ = element(document_.root, "materials", index);
    material m = read_factors(from);
    m.base_color_texture = add_texture(from, "/pbrMetallicRoughness/baseColorTexture", true);
    m.metallic_roughness_texture =
        add_texture(from, "/pbrMetallicRoughness/metallicRoughnessTexture", false);
    m.normal_texture = add_texture(from, "/normalTexture", false);
    m.emissive_texture = add_texture(from, "/emissiveTexture", true);
    if (m.emissive_texture != no_texture) m.mean_emissive = mean_of(m.emissive_texture);
    read_parts(from, m);
    m.thin = m.thickness == 0;
    choose(m);
    if (value_at(from, "/alphaMode", std::string("OPAQUE")) != "OPAQUE")
      document_.left_out.add("alphaMode " + from["alphaMode"].get<std::string>(), where_);
    scene_.materials.push_back(m);
    scene_.material_names.push_back(value_at(from, "/name", std::string()));
  }

 private:
  static material read_factors(json const& from) {
    material m;
    m.base_color = color_at(from, "/pbrMetallicRoughness/baseColorFactor", vec3(1));
    m.metallic = number_at(from, "/pbrMetallicRoughness/metallicFactor", 1);
    m.roughness = number_at(from, "/pbrMetallicRoughness/roughnessFactor", 1);
    m.normal_scale = number_at(from, "/normalTexture/scale", 1);
    m.two_sided = value_at(from, "/doubleSided", false);
    m.emission = color_at(from, "/emissiveFactor", vec3(0)) *
                 number_at(from, "/extensions/KHR_materials_emissive_strength/emissiveStrength", 1);
    m.ior = number_at(from, "/extensions/KHR_materials_ior/ior", real(1.5));
    if (m.ior == 0) m.ior = infinite_ior;
    m.transmission =
        number_at(from, "/extensions/KHR_materials_transmission/transmissionFactor", 0);
    m.specular = number_at(from, "/extensions/KHR_materials_specular/specularFactor", 1);
    m.specular_color =
        color_at(from, "/extensions/KHR_materials_specular/specularColorFactor", vec3(1));
    m.second_color = color_at(from, "/extras/second_color", vec3(0));
    m.pattern_scale = number_at(from, "/extras/pattern_scale", 1);
    return m;
  }

  void read_parts(json const& from, material& m) {
    read_properties(from, m);
    std::string const asked = value_at(from, "/extras/shader", std::string());
    if (!asked.empty() && !m.is_marble && !m.is_wood)
      document_.left_out.add("extras.shader \"" + asked + "\"", where_);
  }

  void choose(material& m) {
    if (m.ior < 1) fail("its ior is between 0 and 1");
    if (!(max_component(m.emission) <= real(1e30)))
      fail("its emission is beyond the range of a float");
    choose_shader(m, effect_bits().set());
    auto const hidden = [&](std::string const& name) {
      document_.left_out.add(name + " under another shader", where_);
    };
    if (effects::is_glass(m) && m.kind != shader_of<effects::smooth_glass> &&
        m.kind != shader_of<effects::rough_glass>)
      hidden("transmission");
    bool const glass =
        m.kind == shader_of<effects::smooth_glass> || m.kind == shader_of<effects::rough_glass>;
    if (glass && (m.specular != 1 || m.specular_color != vec3(1)))
      document_.left_out.add("KHR_materials_specular of glass", where_);
    for_each_effect(all_effects{}, [&](auto effect) {
      using type = decltype(effect);
      if constexpr (path_tracer::detail::has_shader<type> && has_material_properties<type>)
        if (m.kind != shader_of<type> && type::fits(m)) hidden(type::name);
    });
  }

  std::int32_t add_texture(json const& material, char const* pointer, bool srgb) {
    json::json_pointer const p(pointer);
    if (!material.contains(p)) return no_texture;
    json const& info = material.at(p);
    if (value_at(info, "/texCoord", 0) != 0) {
      document_.left_out.add("texture with TEXCOORD_" + info["texCoord"].dump(), where_);
      return no_texture;
    }
    auto const index = info["index"].get<std::size_t>();
    auto const [known, is_new] = textures_.try_emplace({index, srgb}, 0);
    if (!is_new) return known->second;

    tinygltf::Texture const& from = document_.model.textures[index];
    if (from.source < 0)
      fail("its " + element(document_.root, "textures", index) + " has no PNG or JPEG image");
    texture t = decode(static_cast<std::size_t>(from.source));
    t.srgb = srgb;
    if (from.sampler >= 0) {
      tinygltf::Sampler const& s = document_.model.samplers[static_cast<std::size_t>(from.sampler)];
      t.wrap_s = wrap_mode(s.wrapS);
      t.wrap_t = wrap_mode(s.wrapT);
      t.nearest = s.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
    }
    scene_.textures.push_back(t);
    return known->second = static_cast<std::int32_t>(scene_.textures.size() - 1);
  }

  /// The mean colour of a texture, linear.
  vec3 mean_of(std::int32_t index) const {
    texture const& t = scene_.textures[static_cast<std::size_t>(index)];
    std::size_t const texels = std::size_t{t.width} * t.height;
    std::size_t counts[3][256] = {};
    for (std::size_t i = 0; i < texels; ++i)
      for (int c = 0; c < 3; ++c) ++counts[c][scene_.texels[t.offset + i] >> (8 * c) & 255u];
    glm::dvec3 sum(0);
    for (int code = 0; code < 256; ++code)
      for (int c = 0; c < 3; ++c)
        sum[c] += static_cast<double>(counts[c][code]) *
                  double{srgb_to_linear(static_cast<real>(code) / real(255))};
    return vec3(sum / static_cast<double>(texels));
  }

  std::uint8_t wrap_mode(int mode) const {
    if (mode == TINYGLTF_TEXTURE_WRAP_REPEAT) return 0;
    if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return 1;
    if (mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return 2;
    fail("a sampler has the wrap mode " + std::to_string(mode) + ", which glTF does not have");
  }

  texture decode(std::size_t index) {
    auto const [known, is_new] = images_.try_emplace(index);
    if (!is_new) return known->second;
    tinygltf::Image const& image = document_.model.images[index];
    std::string const name = "its " + element(document_.root, "images", index) + " ";
    if (image.image.empty()) fail(name + "cannot be read from \"" + image.uri + "\"");
    auto const size = static_cast<int>(image.image.size());
    if (stbi_is_hdr_from_memory(image.image.data(), size) != 0)
      fail(name + "is neither a PNG nor a JPEG");
    int width = 0, height = 0, channels = 0;
    std::unique_ptr<stbi_uc, void (*)(void*)> const pixels(
        stbi_load_from_memory(image.image.data(), size, &width, &height, &channels, 4),
        stbi_image_free);
    if (!pixels) fail(name + "cannot be decoded as PNG or JPEG: " + stbi_failure_reason());

    texture t;
    t.width = static_cast<std::uint32_t>(width);
    t.height = static_cast<std::uint32_t>(height);
    std::size_t const texels = std::size_t{t.width} * t.height;
    if (texels > UINT32_MAX - scene_.texels.size())
      fail("with " + name + "the scene has more than 2^32 texels");
    t.offset = static_cast<std::uint32_t>(scene_.texels.size());
    scene_.texels.reserve(scene_.texels.size() + texels);
    for (std::size_t i = 0; i < texels; ++i) {
      stbi_uc const* c = pixels.get() + 4 * i;
      scene_.texels.push_back(c[0] | std::uint32_t{c[1]} << 8 | std::uint32_t{c[2]} << 16 |
                              std::uint32_t{c[3]} << 24);
    }
    return known->second = t;
  }

  [[noreturn]] void fail(std::string const& what) const {
    throw std::runtime_error(where_ + ": " + what);
  }

  document& document_;
  scene& scene_;
  std::string where_;
  std::map<std::pair<std::size_t, bool>, std::int32_t> textures_;
  std::map<std::size_t, texture> images_;
};

}  // namespace

void append_materials(document& d, scene& out) {
  material_reader reader(d, out);
  for (std::size_t i = 0; i < d.model.materials.size(); ++i) reader.append(i);
  // The default material of glTF 2.0, section 3.9.6.
  material otherwise;
  otherwise.base_color = vec3(1);
  otherwise.metallic = 1;
  otherwise.kind = shader_of<effects::metal>;
  out.materials.push_back(otherwise);
}

}  // namespace path_tracer::gltf
