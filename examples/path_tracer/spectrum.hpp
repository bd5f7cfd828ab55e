// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "math.hpp"

namespace path_tracer {

// Wavelengths, in nanometres, of paths that carry only one.
inline constexpr float shortest_wavelength = 400, longest_wavelength = 700;

/// A wavelength, uniform between the two, from a number in [0, 1).
PT_HD inline float sample_wavelength(float u) {
  return shortest_wavelength + u * (longest_wavelength - shortest_wavelength);
}

/// A lobe of two half Gaussians about `mean`.
PT_HD inline float two_gaussians(float x, float mean, float below, float above) {
  float const t = (x - mean) * (x < mean ? below : above);
  return std::exp(-0.5f * t * t);
}

/// The linear RGB of light of one wavelength, scaled such that the mean of each channel over the
/// wavelengths is 1: white light is white. From the fits of the CIE 1931 colour matching functions
/// by Wyman, Sloan and Shirley (JCGT 2013); what lies outside the gamut is moved to its border.
PT_HD inline vec3 color_of(float wavelength) {
  float const x = 0.362f * two_gaussians(wavelength, 442.0f, 0.0624f, 0.0374f) +
                  1.056f * two_gaussians(wavelength, 599.8f, 0.0264f, 0.0323f) -
                  0.065f * two_gaussians(wavelength, 501.1f, 0.0490f, 0.0382f);
  float const y = 0.821f * two_gaussians(wavelength, 568.8f, 0.0213f, 0.0247f) +
                  0.286f * two_gaussians(wavelength, 530.9f, 0.0613f, 0.0322f);
  float const z = 1.217f * two_gaussians(wavelength, 437.0f, 0.0845f, 0.0278f) +
                  0.681f * two_gaussians(wavelength, 459.0f, 0.0385f, 0.0725f);
  vec3 const rgb{3.2404542f * x - 1.5371385f * y - 0.4985314f * z,
                 -0.9692660f * x + 1.8760108f * y + 0.0415560f * z,
                 0.0556434f * x - 0.2040259f * y + 1.0572252f * z};
  return glm::max(rgb, vec3{0}) * vec3{1.7051129f, 2.5996478f, 2.7578811f};
}

}  // namespace path_tracer
