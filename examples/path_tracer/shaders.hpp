// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deferred_shade/types.hpp>

#include "bsdf_glass.hpp"
#include "bsdf_layers.hpp"
#include "noise.hpp"
#include "path.hpp"
#include "surface.hpp"

namespace path_tracer {

/// From this bounce on a path survives with a probability, and its throughput makes up for it.
inline constexpr std::uint32_t roulette_start = 3;

PT_HD inline vec3 base_color(scene_view const& scene, material const& m, surface const& s) {
  if (m.base_color_texture == no_texture) return m.base_color;
  return m.base_color * vec3(sample_texture(scene.textures, m.base_color_texture, s.uv));
}

/// The parameters of a plastic with its textures looked up: roughness is in green, metallic in
/// blue.
PT_HD inline bsdf_plastic::parameters plastic_parameters(scene_view const& scene, material const& m,
                                                         surface const& s, vec3 color) {
  bsdf_plastic::parameters p{color, m.metallic, m.roughness, m.ior, m.specular, m.specular_color};
  if (m.metallic_roughness_texture == no_texture) return p;
  vec4 const texel = sample_texture(scene.textures, m.metallic_roughness_texture, s.uv);
  p.roughness *= texel.y;
  p.metallic *= texel.z;
  return p;
}

/// The BSDF that a shader puts on a surface.
template <shader Kind>
PT_HD auto make_bsdf(scene_view const& scene, material const& m, surface const& s) {
  if constexpr (Kind == shader::matte || Kind == shader::emitter) {
    return bsdf_matte{base_color(scene, m, s)};
  } else if constexpr (Kind == shader::marble) {
    float const vein = marble_pattern(s.position * m.pattern_scale);
    return bsdf_matte{glm::mix(base_color(scene, m, s), m.second_color, vein)};
  } else {
    vec3 color = base_color(scene, m, s);
    if constexpr (Kind == shader::wood)
      color = glm::mix(color, m.second_color, wood_pattern(s.position * m.pattern_scale));
    auto const p = plastic_parameters(scene, m, s, color);
    if constexpr (Kind == shader::metal) {
      return bsdf_metal{{{alpha_of(p.roughness)}, color, vec3{1}}};
    } else {
      bsdf_plastic const plastic{p, scene.tables};
      float const ior = m.ior > 0 ? glm::max(m.ior, 1.001f) : 0.0f;  // 0 stands for infinity
      float const eta = s.front || ior == 0 ? ior : 1 / ior;
      if constexpr (Kind == shader::smooth_glass)
        return bsdf_mix<bsdf_smooth_glass, bsdf_plastic>{{color, eta}, plastic, m.transmission};
      else if constexpr (Kind == shader::rough_glass)
        return bsdf_mix<bsdf_rough_glass, bsdf_plastic>{
            {color, eta, {alpha_of(p.roughness)}}, plastic, m.transmission};
      else if constexpr (Kind == shader::clearcoat)
        return bsdf_layered<coat_lobe, bsdf_plastic>{
            {m.clearcoat, m.clearcoat_roughness, scene.tables}, plastic, luminance(color)};
      else if constexpr (Kind == shader::sheen)
        return bsdf_layered<sheen_lobe, bsdf_plastic>{
            {m.sheen_color, m.sheen_roughness, scene.tables}, plastic, luminance(color)};
      else
        return plastic;
    }
  }
}

/// The light from a hit emitter, weighed against what a light sample at the last surface found.
PT_HD inline void add_emission(wave_view const& wave, scene_view const& scene, std::uint32_t i,
                               material const& m, surface const& s) {
  if (!s.front && !m.two_sided) return;
  float weight = 1;
  if (wave.pdf[i] > 0) {
    vec3 const d = s.position - wave.origin[i];
    float const cos_light = -glm::dot(wave.direction[i], s.geometric);
    weight = power_heuristic(wave.pdf[i], light_pdf(scene.lights, m, glm::dot(d, d), cos_light));
  }
  wave.radiance[i] += wave.throughput[i] * m.emission * weight;
}

/// One light sample; its shadow ray and contribution go to the wave.
template <class Bsdf>
PT_HD void sample_lights(wave_view const& wave, scene_view const& scene, std::uint32_t i,
                         surface const& s, Bsdf const& bsdf) {
  if (scene.lights.count == 0) return;
  random_stream const random = wave.random(i);
  light_sample const l = sample_light(scene.lights, scene.triangles, scene.materials, s.position,
                                      random.pair(pair_of(draw::light, wave.bounce)),
                                      random.pair(pair_of(draw::light_point, wave.bounce)));
  if (!(l.pdf > 0) || max_component(l.radiance) <= 0) return;
  vec3 const wi = s.to_local(l.wi);
  if (!s.consistent(wi, l.wi)) return;
  bsdf_value const v = bsdf.value(s.wo, wi);
  float const weight = l.delta ? 1.0f : power_heuristic(l.pdf, v.pdf);
  vec3 const light = wave.throughput[i] * v.f_cos * l.radiance * (weight / l.pdf);
  if (light == vec3{0}) return;
  vec3 const origin = s.start_towards(l.wi);
  vec3 end = s.position + l.wi * l.distance;
  if (!l.delta) end = offset_point(end, l.normal);
  wave.shadow_origin[i] = origin;
  wave.shadow_vector[i] = end - origin;
  wave.shadow_light[i] = light;
}

/// Sets the next ray of a path, or ends it.
template <class Bsdf>
PT_HD void extend_path(wave_view const& wave, std::uint32_t i, surface const& s, Bsdf const& bsdf) {
  random_stream const random = wave.random(i);
  vec2 const u = random.pair(pair_of(draw::direction, wave.bounce));
  vec2 const v = random.pair(pair_of(draw::lobe_and_roulette, wave.bounce));
  bsdf_sample const b = bsdf.sample(s.wo, {u.x, u.y, v.x});
  vec3 throughput = wave.throughput[i] * b.weight;
  vec3 const wi = s.to_world(b.wi);
  wave.throughput[i] = vec3{0};
  if (!s.consistent(b.wi, wi)) return;
  if (wave.bounce + 1 >= roulette_start) {
    float const survival = glm::min(0.95f, max_component(throughput));
    if (v.y >= survival) return;
    throughput /= survival;
  }
  wave.throughput[i] = throughput;
  wave.origin[i] = s.start_towards(wi);
  wave.direction[i] = glm::normalize(wi);
  wave.pdf[i] = b.delta ? 0.0f : b.pdf;
}

/// The shader of a surface: emission, one light sample, one BSDF sample.
template <shader Kind>
struct surface_shader {
  wave_view wave;
  scene_view scene;

  PT_HD void operator()(deferred_shade::request_index i) const {
    surface const s =
        load_surface(scene, wave.primitive[i], wave.barycentric[i], wave.direction[i]);
    material const& m = scene.materials[s.material];
    if constexpr (Kind == shader::emitter) add_emission(wave, scene, i, m, s);
    if (wave.bounce + 1 >= wave.max_depth) {
      wave.throughput[i] = vec3{0};
      return;
    }
    auto const bsdf = make_bsdf<Kind>(scene, m, s);
    sample_lights(wave, scene, i, s, bsdf);
    extend_path(wave, i, s, bsdf);
  }
};

/// The shader of a ray that left the scene.
struct miss_shader {
  wave_view wave;
  scene_view scene;

  PT_HD void operator()(deferred_shade::request_index i) const {
    wave.radiance[i] += wave.throughput[i] * scene.background;
    wave.throughput[i] = vec3{0};
  }
};

}  // namespace path_tracer
