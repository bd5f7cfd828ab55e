// SPDX-License-Identifier: Apache-2.0
#pragma once

#define GLM_FORCE_SILENT_WARNINGS
#ifdef __CUDACC__
#include <cuda.h>  // for its version, which glm asks for
#define GLM_FORCE_CUDA
#pragma nv_diagnostic push
#pragma nv_diag_suppress 20012  // glm marks defaulted functions as host/device
#endif
#include <glm/glm.hpp>
#ifdef __CUDACC__
#pragma nv_diagnostic pop
#endif

#include <deferred_shade/config.hpp>
#include <limits>

#define PT_HD DEFERRED_SHADE_HOST_DEVICE

namespace path_tracer {

/// The numbers of a renderer: positions, directions, light. Pictures are float, sums as asked.
#ifdef PATH_TRACER_DOUBLE
using real = double;
#else
using real = float;
#endif
using vec2 = glm::vec<2, real>;
using vec3 = glm::vec<3, real>;
using vec4 = glm::vec<4, real>;
using rgb = glm::vec<3, float>;  ///< of pictures

inline constexpr real pi = real(3.14159265358979323846);

/// From 1 to the next number.
inline constexpr real epsilon = std::numeric_limits<real>::epsilon();

/// Rec. 709 luminance of linear RGB.
PT_HD inline real luminance(vec3 c) {
  return real(0.2126) * c.x + real(0.7152) * c.y + real(0.0722) * c.z;
}

PT_HD inline real max_component(vec3 c) {
  return c.x > c.y ? (c.x > c.z ? c.x : c.z) : (c.y > c.z ? c.y : c.z);
}

}  // namespace path_tracer
