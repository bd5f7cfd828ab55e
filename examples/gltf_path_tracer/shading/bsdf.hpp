// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <type_traits>

#include "scene/math.hpp"
#include "shading/albedo.hpp"
#include "shading/microfacet.hpp"

namespace path_tracer {

// Every bsdf_* is a small value with two members, in the frame of microfacet.hpp, wo.z > 0:
// bsdf_value value(vec3 wo, vec3 wi) const; what a given direction carries bsdf_sample sample(vec3
// wo, vec3 u) const; a direction, from three numbers in [0, 1) They conserve energy, and are
// reciprocal, except for clear coats. Throughput is radiance divided by the squared refractive
// index, which an interface does not change (Veach 1997, section 5.2): no factor eta^2 for glass.

struct bsdf_value {
  vec3 f_cos{0};  ///< f(wo, wi) |cos(theta_i)|
  real pdf = 0;   ///< with which sample() takes wi, per solid angle
};

struct bsdf_sample {
  vec3 wi{0, 0, 1};
  vec3 weight{0};  ///< f |cos(theta_i)| / pdf; 0: the path ends
  real pdf = 0;
  bool delta = false;     ///< the only direction of a mirror: no pdf, value() does not know it
  bool straight = false;  ///< and that of a smooth pane, which shadow rays take as well
};

/// The sample of `b` for a direction. Its weight includes all lobes that reach that direction.
template <class Bsdf>
PT_HD bsdf_sample sample_towards(Bsdf const& b, vec3 wo, vec3 wi) {
  bsdf_value const v = b.value(wo, wi);
  if (!(v.pdf > 0)) return {};
  return {wi, v.f_cos / v.pdf, v.pdf, false};
}

/// The choice between two by one number: true with probability p, and u uniform again.
PT_HD inline bool choose(real p, real& u) {
  bool const first = u < p;
  u = first ? u / p : (u - p) / (1 - p);
  u = glm::clamp(u, real(0), 1 - epsilon / 2);
  return first;
}

/// Lambertian reflection.
struct bsdf_matte {
  vec3 color;

  PT_HD bsdf_value value(vec3, vec3 wi) const {
    if (wi.z <= 0) return {};
    return {color * (wi.z / pi), wi.z / pi};
  }
  PT_HD bsdf_sample sample(vec3 wo, vec3 u) const {
    return sample_towards(*this, wo, sample_cosine({u.x, u.y}));
  }
};

/// A reflecting microfacet lobe with Schlick's Fresnel term.
template <class Distribution>
struct basic_specular_lobe {
  Distribution distribution;
  vec3 f0, f90;

  PT_HD bsdf_value value(vec3 wo, vec3 wi) const {
    if (wi.z <= 0) return {};
    vec3 const m = glm::normalize(wo + wi);
    real const d = distribution.d(m) / (4 * wo.z);
    return {schlick(f0, f90, glm::dot(wo, m)) * (d * distribution.g2(wo, wi)),
            d * distribution.g1(wo)};
  }
  PT_HD vec3 direction(vec3 wo, vec3 u) const {
    vec3 const m = distribution.sample(wo, {u.x, u.y});
    return 2 * glm::dot(wo, m) * m - wo;
  }
};
using specular_lobe = basic_specular_lobe<ggx>;

/// A conductor: F0 is the colour, as glTF has it.
struct bsdf_metal {
  specular_lobe lobe;

  PT_HD bsdf_value value(vec3 wo, vec3 wi) const { return lobe.value(wo, wi); }
  PT_HD bsdf_sample sample(vec3 wo, vec3 u) const {
    return sample_towards(*this, wo, lobe.direction(wo, u));
  }
};

/// The parameters of glTF's metallic-roughness material, with KHR_materials_specular and _ior.
struct plastic_parameters {
  vec3 color{real(0.8)};
  real metallic = 0, roughness = 1, ior = real(1.5), specular = 1;
  vec3 specular_color{1};
};

/// The terms that follow from them.
struct plastic_terms {
  specular_lobe lobe;
  vec3 diffuse;
  real roughness;
  real f0, f90;   ///< with these, Schlick's term of the dielectric is nowhere below the lobe's
  real guess_f0;  ///< of lobe and metal, for the choice of what to sample
  real guess_f90;

