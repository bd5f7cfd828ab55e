// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

#include "scene/math.hpp"

#ifdef __CUDACC__
#include <cuda_fp16.h>
#else
#include <glm/gtc/packing.hpp>
#endif

namespace path_tracer {

// Smaller records for the state of paths between stages, if the renderer is built with
// PATH_TRACER_COMPACT (see path.hpp). They are read and assigned like a vec3.

/// A unit vector in 32 bits: octahedral coordinates of 16 bits each (Cigolle et al., JCGT 2014).
/// Off by at most 1e-4 radians. What has no direction comes back as NaN.
class packed_direction {
 public:
  packed_direction() = default;
  PT_HD packed_direction(vec3 v) {
    real const size = std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z);
    if (!(size > 0 && size < INFINITY)) {
      bits_ = none;
      return;
    }
    v /= size;
    if (v.z < 0) v = folded(v);
    bits_ = coded(v.x) << 16 | coded(v.y);
  }
  PT_HD operator vec3() const {
    if (bits_ == none) return vec3{NAN};
    vec3 v{decoded(bits_ >> 16), decoded(bits_ & 0xffffu), 0};
    v.z = 1 - std::fabs(v.x) - std::fabs(v.y);
    if (v.z < 0) {
      real const z = v.z;
      v = folded(v);
      v.z = z;
    }
    return glm::normalize(v);
  }

 private:
  /// Between the lower half of the octahedron and the corners of the square; either way.
  PT_HD static vec3 folded(vec3 v) {
    return {std::copysign(1 - std::fabs(v.y), v.x), std::copysign(1 - std::fabs(v.x), v.y), v.z};
  }
  static constexpr real steps = 32767;
  static constexpr std::uint32_t none = 0xffffffffu;  // a coordinate is 65534 at most
  PT_HD static std::uint32_t coded(real x) {
    return static_cast<std::uint32_t>(std::floor((x + 1) * steps + real(0.5)));
  }
  PT_HD static real decoded(std::uint32_t code) { return static_cast<real>(code) / steps - 1; }

  std::uint32_t bits_;
};

/// A colour in three numbers of 16 bits (binary16 of IEEE 754): eleven significant bits, and 0
/// below 6e-8. Finite values beyond +-65504 become +-65504. Halfway between two numbers, a GPU
/// rounds to the even one, and a CPU away from 0.
class alignas(8) packed_color {
 public:
  packed_color() = default;
  PT_HD packed_color(vec3 c) : red_(coded(c.x)), green_(coded(c.y)), blue_(coded(c.z)) {}
  PT_HD operator vec3() const { return {decoded(red_), decoded(green_), decoded(blue_)}; }

  PT_HD packed_color& operator+=(vec3 c) { return *this = vec3(*this) + c; }
  PT_HD packed_color& operator*=(vec3 c) { return *this = vec3(*this) * c; }
  PT_HD friend vec3 operator*(packed_color a, vec3 b) { return vec3(a) * b; }
  PT_HD friend bool operator==(packed_color a, vec3 b) { return vec3(a) == b; }

 private:
  PT_HD static std::uint16_t coded(real x) {
    constexpr real largest = 65504;
    bool const is_finite = x - x == 0;
    float const v = static_cast<float>(is_finite ? glm::clamp(x, -largest, largest) : x);
#ifdef __CUDACC__
    return __half_as_ushort(__float2half_rn(v));
#else
    return glm::packHalf1x16(v);
#endif
  }
  PT_HD static real decoded(std::uint16_t code) {
#ifdef __CUDACC__
    return __half2float(__ushort_as_half(code));
#else
    return glm::unpackHalf1x16(code);
#endif
  }

  std::uint16_t red_, green_, blue_;
};

}  // namespace path_tracer
