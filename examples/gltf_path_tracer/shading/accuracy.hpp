// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace path_tracer {

/// How to find light from surfaces and the environment: by sampling lights and BSDFs, weighted by
/// multiple importance sampling (Veach 1997, section 9.2), or by one of them alone. In any case,
/// punctual lights are sampled, and paths follow mirrors and smooth glass.
enum class estimator : std::uint8_t { mis, bsdf, light };
inline constexpr char const* estimator_names[] = {"mis", "bsdf", "light"};

/// How the samples of a pixel are added up.
enum class summation : std::uint8_t { in_double, compensated, in_float };
inline constexpr char const* summation_names[] = {"double", "compensated", "float"};

/// How a build of the program computes, and what it stores between stages.
#if defined(PATH_TRACER_DOUBLE)
inline constexpr char const* precision_name = "double";
#elif defined(PATH_TRACER_FAST)
inline constexpr char const* precision_name = "fast";
#else
inline constexpr char const* precision_name = "float";
#endif
#ifdef PATH_TRACER_COMPACT
inline constexpr char const* storage_name = "compact";
#else
inline constexpr char const* storage_name = "full";
#endif

/// The accuracy that a picture may trade for time (docs/accuracy.md). By default, more samples
/// remove every error, except for that of the maximal depth of paths.
struct accuracy_settings {
  estimator light = estimator::mis;
  summation sums = summation::in_double;
  /// From this surface hit on, Russian roulette may end a path; the throughput of survivors grows.
  std::uint32_t roulette_from = 5;
  /// Octaves that procedural textures have at most.
  std::uint32_t octaves = 16;
};

}  // namespace path_tracer