  PT_HD explicit plastic_terms(plastic_parameters const& p) {
    vec3 const dielectric = glm::min(dielectric_f0(p.ior) * p.specular_color, vec3{1}) * p.specular;
    lobe.distribution.alpha = alpha_of(p.roughness);
    lobe.f0 = glm::mix(dielectric, p.color, p.metallic);
    lobe.f90 = vec3{glm::mix(p.specular, real(1), p.metallic)};
    diffuse = p.color * (1 - p.metallic);
    roughness = p.roughness;
    f0 = max_component(dielectric);
    f90 = p.specular;
    guess_f0 = luminance(lobe.f0);
    guess_f90 = lobe.f90.x;
  }
};

template <class Lobe, class = void>
inline constexpr bool has_roughness_from = false;
template <class Lobe>
inline constexpr bool has_roughness_from<Lobe, std::void_t<decltype(&Lobe::roughness_from)>> = true;

/// A specular lobe, and below it a diffuse base that gets the light that the lobe does not reflect.
/// glTF suggests 1 - F(wo.m) for that share, which adds energy at grazing angles. This is the
/// reciprocal form of Kelemen and Szirmay-Kalos (2001), (1 - E(wo)) (1 - E(wi)) / (1 - mean of E).
/// E is the share that the dielectric lobe reflects.
template <class Lobe>
class basic_plastic {
 public:
  PT_HD basic_plastic(Lobe const& lobe, plastic_terms const& terms, albedo_tables const* tables)
      : lobe_(lobe),
        diffuse_(terms.diffuse),
        tables_(tables),
        roughness_(terms.roughness),
        f_{terms.f0, terms.f90},
        guess_{terms.guess_f0, terms.guess_f90} {
    real const mean = mean_reflected(lobe);
    scale_ = mean < 1 ? 1 / (1 - mean) : real(0);
  }

  PT_HD bsdf_value value(vec3 wo, vec3 wi) const {
    if (wi.z <= 0) return {};
    vec2 const e = reflected(wo);
    real const below = 1 - dot(e, f_);
    real const p = specular_share(e, below);
    bsdf_value v = p > 0 ? lobe_.value(wo, wi) : bsdf_value{};
    real const diffuse = below * (1 - dot(reflected(wi), f_)) * scale_;
    v.f_cos += diffuse_ * (diffuse * (wi.z / pi));
    v.pdf = p * v.pdf + (1 - p) * (wi.z / pi);
    return v;
  }

  PT_HD bsdf_sample sample(vec3 wo, vec3 u) const {
    vec2 const e = reflected(wo);
    bool const specular = choose(specular_share(e, 1 - dot(e, f_)), u.z);
    return sample_towards(*this, wo, specular ? lobe_.direction(wo, u) : sample_cosine({u.x, u.y}));
  }

 private:
  PT_HD static real dot(vec2 a, vec2 b) { return a.x * b.x + a.y * b.y; }
  /// The share of light that the lobe reflects, in multiples of F0 and F90. A lobe that is not
  /// isotropic says which roughness looks the same from `w`, and between which two that lies.
  PT_HD vec2 reflected(vec3 w) const {
    if constexpr (has_roughness_from<Lobe>) {
      return tables_->ggx(w.z, lobe_.roughness_from(w));
    } else {
      return tables_->ggx(w.z, roughness_);
    }
  }
  PT_HD real mean_reflected(Lobe const& lobe) const {
    if constexpr (has_roughness_from<Lobe>) {
      return glm::min(dot(tables_->ggx_mean(lobe.least_roughness()), f_),
                      dot(tables_->ggx_mean(lobe.most_roughness()), f_));
    } else {
      return dot(tables_->ggx_mean(roughness_), f_);
    }
  }
  PT_HD real specular_share(vec2 e, real below) const {
    real const s = dot(e, guess_);
    return s > 0 ? s / (s + luminance(diffuse_) * below) : real(0);
  }

  Lobe lobe_;
  vec3 diffuse_;
  albedo_tables const* tables_;
  real roughness_, scale_;
  vec2 f_, guess_;
};

/// The metallic-roughness material itself.
struct bsdf_plastic : basic_plastic<specular_lobe> {
  using parameters = plastic_parameters;

  PT_HD bsdf_plastic(parameters const& p, albedo_tables const* tables)
      : bsdf_plastic(plastic_terms(p), tables) {}

 private:
  PT_HD bsdf_plastic(plastic_terms const& terms, albedo_tables const* tables)
      : basic_plastic(terms.lobe, terms, tables) {}
};

}  // namespace path_tracer
