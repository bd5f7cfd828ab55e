// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <deferred_shade/deferred_shade.hpp>
#include <type_traits>
#include <utility>

/// Stand-ins for the shaders of Hoberock et al., HPG 2009: a body of its own for every id, so that
/// requests of two shaders diverge, and no memory but the request and the result.
namespace bench {

namespace ds = deferred_shade;

/// What a shader is given: 32 bytes, two 128-bit loads.
struct alignas(16) request {
  float position[3];
  float u;
  float normal[3];
  float v;
};
static_assert(sizeof(request) == 32);

/// What it gives back: 16 bytes, one 128-bit store.
struct alignas(16) result {
  float radiance[3];
  float throughput;
};
static_assert(sizeof(result) == 16);

/// A 32-bit integer with its bits mixed: the finalizer of MurmurHash3 (Austin Appleby).
DEFERRED_SHADE_HOST_DEVICE inline std::uint32_t mixed(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x85ebca6bU;
  x ^= x >> 13;
  x *= 0xc2b2ae35U;
  return x ^ (x >> 16);
}

/// From all values of `bits`, uniform in [0, 1).
DEFERRED_SHADE_HOST_DEVICE inline float uniform(std::uint32_t bits) {
  return static_cast<float>(bits >> 8) * 0x1p-24F;
}

/// Value noise in three dimensions: hashed corners, blended by smooth steps.
DEFERRED_SHADE_HOST_DEVICE inline float value_noise(float x, float y, float z) {
  float const floors[3] = {std::floor(x), std::floor(y), std::floor(z)};
  float const parts[3] = {x - floors[0], y - floors[1], z - floors[2]};
  float weights[3];
  std::uint32_t cell[3];
  for (int d = 0; d < 3; ++d) {
    weights[d] = parts[d] * parts[d] * (3 - 2 * parts[d]);
    cell[d] = static_cast<std::uint32_t>(static_cast<std::int32_t>(floors[d]));
  }
  float sum = 0;
  for (std::uint32_t corner = 0; corner < 8; ++corner) {
    std::uint32_t const step[3] = {corner & 1, corner >> 1 & 1, corner >> 2};
    float weight = 1;
    for (int d = 0; d < 3; ++d) weight *= step[d] == 1 ? weights[d] : 1 - weights[d];
    sum += weight *
           uniform(mixed((cell[0] + step[0]) * 0x9e3779b1U + (cell[1] + step[1]) * 0x85ebca77U +
                         (cell[2] + step[2]) * 0xc2b2ae3dU));
  }
  return sum;
}

/// A few operations.
template <int Id>
struct simple {
  DEFERRED_SHADE_HOST_DEVICE result operator()(request const& r) const {
    float const cosine = r.normal[0] * 0.48F + r.normal[1] * 0.6F + r.normal[2] * 0.64F;
    float const lit = (0.2F + 0.05F * Id) * (cosine > 0 ? cosine : 0);
    return {{lit * r.u, lit * r.position[0], lit * r.position[1]}, cosine * r.v};
  }
};

/// About 200 operations: a microfacet lobe (Trowbridge and Reitz's distribution, Schlick's Fresnel
/// term) under four to six lights, each behind a batch pattern.
template <int Id>
struct moderate {
  static constexpr int lights = 4 + Id % 3;
  static constexpr bool runs_in_vectors = false;  // std::pow and std::sin are calls

  DEFERRED_SHADE_HOST_DEVICE result operator()(request const& r) const {
    constexpr float alpha = 0.05F + 0.025F * Id;
    float const half[3] = {r.normal[0] + r.position[0], r.normal[1] + r.position[1],
                           r.normal[2] + r.position[2]};
    float const length = std::sqrt(dot(half, half) + 1e-8F);
    float const cosine = std::fabs(dot(half, r.normal)) / length;
    float const fresnel = 0.04F + 0.96F * std::pow(1 - std::fmin(cosine, 1.0F), 5.0F);
    result out{{0, 0, 0}, fresnel};
    for (int light = 0; light < lights; ++light) {
      auto const number = static_cast<float>(light);
      float const alpha2 = alpha * alpha * (1 + 0.3F * number);
      float const t = cosine * cosine * (alpha2 - 1) + 1;
      float const distribution = alpha2 / (3.14159265F * t * t + 1e-6F);
      float const toward = std::fabs(r.normal[2] + 0.1F * number * r.normal[0]);
      float const masking =
          1 / (toward + std::sqrt(alpha2 + (1 - alpha2) * toward * toward) + 1e-4F);
      float const batch = 1 + 0.5F * std::sin(9 * r.u + 5 * r.v + number + Id);
      out.radiance[0] += distribution * fresnel * masking * 0.01F;
      out.radiance[1] += distribution * masking * batch * 0.02F;
      out.radiance[2] += fresnel * masking * batch;
    }
    return out;
  }

 private:
  DEFERRED_SHADE_HOST_DEVICE static float dot(float const* a, float const* b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }
};

/// Thousands of operations: the moderate shader, coloured by eight octaves of noise.
template <int Id>
struct procedural {
  static constexpr bool runs_in_vectors = false;

  DEFERRED_SHADE_HOST_DEVICE result operator()(request const& r) const {
    result out = moderate<Id>{}(r);
    float scale = 3;
    float amplitude = 0.5F;
    float turbulence = 0;
    for (int octave = 0; octave < 8; ++octave) {
      turbulence += amplitude * value_noise(r.position[0] * scale + Id, r.position[1] * scale,
                                            r.position[2] * scale);
      scale *= 2.02F;
      amplitude *= 0.5F;
    }
    float const vein = std::sin(10 * turbulence + Id);
    out.radiance[0] *= 1 + 0.5F * vein;
    out.radiance[1] += turbulence;
    out.radiance[2] = out.radiance[2] * vein + turbulence;
    return out;
  }
};

/// A function on records as a renderer's index shader has it: it loads and stores for itself, so
/// that the library sees a callable on an index and no more.
template <class Function>
struct indexed {
  request const* requests;
  result* results;
  Function function;
  DEFERRED_SHADE_HOST_DEVICE void operator()(ds::request_index i) const {
    results[i] = function(requests[i]);
  }
};

/// A set of shaders: so many simple ones, then moderate ones, then procedural ones.
template <int Simple, int Moderate, int Procedural>
struct shader_set {
  static constexpr int size = Simple + Moderate + Procedural;

  /// The table of record shaders.
  static auto record(request const* requests, result* results) {
    return record(requests, results, std::make_integer_sequence<int, size>());
  }

  /// The table of index shaders.
  static auto index(request const* requests, result* results) {
    return index(requests, results, std::make_integer_sequence<int, size>());
  }

 private:
  template <int Id>
  using function = std::conditional_t<
      (Id < Simple), simple<Id>,
      std::conditional_t<(Id < Simple + Moderate), moderate<Id>, procedural<Id>>>;

  template <int... Ids>
  static auto record(request const* requests, result* results, std::integer_sequence<int, Ids...>) {
    return ds::record_shaders(requests, results, function<Ids>{}...);
  }
  template <int... Ids>
  static auto index(request const* requests, result* results, std::integer_sequence<int, Ids...>) {
    return ds::shader_table{indexed<function<Ids>>{requests, results, {}}...};
  }
};

}  // namespace bench
