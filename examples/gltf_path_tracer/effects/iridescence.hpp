// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "effects/effect.hpp"
#include "shading/bsdf.hpp"
#include "shading/thin_film.hpp"

namespace path_tracer {

/// A reflecting GGX lobe under a thin film: `share` of its facets have the film.
struct film_lobe {
  specular_lobe bare;
  film_reflectance const* film;
  real share;

  PT_HD bsdf_value value(vec3 wo, vec3 wi) const {
    if (wi.z <= 0) return {};
    ggx const& distribution = bare.distribution;
    vec3 const m = glm::normalize(wo + wi);
    real const cosine = glm::dot(wo, m);
    vec3 const f = glm::mix(schlick(bare.f0, bare.f90, cosine), (*film)(cosine), share);
    real const d = distribution.d(m) / (4 * wo.z);
    return {f * (d * distribution.g2(wo, wi)), d * distribution.g1(wo)};
  }
  PT_HD vec3 direction(vec3 wo, vec3 u) const { return bare.direction(wo, u); }
};

namespace effects {

/// Soap, oil and oxide: the colours of a thin film on a plastic or a metal
/// (KHR_materials_iridescence), without textures of thickness or metal.
struct iridescence {
  static constexpr char const* name = "iridescence";
  struct material_part {
    real iridescence = 0;
    real film_ior = real(1.3);
    real film_thickness = 400;  ///< nanometres
    film_reflectance film{};    ///< of the film on this material
    real film_f0 = 0;           ///< Schlick's term with it is nowhere below the film's
  };
  static constexpr property<material_part> material_properties[] = {
      number_property("extensions/KHR_materials_iridescence/iridescenceFactor",
                      &material_part::iridescence, 0, 1),
      number_property("extensions/KHR_materials_iridescence/iridescenceIor",
                      &material_part::film_ior, 1, 10),
      number_property("extensions/KHR_materials_iridescence/iridescenceThicknessMaximum",
                      &material_part::film_thickness, 0, 1e4)};

  template <class Material>
  static bool fits(Material const& m) {
    return m.iridescence > 0;
  }
  template <class Material>
  static void prepare(Material& m) {
    vec3 const bare = glm::min(dielectric_f0(m.ior) * m.specular_color, vec3{1}) * m.specular;
    m.film =
        reflectance_of_film(m.film_ior, m.film_thickness, glm::mix(bare, m.base_color, m.metallic));
    m.film_f0 = 0;
    for (int k = 0; k < film_reflectance::samples; ++k) {
      real const weight = schlick_weight(static_cast<real>(k) / (film_reflectance::samples - 1));
      if (weight < 1)
        m.film_f0 = std::max(m.film_f0, (max_component(m.film.values[k]) - weight) / (1 - weight));
    }
  }

  template <class Point>
  PT_HD static basic_plastic<film_lobe> bsdf(Point const& p) {
    auto const& m = p.material;
    plastic_terms terms(p.plastic_parameters(p.color));
    film_lobe const lobe{terms.lobe, &m.film, m.iridescence};
    terms.f0 = glm::max(terms.f0, m.film_f0);
    terms.f90 = glm::mix(terms.f90, real(1), m.iridescence);
    terms.guess_f0 = glm::mix(terms.guess_f0, luminance(m.film(1)), m.iridescence);
    return {lobe, terms, p.scene.tables};
  }
};

}  // namespace effects
}  // namespace path_tracer
