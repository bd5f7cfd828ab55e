// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deferred_shade/config.hpp>

// The paths of a small renderer: 48 bytes of state and a hit of 32 bytes, in arrays of structs.

namespace renderer {

inline constexpr int bounces = 8;
inline constexpr std::uint8_t ended = 255;

struct alignas(16) path {
  float throughput[3];
  float radiance[3];
  std::uint32_t pixel;
  std::uint32_t bounce;
  std::uint64_t random;
  float wavelength, time;
};
struct alignas(16) hit {
  float position[3];
  float normal[3];
  float u, v;
};
static_assert(sizeof(path) == 48 && sizeof(hit) == 32);

/// What all shaders of a scene know: where radiance goes, and the share of paths that survive a
/// bounce, in parts of 2^32.
struct scene {
  float* film;  ///< three values per pixel
  std::uint64_t survival;
  std::uint32_t materials;
};

DEFERRED_SHADE_HOST_DEVICE inline std::uint32_t next_random(path& p) {
  p.random = p.random * 6364136223846793005U + 1442695040888963407U;
  return static_cast<std::uint32_t>(p.random >> 32);
}

/// The loop's length in a material's shader: short, medium or long, by turns; medium if there is
/// one material alone.
DEFERRED_SHADE_HOST_DEVICE constexpr int length_of(int material, std::uint32_t materials) {
  int const lengths[] = {16, 64, 256};
  return lengths[materials == 1 ? 1 : material % 3];
}

/// The material of a hit after this one, in which the next intersection is contained: a new hit.
DEFERRED_SHADE_HOST_DEVICE inline std::uint8_t next_material(path& p, hit& h, scene const& s) {
  ++p.bounce;
  bool const survives = next_random(p) < s.survival && p.bounce < bounces;
  std::uint32_t const draw = next_random(p);
  if (!survives) {
    for (int c = 0; c < 3; ++c) s.film[3 * std::size_t{p.pixel} + c] = p.radiance[c];
    return ended;
  }
  h.u = static_cast<float>(draw >> 8) * 0x1p-24F;
  h.v = 1 - h.u;
  for (int c = 0; c < 3; ++c) {
    h.position[c] = p.throughput[c] * h.u;
    h.normal[c] = p.radiance[c] * h.v;
  }
  return static_cast<std::uint8_t>(draw % s.materials);
}

/// Shades a hit by a material whose code no other one shares. Returns the next material, or
/// `ended`.
template <int Material, std::uint32_t Materials>
DEFERRED_SHADE_HOST_DEVICE std::uint8_t shade_hit(path& p, hit& h, scene const& s) {
  constexpr float roughness = 0.5F + 0.03F * static_cast<float>(Material);
  float x = h.position[0];
  float y = h.position[1] + h.normal[1];
  float z = h.position[2] * h.u + p.time;
  constexpr int length = length_of(Material, Materials);
  for (int i = 0; i < length; ++i) {
    x = x * roughness + y * 0.25F + 0.01F;
    y = y * 0.75F - z * roughness * 0.125F;
    z = z * 0.5F + x * h.v * 0.25F;
  }
  float const value[3] = {x, y, z};
  for (int c = 0; c < 3; ++c) {
    p.radiance[c] += p.throughput[c] * value[c];
    p.throughput[c] *= 0.9F;
  }
  return next_material(p, h, s);
}

/// The switch over all materials.
template <std::uint32_t Materials, int Material = 0>
DEFERRED_SHADE_HOST_DEVICE std::uint8_t shade_by_switch(std::uint32_t id, path& p, hit& h,
                                                        scene const& s) {
  if constexpr (Material == static_cast<int>(Materials)) {
    return ended;
  } else {
    if (id == Material) return shade_hit<Material, Materials>(p, h, s);
    return shade_by_switch<Materials, Material + 1>(id, p, h, s);
  }
}

/// A path as it begins, and the material of its first hit.
DEFERRED_SHADE_HOST_DEVICE inline std::uint8_t begin_path(std::uint32_t pixel, path& p, hit& h,
                                                          scene const& s) {
  p = {{1, 1, 1}, {0, 0, 0}, pixel, 0, pixel * 0x9e3779b97f4a7c15U + 1, 0.5F, 0.25F};
  std::uint32_t const draw = next_random(p);
  h = {{0.1F, 0.2F, 0.3F}, {0, 1, 0}, static_cast<float>(draw >> 8) * 0x1p-24F, 0.5F};
  return static_cast<std::uint8_t>(draw % s.materials);
}

}  // namespace renderer
