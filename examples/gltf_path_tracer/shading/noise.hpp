// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

#include "scene/math.hpp"
#include "shading/random.hpp"

namespace path_tracer {

/// Gradient noise (Perlin 1985, quintic fade of 2002) over the integer lattice: 0 at each lattice
/// point, continuous with two derivatives, within [-1, 1]. Gradients are the twelve edge
/// directions of a cube, picked by a hash; there is no table and no period below 2^21.
PT_HD inline real gradient_at(std::int32_t x, std::int32_t y, std::int32_t z, vec3 d) {
  std::uint64_t const cell = (static_cast<std::uint64_t>(x) & 0x1fffffu) |
                             (static_cast<std::uint64_t>(y) & 0x1fffffu) << 21 |
                             (static_cast<std::uint64_t>(z) & 0x1fffffu) << 42;
  auto const edge = static_cast<std::uint32_t>(((mix_bits(cell) >> 32) * 12u) >> 32);
  std::uint32_t const axis = edge >> 2;  // the coordinate that the gradient does not have
  real const a = axis == 0 ? d.y : d.x;
  real const b = axis == 2 ? d.y : d.z;
  return ((edge & 1u) != 0 ? -a : a) + ((edge & 2u) != 0 ? -b : b);
}

PT_HD inline real gradient_noise(vec3 p) {
  vec3 const base = glm::floor(p);
  vec3 const f = p - base;
  vec3 const w = f * f * f * (f * (f * real(6) - real(15)) + real(10));
  auto const x = static_cast<std::int32_t>(base.x), y = static_cast<std::int32_t>(base.y),
             z = static_cast<std::int32_t>(base.z);
  real layer[2];
  for (int k = 0; k < 2; ++k) {
    real row[2];
    for (int j = 0; j < 2; ++j) {
      vec3 const d{f.x, f.y - static_cast<real>(j), f.z - static_cast<real>(k)};
      real const g0 = gradient_at(x, y + j, z + k, d);
      real const g1 = gradient_at(x + 1, y + j, z + k, {d.x - 1, d.y, d.z});
      row[j] = g0 + w.x * (g1 - g0);
    }
    layer[k] = row[0] + w.y * (row[1] - row[0]);
  }
  return layer[0] + w.z * (layer[1] - layer[0]);
}

/// Octaves of noise, each of twice the frequency and half the amplitude: fractional Brownian
/// motion.
PT_HD inline real fbm(vec3 p, int octaves) {
  real sum = 0, amplitude = 1;
  for (int i = 0; i < octaves; ++i, amplitude *= real(0.5), p = p * real(2) + real(17))
    sum += amplitude * gradient_noise(p);
  return sum;
}

/// The same with the absolute value of each octave: creases where noise crosses 0 (Perlin 1985).
PT_HD inline real turbulence(vec3 p, int octaves) {
  real sum = 0, amplitude = 1;
  for (int i = 0; i < octaves; ++i, amplitude *= real(0.5), p = p * real(2) + real(17))
    sum += amplitude * std::fabs(gradient_noise(p));
  return sum;
}

/// Veins across x, bent by turbulence: 1 in a vein, 0 between two; one vein per unit of x.
PT_HD inline real marble_pattern(vec3 p, int octaves) {
  real const wave =
      std::fabs(std::sin(pi * (p.x + real(1.5) * turbulence(p, octaves < 5 ? octaves : 5))));
  return (1 - wave) * (1 - wave);
}

/// Rings about the y axis, one per unit of radius: 0 where a ring begins, 1 where it ends, with
/// fine grain along y.
PT_HD inline real wood_pattern(vec3 p, int octaves) {
  real const radius = std::sqrt(p.x * p.x + p.z * p.z) +
                      real(0.4) * fbm(p * vec3{1, real(0.25), 1}, octaves < 3 ? octaves : 3);
  real const ring = radius - std::floor(radius);
  real const grain = real(0.15) * gradient_noise(p * vec3{20, 1, 20});
  return glm::clamp(ring * ring + grain, real(0), real(1));
}

}  // namespace path_tracer
