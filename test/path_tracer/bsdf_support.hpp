// SPDX-License-Identifier: Apache-2.0
#pragma once

// BSDFs of some parameters, for their tests.

#include <array>

#include "catch.hpp"
#include "scene/scene.hpp"
#include "shading/bsdf.hpp"
#include "shading/bsdf_glass.hpp"
#include "shading/bsdf_layers.hpp"
#include "shading/random.hpp"

namespace path_tracer {

inline albedo_tables const* tables() { return &host_albedo_tables(); }

inline bsdf_plastic plastic(float roughness, vec3 color, float metallic = 0, float specular = 1) {
  return {{color, metallic, roughness, 1.5f, specular, vec3{1, 0.9f, 0.8f}}, tables()};
}
inline bsdf_metal metal(float roughness) {
  return {{{alpha_of(roughness)}, vec3{1, 0.77f, 0.34f}, vec3{1}}};
}
inline bsdf_rough_glass glass(float roughness, float eta) {
  return {vec3{1, 0.9f, 0.8f}, eta, {alpha_of(roughness)}};
}
inline bsdf_layered<coat_lobe, bsdf_plastic> coated(float coat_roughness,
                                                    bsdf_plastic const& base) {
  return {{1, coat_roughness, tables()}, base, 0.5f};
}
inline bsdf_layered<sheen_lobe, bsdf_plastic> velvet(float roughness, bsdf_plastic const& base) {
  return {{vec3{1, 0.8f, 0.6f}, roughness, tables()}, base, 0.5f};
}

inline basic_plastic<brushed_lobe> brushed(float roughness, float anisotropy, vec3 color,
                                           float metallic) {
  plastic_terms const terms(plastic_parameters{color, metallic, roughness});
  float const alpha = terms.lobe.distribution.alpha;
  turned_ggx const turned{glm::mix(alpha, 1.0f, anisotropy * anisotropy), alpha, 0.6f, 0.8f};
  return {brushed_lobe{{turned, terms.lobe.f0, terms.lobe.f90}}, terms, tables()};
}
/// What an effect asks of a shading point, without a scene.
struct material_point {
  path_tracer::material const& material;
  vec3 color;
  struct {
    albedo_tables const* tables;
  } scene;

  explicit material_point(path_tracer::material const& m)
      : material(m), color(m.base_color), scene{path_tracer::tables()} {}
  PT_HD real eta() const { return material.ior; }
  PT_HD path_tracer::plastic_parameters plastic_parameters(vec3 c) const {
    return {c,
            material.metallic,
            material.roughness,
            material.ior,
            material.specular,
            material.specular_color};
  }
};
inline basic_plastic<film_lobe> filmed(material const& m) {
  return effects::iridescence::bsdf(material_point(m));
}
inline material oily(float roughness, float thickness, float metallic) {
  material m;
  m.base_color = {1, 0.6f, 0.3f};
  m.metallic = metallic;
  m.roughness = roughness;
  m.iridescence = 0.8f;
  m.film_thickness = thickness;
  effects::iridescence::prepare(m);
  return m;
}

/// Calls `f(name, bsdf)` for every kind that has a density, at moderate and high roughness.
template <class Function>
inline void for_each_bsdf(Function const& f) {
  f("matte", bsdf_matte{vec3{1, 0.5f, 0.2f}});
  for (float const r : {0.4f, 0.7f, 1.0f}) {
    INFO("roughness " << r);
    f("metal", metal(r));
    f("plastic", plastic(r, vec3{1, 0.5f, 0.2f}));
    f("half metal", plastic(r, vec3{1, 0.5f, 0.2f}, 0.5f, 0.6f));
    f("glass", glass(r, 1.5f));
    f("glass from inside", glass(r, 1 / 1.5f));
    f("pane", bsdf_rough_glass{vec3{1, 0.9f, 0.8f}, 1.5f, {alpha_of(r)}, true});
    f("clearcoat", coated(r, plastic(0.5f, vec3{1, 0.5f, 0.2f}, 0.3f)));
    f("sheen", velvet(r, plastic(0.8f, vec3{1, 0.5f, 0.2f})));
    f("brushed metal", brushed(r, 0.9f, vec3{1, 0.5f, 0.2f}, 1));
    f("brushed plastic", brushed(r, 0.7f, vec3{1, 0.5f, 0.2f}, 0));
    material const oil = oily(r, 350, 0), oxide = oily(r, 200, 1);
    f("oily plastic", filmed(oil));
    f("oxidised metal", filmed(oxide));
    f("some transmission", bsdf_mix<bsdf_rough_glass, bsdf_plastic>{
                               glass(r, 1.5f), plastic(r, vec3{1, 0.5f, 0.2f}), 0.6f});
  }
}

inline vec3 viewer(float cos_theta) { return polar(cos_theta, 0.7f); }
inline constexpr std::array<float, 4> cosines = {0.08f, 0.3f, 0.7f, 0.999f};

inline vec3 draw3(std::uint32_t i) {
  random_stream const s(5, i, 0);
  return {s.pair(0).x, s.pair(0).y, s.pair(1).x};
}

}  // namespace path_tracer
