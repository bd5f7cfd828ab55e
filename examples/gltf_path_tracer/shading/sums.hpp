// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/math.hpp"
#include "shading/accuracy.hpp"

namespace path_tracer {

/// The sum of a pixel's samples, one type for each way to add them up; starts at 0.
template <summation How>
struct pixel_sum;

template <>
struct pixel_sum<summation::in_double> {
  glm::dvec3 total{0};
  PT_HD void add(vec3 v) { total += glm::dvec3(v); }
};

template <>
struct pixel_sum<summation::in_float> {
  rgb total{0};
  PT_HD void add(vec3 v) { total += rgb(v); }
};

/// Keeps the rounding error, and adds it to the next sample (Kahan 1965).
template <>
struct pixel_sum<summation::compensated> {
  rgb total{0}, lost{0};
  PT_HD void add(vec3 v) {
    rgb const due = rgb(v) - lost;
    rgb const next = total + due;
    lost = (next - total) - due;
    total = next;
  }
};

}  // namespace path_tracer
