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

#define PT_HD DEFERRED_SHADE_HOST_DEVICE

namespace path_tracer {

using glm::vec2;
using glm::vec3;
using glm::vec4;

inline constexpr float pi = 3.14159265358979323846f;

/// Rec. 709 luminance of linear RGB.
PT_HD inline float luminance(vec3 c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

PT_HD inline float max_component(vec3 c) {
  return c.x > c.y ? (c.x > c.z ? c.x : c.z) : (c.y > c.z ? c.y : c.z);
}

}  // namespace path_tracer
