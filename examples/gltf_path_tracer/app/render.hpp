// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "app/timeline.hpp"
#include "scene/scene.hpp"
#include "shading/accuracy.hpp"

namespace path_tracer {

struct render_settings {
  std::uint32_t width = 512, height = 288;
  std::uint32_t samples = 16;    ///< per pixel
  std::uint32_t max_depth = 16;  ///< surface hits of a path at most
  std::uint64_t seed = 1;
  accuracy_settings accuracy;
  std::string backend = "omp";     ///< one of backends()
  std::string schedule = "local";  ///< one of schedules()
  unsigned threads = 0;            ///< of the CPU; 0: as many as it has
  /// Which code runs: the number of a declared set of effects; any larger one stands for all.
  std::size_t variant = ~std::size_t{0};
  /// The shaders that are launched, in schedules that launch one after another.
  std::bitset<shader_count> expected = std::bitset<shader_count>().set();
  bool statistics = false;     ///< fill all of a bounce
  std::size_t most_spans = 0;  ///< a timeline ends with the batch that reaches so many; 0: none
};

/// What one bounce took, summed over all batches of the image.
struct bounce {
  std::uint64_t requests = 0;  ///< requests that ran a shader
  double group_ms = 0;         ///< the schedule over shaders that do nothing
  double shade_ms = 0;         ///< total_ms - group_ms
  double total_ms = 0;         ///< the schedule over the real shaders
  double efficiency = 0;       ///< heterogeneous efficiency of the first batch in execution order
  std::vector<float>
      pixel_efficiency;  ///< per pixel of the first batch: its group's; NaN: no request
  std::vector<std::uint64_t> shader_requests;  ///< of each shader, in the first batch
};

struct render_result {
  std::vector<rgb> pixels;  ///< linear RGB radiance, row 0 on top
  std::vector<bounce> bounces;
  std::vector<std::uint8_t> first_shaders;  ///< per pixel, of its first hit; with statistics
  double seconds = 0;                       ///< without what statistics took
  std::uint64_t rays = 0;                   ///< closest-hit and shadow rays
  std::uint64_t discarded_samples = 0;      ///< samples that were not finite
  path_tracer::timeline timeline;
};

/// Names for --backend and --schedule, in the order of the table that `--schedule all` prints.
std::vector<std::string_view> backends();
std::vector<std::string_view> schedules();

/// Chooses the least code that has all effects which the scene calls for, and the shaders of its
/// materials.
void specialize(render_settings& settings, scene const& s);

/// How many paths are traced together: one sample of each pixel, but from 2^18 to 2^20 paths, and
/// no more than the picture has.
std::uint64_t batch_size_of(render_settings const& settings);

/// Renders `s`; calls `progress` with the fraction done, from the calling thread.
/// Throws std::invalid_argument for a name that the lists above do not have, and for code that
/// lacks an effect which the scene calls for; std::runtime_error where there is no GPU for a
/// backend that needs one.
render_result render(scene const& s, render_settings const& settings,
                     std::function<void(double)> const& progress = {});

}  // namespace path_tracer
