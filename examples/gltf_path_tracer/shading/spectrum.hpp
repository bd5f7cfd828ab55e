// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "scene/math.hpp"

namespace path_tracer {

// Wavelengths, in nanometres, of paths that carry only one.
inline constexpr real shortest_wavelength = 400, longest_wavelength = 700;

/// A wavelength, uniform between the two, from a number in [0, 1).
PT_HD inline real sample_wavelength(real u) {
  return shortest_wavelength + u * (longest_wavelength - shortest_wavelength);
}

/// A lobe of two half Gaussians about `mean`.
PT_HD inline real two_gaussians(real x, real mean, real below, real above) {
  real const t = (x - mean) * (x < mean ? below : above);
  return std::exp(real(-0.5) * t * t);
}

/// The linear RGB of light of one wavelength, negative where that lies outside the gamut: from the
/// fits of the CIE 1931 colour matching functions by Wyman, Sloan and Shirley (JCGT 2013).
PT_HD inline vec3 signed_color_of(real wavelength) {
  real const x = real(0.362) * two_gaussians(wavelength, real(442), real(0.0624), real(0.0374)) +
                 real(1.056) * two_gaussians(wavelength, real(599.8), real(0.0264), real(0.0323)) -
                 real(0.065) * two_gaussians(wavelength, real(501.1), real(0.0490), real(0.0382));
  real const y = real(0.821) * two_gaussians(wavelength, real(568.8), real(0.0213), real(0.0247)) +
                 real(0.286) * two_gaussians(wavelength, real(530.9), real(0.0613), real(0.0322));
  real const z = real(1.217) * two_gaussians(wavelength, real(437), real(0.0845), real(0.0278)) +
                 real(0.681) * two_gaussians(wavelength, real(459), real(0.0385), real(0.0725));
  return {real(3.2404542) * x - real(1.5371385) * y - real(0.4985314) * z,
          real(-0.9692660) * x + real(1.8760108) * y + real(0.0415560) * z,
          real(0.0556434) * x - real(0.2040259) * y + real(1.0572252) * z};
}

/// The same for a path, which carries no negative light: moved to the border of the gamut, and
/// scaled such that the mean of each channel over the wavelengths is 1. White light is white.
PT_HD inline vec3 color_of(real wavelength) {
  return glm::max(signed_color_of(wavelength), vec3{0}) *
         vec3{real(1.7051129), real(2.5996478), real(2.7578811)};
}

}  // namespace path_tracer
