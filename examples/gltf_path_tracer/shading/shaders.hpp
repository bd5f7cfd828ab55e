// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deferred_shade/types.hpp>

#include "scene/surface.hpp"
#include "shading/path.hpp"
#include "shading/path_draws.hpp"

namespace path_tracer {

/// What a shader knows about a hit when it makes its BSDF. `Set`: the effects that may occur.
template <class Set>
struct shading_point {
  scene_view const& scene;
  path_tracer::material const& material;
  surface const& at;
  triangle const& hit;
  vec3 color{0};  ///< base colour, its texture looked up
  real ior = 0;   ///< 0 stands for infinity

  PT_HD shading_point(scene_view const& view, surface const& s, triangle const& t)
      : scene(view), material(view.materials[s.material]), at(s), hit(t) {
    color = material.base_color;
    if constexpr (Set::template has<effects::textures>) {
      if (material.base_color_texture != no_texture)
        color = color * vec3(sample_texture(scene.textures, material.base_color_texture, at.uv));
    }
    ior = material.ior;
  }

  /// Textures looked up: roughness is in green, metallic in blue.
  PT_HD bsdf_plastic::parameters plastic_parameters(vec3 base) const {
    auto const& m = material;
    bsdf_plastic::parameters p{base, m.metallic, m.roughness, m.ior, m.specular, m.specular_color};
    if constexpr (Set::template has<effects::textures>) {
      if (m.metallic_roughness_texture == no_texture) return p;
      vec4 const texel = sample_texture(scene.textures, m.metallic_roughness_texture, at.uv);
      p.roughness *= texel.y;
      p.metallic *= texel.z;
    }
    return p;
  }
  PT_HD bsdf_plastic plastic(vec3 base) const { return {plastic_parameters(base), scene.tables}; }

  /// The direction in which the texture coordinate u grows, in the surface's frame; else its
  /// tangent.
  PT_HD vec2 direction_of_u() const {
    vec3 const u = at.to_local(axes_of(hit).u);
    real const length2 = u.x * u.x + u.y * u.y;
    return length2 > 0 && length2 < INFINITY ? vec2{u.x, u.y} / std::sqrt(length2) : vec2{1, 0};
  }

  /// 1 where u, against v and the normal make a right-handed frame, as where glTF's tangent space
  /// is not mirrored and seen from the front; else -1.
  PT_HD real side_of_v() const {
    texture_axes const axes = axes_of(hit);
    return glm::dot(glm::cross(at.normal, axes.u), axes.v) > 0 ? real(-1) : real(1);
  }

