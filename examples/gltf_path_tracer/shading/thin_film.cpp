// SPDX-License-Identifier: Apache-2.0
#include "shading/thin_film.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "shading/spectrum.hpp"

namespace path_tracer {
namespace {

/// Fresnel's amplitudes from index n1 to n2, for the two polarisations.
struct amplitudes {
  double s, p;
};
amplitudes fresnel_amplitudes(double n1, double cos1, double n2, double cos2) {
  return {(n1 * cos1 - n2 * cos2) / (n1 * cos1 + n2 * cos2),
          (n2 * cos1 - n1 * cos2) / (n2 * cos1 + n1 * cos2)};
}

double reflected(double r01, double r12, std::complex<double> phase) {
  return std::norm((r01 + r12 * phase) / (1.0 + r01 * r12 * phase));
}

}  // namespace

double film_reflectance_at(double cos_theta, double wavelength, double film, double thickness,
                           double base) {
  double const sin2 = 1 - cos_theta * cos_theta;
  double const cos1 = std::sqrt(1 - sin2 / (film * film));
  double const cos2 = std::sqrt(1 - sin2 / (base * base));
  double const pi = std::acos(-1.0);
  std::complex<double> const phase = std::polar(1.0, 4 * pi * film * thickness * cos1 / wavelength);
  amplitudes const upper = fresnel_amplitudes(1, cos_theta, film, cos1);
  amplitudes const lower = fresnel_amplitudes(film, cos1, base, cos2);
  return 0.5 * (reflected(upper.s, lower.s, phase) + reflected(upper.p, lower.p, phase));
}

film_reflectance reflectance_of_film(double film, double thickness, vec3 f0) {
  constexpr int wavelengths = 300;  // as many as nanometres: a film of 10 um has fringes of 8 nm
  film_reflectance result{};
  glm::dvec3 base;
  for (int c = 0; c < 3; ++c) {
    double const root = std::sqrt(glm::clamp(double{f0[c]}, 0.0, 0.9999));
    base[c] = (1 + root) / (1 - root);
  }
  for (int k = 0; k < film_reflectance::samples; ++k) {
    // Just above the surface: at it, a film that is none would be 0 / 0.
    double const cos_theta =
        std::max(static_cast<double>(k) / (film_reflectance::samples - 1), 1e-6);
    glm::dvec3 sum(0), weights(0);
    for (int w = 0; w < wavelengths; ++w) {
      real const wavelength = sample_wavelength((static_cast<real>(w) + real(0.5)) / wavelengths);
      glm::dvec3 const color(signed_color_of(wavelength));  // the sum alone is clipped
      for (int c = 0; c < 3; ++c)
        sum[c] +=
            color[c] * film_reflectance_at(cos_theta, double{wavelength}, film, thickness, base[c]);
      weights += color;
    }
    result.values[k] = vec3(glm::clamp(sum / weights, glm::dvec3(0), glm::dvec3(1)));
  }
  return result;
}

}  // namespace path_tracer
