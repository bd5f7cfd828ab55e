// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "effects/effect.hpp"
#include "effects/glass.hpp"
#include "shading/path_draws.hpp"
#include "shading/spectrum.hpp"

namespace path_tracer::effects {

/// The refractive index at a wavelength in nanometres, of a glass with index `ior` at 587.6 nm. As
/// in KHR_materials_dispersion, Cauchy's formula gives it from the Abbe number, which is 20 /
/// `dispersion`.
PT_HD inline real dispersive_ior(real ior, real dispersion, real wavelength) {
  real const spread = (ior - 1) * dispersion / 20;
  return glm::max(ior + spread * (523655 / (wavelength * wavelength) - real(1.5168)), real(1));
}

/// Glass that refracts colours differently (KHR_materials_dispersion). At the first such glass, a
/// path chooses one wavelength for all later bounces, and its throughput takes the colour of that.
struct dispersion {
  static constexpr char const* name = "dispersion";
  struct material_part {
    real dispersion = 0;
  };
  static constexpr property<material_part> material_properties[] = {number_property(
      "extensions/KHR_materials_dispersion/dispersion", &material_part::dispersion, 0, 1e3)};
  using path_state = real;  ///< the wavelength in nanometres; 0: all

  template <class Material>
  static bool in_material(Material const& m) {
    return is_glass(m) && m.dispersion > 0;
  }

  template <class Batch, class Point>
  PT_HD static void at_glass(Batch const& batch, std::uint32_t i, Point& p) {
    if (p.material.dispersion == 0) return;
    real& wavelength = batch.template state<dispersion>(i);
    if (wavelength == 0) {
      wavelength = sample_wavelength(batch.random(i).pair(path_draw::wavelength).x);
      batch.throughput[i] *= color_of(wavelength);
    }
    p.ior = dispersive_ior(p.material.ior, p.material.dispersion, wavelength);
  }
};

}  // namespace path_tracer::effects
