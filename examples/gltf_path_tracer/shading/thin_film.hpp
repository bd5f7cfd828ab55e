// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/math.hpp"

namespace path_tracer {

/// The reflectance of a surface with a thin film on it, by the cosine of the angle: `samples`
/// values at equal distances from 0 to 1.
struct film_reflectance {
  static constexpr int samples = 33;
  vec3 values[samples];

  PT_HD vec3 operator()(real cos_theta) const {
    real const x = glm::clamp(cos_theta, real(0), real(1)) * static_cast<real>(samples - 1);
    int const k = glm::min(static_cast<int>(x), samples - 2);
    return glm::mix(values[k], values[k + 1], x - static_cast<real>(k));
  }
};

/// The reflectance of a thin film between air and a base, for unpolarised light of one wavelength:
/// Airy's sum over all reflections inside the film. `film` and `base` are real refractive indices;
/// wavelength and thickness are in nanometres.
double film_reflectance_at(double cos_theta, double wavelength, double film, double thickness,
                           double base);

/// Its means over the wavelengths as the three channels see them. `f0` is what the base reflects at
/// normal incidence without the film.
film_reflectance reflectance_of_film(double film, double thickness, vec3 f0);

}  // namespace path_tracer
