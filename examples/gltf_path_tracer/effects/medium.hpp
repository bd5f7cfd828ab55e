// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "effects/effect.hpp"
#include "shading/microfacet.hpp"
#include "shading/path_draws.hpp"

namespace path_tracer {

/// A homogeneous medium as paths see it; coefficients per unit of length.
struct medium_view {
  vec3 scattering{0}, extinction{0};
  real anisotropy = 0;  ///< the mean cosine of the angle by which light is turned

  PT_HD vec3 transmittance(real length) const {
    return {std::exp(-extinction.x * length), std::exp(-extinction.y * length),
            std::exp(-extinction.z * length)};
  }
};

/// Longer than any path in a scene; the product with any coefficient is finite.
inline constexpr real endless = real(1e30);

/// The phase function of Henyey and Greenstein (1941), per solid angle; `cosine` is 1 straight on.
PT_HD inline real phase(real anisotropy, real cosine) {
  // 1 + g^2 - 2 g cosine, without its cancellation near the peak.
  real const g = std::fabs(anisotropy), c = anisotropy < 0 ? -cosine : cosine;
  real const root = std::sqrt(glm::max((1 - g) * (1 - g) + 2 * g * (1 - c), real(1e-8)));
  return (1 - g * g) / (4 * pi * root * root * root);
}

/// A cosine with that density, from a number in [0, 1).
PT_HD inline real sample_phase(real anisotropy, real u) {
  real const g = anisotropy;
  if (std::fabs(g) < real(1e-3)) return 1 - 2 * u;
  real const ratio = (1 - g * g) / (1 - g + 2 * g * u);
  return glm::clamp((1 + g * g - ratio * ratio) / (2 * g), real(-1), real(1));
}

namespace effects {

/// Fog: a homogeneous medium that fills all space, except for the inside of glass. `extras` of a
/// scene describe it. Light from infinitely far does not arrive in the channels that it
/// extinguishes.
struct medium {
  static constexpr char const* name = "medium";
  struct scene_part {
    vec3 medium_scattering{0}, medium_absorption{0};
    real medium_anisotropy = 0;
  };
  static constexpr property<scene_part> scene_properties[] = {
      color_property("extras/medium_scattering", &scene_part::medium_scattering, 0, 1e6),
      color_property("extras/medium_absorption", &scene_part::medium_absorption, 0, 1e6),
      number_property("extras/medium_anisotropy", &scene_part::medium_anisotropy, -0.99, 0.99)};

  /// Its shader is that of a point in the medium, not of a surface.
  template <class Material>
  static bool fits(Material const&) {
    return false;
  }
  template <class Scene>
  static bool in_scene(Scene const& s) {
    return max_component(s.medium_scattering + s.medium_absorption) > 0;
  }

  /// Samples the distance to the next particle, at most `surface`. Returns whether the path meets a
  /// particle before the surface. The distance is sampled for one channel, chosen by its
  /// throughput, which compensates for that (one-sample balance heuristic, Veach 1997). Where
  /// nothing is absorbed, throughput is the density of the whole path in each channel over the mean
  /// of these (Wilkie et al. 2014): their sum stays, and none can grow without bound.
  template <class Batch, class View>
  PT_HD static bool scatters(Batch const& batch, View const& m, std::uint32_t i, real surface) {
    vec2 const u = batch.random(i).pair(path_draw::free_path + batch.bounce);
    vec3 const throughput = batch.throughput[i];
    vec3 const share = throughput / (throughput.x + throughput.y + throughput.z);
    int const channel = u.x < share.x ? 0 : u.x < share.x + share.y || share.z == 0 ? 1 : 2;
    real const coefficient = m.extinction[channel];
    real const distance = coefficient > 0 ? -std::log(1 - u.y) / coefficient : endless;
    bool const inside = coefficient > 0 && distance < surface;
    vec3 const left = m.transmittance(glm::min(inside ? distance : surface, endless));
    vec3 const density = inside ? m.extinction * left : left;
    real const mean = glm::dot(share, density);
    vec3 const carried = inside ? m.scattering * left : left;
    batch.throughput[i] *= mean > 0 ? carried / mean : vec3{0};
    if (inside) batch.origin[i] += distance * vec3(batch.direction[i]);
    return inside;
  }
};

}  // namespace effects
}  // namespace path_tracer
