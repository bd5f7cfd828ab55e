// SPDX-License-Identifier: Apache-2.0
#pragma once

// White BSDFs of every type, made on the machine that runs them.

#include "scene/scene.hpp"
#include "shading/bsdf.hpp"
#include "shading/bsdf_glass.hpp"
#include "shading/bsdf_layers.hpp"

namespace path_tracer {

/// What a BSDF looks up, in the memory of its machine.
struct lookups {
  albedo_tables const* tables;
  material const* oil;
};

/// What an effect asks of a shading point; see material_point, which is for the host.
struct film_point {
  path_tracer::material const& material;
  vec3 color;
  lookups scene;
  PT_HD path_tracer::plastic_parameters plastic_parameters(vec3 c) const {
    return {c, material.metallic, material.roughness, material.ior, material.specular, vec3{1}};
  }
};

PT_HD inline bsdf_plastic white_plastic(float roughness, lookups at) {
  return {{vec3{1}, 0, roughness, 1.5f, 1, vec3{1}}, at.tables};
}
PT_HD inline basic_plastic<brushed_lobe> white_brushed(float roughness, float metallic,
                                                       lookups at) {
  plastic_terms const terms(plastic_parameters{vec3{1}, metallic, roughness});
  float const alpha = terms.lobe.distribution.alpha;
  turned_ggx const turned{glm::mix(alpha, 1.0f, 0.81f), alpha, 0.6f, 0.8f};
  return {brushed_lobe{{turned, terms.lobe.f0, terms.lobe.f90}}, terms, at.tables};
}

// What makes them: of a roughness, for narrow lobes to be told from wide ones.
struct white_matte {
  float roughness;
  PT_HD auto operator()(lookups) const { return bsdf_matte{vec3{1}}; }
};
struct smooth_glass {
  float roughness, eta;
  PT_HD auto operator()(lookups) const { return bsdf_smooth_glass{vec3{1}, eta}; }
};
struct rough_glass {
  float roughness, eta;
  PT_HD auto operator()(lookups) const {
    return bsdf_rough_glass{vec3{1}, eta, {alpha_of(roughness)}};
  }
};
struct white_metal {
  float roughness;
  PT_HD auto operator()(lookups) const {
    return bsdf_metal{{{alpha_of(roughness)}, vec3{1}, vec3{1}}};
  }
};
struct plain_plastic {
  float roughness;
  PT_HD auto operator()(lookups at) const { return white_plastic(roughness, at); }
};
struct some_transmission {
  float roughness;
  PT_HD auto operator()(lookups at) const {
    return bsdf_mix<bsdf_rough_glass, bsdf_plastic>{rough_glass{roughness, 1.5f}(at),
                                                    white_plastic(roughness, at), 0.6f};
  }
};
struct varnished {
  float roughness;
  PT_HD auto operator()(lookups at) const {
    return bsdf_layered<coat_lobe, bsdf_plastic>{
        {1, roughness, at.tables}, white_plastic(roughness, at), 1};
  }
};
struct fuzzy {
  float roughness;
  PT_HD auto operator()(lookups at) const {
    return bsdf_layered<sheen_lobe, bsdf_plastic>{
        {vec3{1}, roughness, at.tables}, white_plastic(roughness, at), 1};
  }
};
struct brushed_metal {
  float roughness;
  PT_HD auto operator()(lookups at) const { return white_brushed(roughness, 1, at); }
};
struct brushed_plastic {
  float roughness;
  PT_HD auto operator()(lookups at) const { return white_brushed(roughness, 0, at); }
};
struct oily_plastic {
  float roughness;
  PT_HD auto operator()(lookups at) const {
    return effects::iridescence::bsdf(film_point{*at.oil, vec3{1}, at});
  }
};

}  // namespace path_tracer