  /// The refractive index of the far side over that of the near side.
  PT_HD real eta() const {
    real const inside = ior > 0 ? glm::max(ior, real(1.001)) : real(0);
    return at.front || material.thin || inside == 0 ? inside : 1 / inside;
  }
};

/// The light from a hit emitter, weighted against the light sample at the last surface.
template <class Set>
PT_HD void add_emission(batch_view<Set> const& batch, scene_view const& scene, std::uint32_t i,
                        surface const& s, real area_ratio) {
  material const& m = scene.materials[s.material];
  if (!s.front && !m.two_sided) return;
  real weight = 1;
  if (batch.pdf[i] > 0) {
    vec3 const d = s.position - batch.origin[i];
    real const cos_light = -glm::dot(vec3(batch.direction[i]), s.geometric);
    real distance2 = glm::dot(d, d);
    if constexpr (path_array<effects::smooth_glass, Set>::exists) {
      real const passed = batch.template state<effects::smooth_glass>(i);
      if (passed > 0) distance2 = (std::sqrt(distance2) + passed) * (std::sqrt(distance2) + passed);
    }
    real const pdf = light_pdf(scene.lights, m, distance2, cos_light) * area_ratio;
    weight = weight_of_bsdf(scene.lights.how, batch.pdf[i], pdf);
  }
  batch.radiance[i] += batch.throughput[i] * emission_at<Set>(scene.textures, m, s.uv) * weight;
}

/// The random numbers of the light sample of a bounce.
template <class Set>
PT_HD light_draws draws_of_light(basic_batch const& batch, std::uint32_t i) {
  random_stream const random = batch.random(i);
  light_draws u{random.pair(pair_of(draw::light, batch.bounce)),
                random.pair(pair_of(draw::light_point, batch.bounce)), vec2{0},
                time_of<Set>(batch, i)};
  if constexpr (Set::template has<effects::environment>)
    u.texel = random.pair(path_draw::sky_texel + batch.bounce);
  return u;
}

/// The light of a sample that arrives if only the medium is between.
template <class Set>
PT_HD vec3 arriving(scene_view const& scene, light_sample const& l) {
  if constexpr (Set::template has<effects::medium>) {
    if (scene.medium.extinction == vec3{0}) return l.radiance;
    bool const is_far = l.distance == scene.lights.far_away;
    return l.radiance * scene.medium.transmittance(is_far ? endless : l.distance);
  } else {
    return l.radiance;
  }
}

/// One light sample; its shadow ray and contribution go to the batch.
template <class Set, class Bsdf>
PT_HD void sample_lights(basic_batch const& batch, scene_view const& scene, std::uint32_t i,
                         surface const& s, Bsdf const& bsdf) {
  if (scene.lights.count == 0) return;
  light_sample const l = sample_light<Set>(scene.lights, s.position, draws_of_light<Set>(batch, i));
  if (!(l.pdf > 0) || max_component(l.radiance) <= 0) return;
  vec3 const wi = s.to_local(l.wi);
  if (!s.consistent(wi, l.wi)) return;
  bsdf_value const v = bsdf.value(s.wo, wi);
  real const weight = l.delta ? real(1) : weight_of_light(scene.lights.how, l.pdf, v.pdf);
  vec3 const light = batch.throughput[i] * v.f_cos * arriving<Set>(scene, l) * (weight / l.pdf);
  if (light == vec3{0}) return;
  vec3 const origin = s.start_towards(l.wi);
  vec3 const end = s.position + l.wi * l.distance + l.clearance;
  batch.shadow_origin[i] = origin;
  batch.shadow_vector[i] = end - origin;
  batch.shadow_light[i] = light;
}

/// The probability with which Russian roulette lets a path go on: 1 where no light is lost.
PT_HD inline real survival_of(vec3 throughput) {
  return glm::min(real(1), max_component(throughput));
}

/// Sets the next ray of a path, or ends it.
template <class Set, class Bsdf>
PT_HD void extend_path(batch_view<Set> const& batch, std::uint32_t i, surface const& s,
                       Bsdf const& bsdf) {
  random_stream const random = batch.random(i);
  vec2 const u = random.pair(pair_of(draw::direction, batch.bounce));
  vec2 const v = random.pair(pair_of(draw::lobe_and_roulette, batch.bounce));
  bsdf_sample const b = bsdf.sample(s.wo, {u.x, u.y, v.x});
  vec3 throughput = batch.throughput[i] * b.weight;
  vec3 const wi = s.to_world(b.wi);
  batch.throughput[i] = vec3{0};
  if (!s.consistent(b.wi, wi)) return;
  if (batch.bounce + 1 >= batch.roulette_from) {
    real const survival = survival_of(throughput);
    if (v.y >= survival) return;
    throughput /= survival;
  }
  batch.throughput[i] = throughput;
  if constexpr (path_array<effects::smooth_glass, Set>::exists) {
    real& passed = batch.template state<effects::smooth_glass>(i);
    passed = b.straight ? passed + glm::length(s.position - batch.origin[i]) : real(0);
  }
  batch.origin[i] = s.start_towards(wi);
  batch.direction[i] = glm::normalize(wi);
  // Through a pane, light samples of the last scattering compete still.
  if (!b.straight) batch.pdf[i] = b.delta ? real(0) : b.pdf;
}

/// The shader of an effect: emission, one light sample, one BSDF sample.
template <class Effect, class Set>
struct surface_shader {
  batch_view<Set> batch;
  scene_view scene;

  PT_HD void operator()(deferred_shade::request_index i) const {
    loaded_triangle<Set> t = load_triangle<Set>(scene.triangles, scene.motion, batch.primitive[i],
                                                time_of<Set>(batch, i));
    surface const s = load_surface<Set>(scene, t, batch.barycentric[i], batch.direction[i]);
    if constexpr (Set::template has<effects::emitters>) {
      if (max_component(scene.materials[s.material].emission) > 0) {
        real const ratio = area_ratio<Set>(scene.triangles, scene.motion, batch.primitive[i], t);
        add_emission<Set>(batch, scene, i, s, ratio);
      }
    }
    if (batch.bounce + 1 >= batch.max_depth) {
      batch.throughput[i] = vec3{0};
      return;
    }
    shading_point<Set> point(scene, s, t);
    if constexpr (effects::is_glass_shader<Effect>) {
      for_each_effect(all_effects{}, [&](auto effect) {
        using type = decltype(effect);
        if constexpr (Set::template has<type> && detail::changes_glass<type>)
          if (!point.material.thin) type::at_glass(batch, i, point);
      });
    }
    auto const bsdf = Effect::bsdf(point);
    if constexpr (has_lights<Set>) sample_lights<Set>(batch, scene, i, s, bsdf);
    extend_path(batch, i, s, bsdf);
  }
};

/// The shader of a ray that left the scene.
template <class Set>
struct miss_shader {
  basic_batch batch;
  scene_view scene;

  PT_HD void operator()(deferred_shade::request_index i) const {
    vec3 radiance = scene.background;
    if constexpr (Set::template has<effects::environment>) {
      if (scene.lights.sky.width > 0) {
        vec2 const uv = scene.lights.sky.coordinates(batch.direction[i]);
        real const pdf = batch.pdf[i];
        real const weight =
            pdf > 0 ? weight_of_bsdf(scene.lights.how, pdf, sky_pdf(scene.lights, uv)) : real(1);
        radiance += weight * scene.lights.sky.radiance(uv);
      }
    }
    batch.radiance[i] += batch.throughput[i] * radiance;
    batch.throughput[i] = vec3{0};
  }
};

}  // namespace path_tracer
