// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thrust/fill.h>
#include <thrust/for_each.h>
#include <thrust/functional.h>
#include <thrust/iterator/counting_iterator.h>
#include <thrust/memory.h>
#include <thrust/transform_reduce.h>

#include <chrono>
#include <deferred_shade/deferred_shade.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/backends.hpp"
#include "app/batch_storage.hpp"
#include "app/host_backend.hpp"
#include "app/span_recorder.hpp"
#include "app/statistics.hpp"
#include "shading/scattering.hpp"
#include "shading/shaders.hpp"
#include "shading/stages.hpp"

namespace path_tracer {

/// The shader of an effect, where a set has it.
template <class Effect, class Set>
auto make_shader(batch_view<Set> const& w, scene_view const& s) {
  if constexpr (Set::template has<Effect>) {
    return surface_shader<Effect, Set>{w, s};
  } else {
    return deferred_shade::no_shader{};
  }
}

/// The table that `enum shader` numbers, of the shaders that a set of effects has.
template <class Set, int... Numbers>
auto make_shaders(batch_view<Set> const& w, scene_view const& s,
                  std::integer_sequence<int, Numbers...>) {
  return deferred_shade::shader_table{make_shader<effect_at<Numbers>>(w, s)...,
                                      miss_shader<Set>{w, s}};
}
template <class Set>
auto make_shaders(batch_view<Set> const& w, scene_view const& s) {
  return make_shaders(w, s, std::make_integer_sequence<int, shader_count - 1>());
}

/// A wavefront path tracer on one backend: every stage runs over all paths of a batch, and the one
/// that diverges, shading, goes through the library.
template <class Backend, class Set>
class integrator {
 public:
  integrator(Backend const& backend, scene_view const& scene, render_settings const& settings)
      : backend_(backend),
        exec_(backend.policy()),
        scene_(scene),
        settings_(settings),
        scratch_(exec_),
        group_time_(backend),
        total_time_(backend),
        spans_(backend, settings.most_spans) {}

  template <class Schedule>
  render_result run(Schedule const& schedule, progress_function const& progress) {
    summation const sums = settings_.accuracy.sums;
    if (sums == summation::in_float)
      run_with<pixel_sum<summation::in_float>>(schedule, progress);
    else if (sums == summation::compensated)
      run_with<pixel_sum<summation::compensated>>(schedule, progress);
    else
      run_with<pixel_sum<summation::in_double>>(schedule, progress);
    result_.timeline = spans_.take();
    return std::move(result_);
  }

 private:
  using stopwatch = typename Backend::stopwatch;
  using clock = std::chrono::steady_clock;

  template <class Sum, class Schedule>
  void run_with(Schedule const& schedule, progress_function const& progress) {
    auto const whole = spans_.open("render");
    auto const start = clock::now();
    std::uint64_t const pixels = std::uint64_t{settings_.width} * settings_.height;
    std::uint64_t const items = pixels * settings_.samples;
    std::uint64_t const batch_size = batch_size_of(settings_);
    batch_storage<Backend, Set> storage(backend_, batch_size);
    batch_view<Set> batch = storage.view();
    batch.seed = settings_.seed;
    batch.pixels = static_cast<std::uint32_t>(pixels);
    batch.max_depth = settings_.max_depth;
    batch.roulette_from = settings_.accuracy.roulette_from;
    auto sums = backend_.template make_array<Sum>(pixels);
    scratch_.reserve(batch_size, shader_count);
    if (settings_.statistics)
      aside([&] { warm_up(schedule, batch, static_cast<std::uint32_t>(batch_size)); });
    for (batch.first = 0; batch.first < items; batch.first += batch_size) {
      auto const paths = static_cast<std::uint32_t>(glm::min(batch_size, items - batch.first));
      auto const touched = static_cast<std::uint32_t>(glm::min(pixels, std::uint64_t{paths}));
      spans_.begin_batch();
      {
        auto const in_batch =
            spans_.open("batch " + std::to_string(batch.first / batch_size + 1), paths);
        trace_batch(schedule, batch, paths);
        for_all("accumulate", touched, accumulate_samples<Sum>{batch, paths, data_of(sums)});
        result_.discarded_samples += sum_over("count discarded", paths, count_discarded{batch});
      }
      spans_.end_batch();
      if (progress) progress(static_cast<double>(batch.first + paths) / static_cast<double>(items));
    }
    result_.pixels.reserve(pixels);
    for (Sum const& sum : backend_.to_host(std::move(sums)))
      result_.pixels.emplace_back(glm::dvec3(sum.total) / double(settings_.samples));
    for (bounce& b : result_.bounces) {
      b.shade_ms = b.total_ms - b.group_ms;
      aside_seconds_ += 1e-3 * b.group_ms;
    }
    result_.seconds = seconds_since(start) - aside_seconds_;
  }

  static double seconds_since(clock::time_point start) {
    return std::chrono::duration<double>(clock::now() - start).count();
  }
  /// Does what belongs to statistics and not to the picture; its time does not count.
  template <class Function>
  void aside(Function const& f) {
    auto const in_aside = spans_.open("statistics");
    auto const start = clock::now();
    f();
    aside_seconds_ += seconds_since(start);
  }

  template <class Function>
  void for_all(char const* stage, std::uint32_t count, Function const& f) {
    auto const in_stage = spans_.open(stage);
    thrust::for_each_n(exec_, thrust::counting_iterator<request_index>(0), count, f);
  }
  template <class Function>
  std::uint64_t sum_over(char const* stage, std::uint32_t count, Function const& f) {
    auto const in_stage = spans_.open(stage);
    thrust::counting_iterator<request_index> const first(0);
    return thrust::transform_reduce(exec_, first, first + count, f, std::uint64_t{0},
                                    thrust::plus<std::uint64_t>());
  }
  template <class Schedule, class Table>
  void timed_shade(char const* stage, Schedule const& schedule, std::uint32_t paths,
                   std::uint8_t const* ids, Table const& table, stopwatch& time) {
    auto const in_stage = spans_.open(stage);
    deferred_shade::observed seen{scratch_, spans_.observer()};
    time.start();
    deferred_shade::shade(exec_, schedule, paths, ids, table, seen);
    time.stop();
  }

  /// Runs the schedule over paths that are all finished, for no time to count what a first launch
  /// takes: the start of threads, or the way of the kernels to the device.
  template <class Schedule>
  void warm_up(Schedule const& schedule, batch_view<Set> const& batch, std::uint32_t paths) {
    thrust::fill_n(exec_, batch.id, paths, finished);
    shade_and_time(schedule, batch, paths);
  }

  /// Shades a batch; with statistics, groups it before by shaders that do nothing.
  template <class Schedule>
  void shade_and_time(Schedule const& schedule, batch_view<Set> const& batch, std::uint32_t paths) {
    auto const& expected = settings_.expected;
    if (settings_.statistics)
      timed_shade("shade nothing", schedule, paths, batch.id,
                  uniform_table(empty_shader{}).expecting(expected), group_time_);
    timed_shade("shade", schedule, paths, batch.id, make_shaders(batch, scene_).expecting(expected),
                total_time_);
  }

  template <class Schedule>
  void trace_batch(Schedule const& schedule, batch_view<Set> batch, std::uint32_t paths) {
    for_all("generate", paths,
            generate_paths<Set>{batch, scene_.view, settings_.width, settings_.height});
    ray_count rays{paths, 0};
    for (batch.bounce = 0; rays.extended > 0 && batch.bounce != batch.max_depth; ++batch.bounce) {
      auto const in_bounce =
          spans_.open("bounce " + std::to_string(batch.bounce + 1), rays.extended);
      for_all("intersect", paths, find_hits<Set>{batch, scene_});
      if (result_.bounces.size() == batch.bounce) result_.bounces.emplace_back();
      bounce& b = result_.bounces[batch.bounce];
      b.requests += rays.extended;
      shade_and_time(schedule, batch, paths);
      for_all("shadow", paths, trace_shadows<Set>{batch, scene_});
      result_.rays += rays.extended;
      rays = ray_count::unpacked(sum_over("count rays", paths, count_rays{batch}));
      result_.rays += rays.shadow;
      b.total_ms += total_time_.milliseconds();
      if (settings_.statistics) b.group_ms += group_time_.milliseconds();
      if (settings_.statistics && batch.first == 0)
        aside([&] { measure_efficiency(schedule, backend_.to_host(batch.id, paths), batch, b); });
      if (settings_.statistics && batch.bounce == 0 && batch.first < batch.pixels)
        aside([&] { keep_first_shaders(backend_.to_host(batch.id, paths), batch.pixels); });
    }
  }

  /// Takes the ids of the first hits, of one sample for each pixel: those come first in a picture.
  void keep_first_shaders(std::vector<std::uint8_t> const& ids, std::size_t pixels) {
    std::vector<std::uint8_t>& kept = result_.first_shaders;
    auto const count = static_cast<std::ptrdiff_t>(glm::min(ids.size(), pixels - kept.size()));
    kept.insert(kept.end(), ids.begin(), ids.begin() + count);
  }

  Backend const& backend_;
  decltype(std::declval<Backend const&>().policy()) exec_;
  scene_view scene_;
  render_settings settings_;
  decltype(deferred_shade::workspace{std::declval<Backend const&>().policy()}) scratch_;
  stopwatch group_time_, total_time_;
  span_recorder<Backend> spans_;
  double aside_seconds_ = 0;
  render_result result_;
};

/// Calls `f` with the schedule that goes by `name`; false if there is none.
template <class Function>
bool with_schedule(std::string_view name, Function const& f) {
  bool found = false;
  deferred_shade::for_each_schedule([&](std::string_view known, auto const& schedule) {
    if (known != name) return;
    found = true;
    f(schedule);
  });
  return found;
}

/// Renders a scene in the memory of `backend` by the schedule that the settings name, with code for
/// a set of effects.
template <class Set, class Backend>
render_result integrate(Backend const& backend, scene_view const& scene,
                        render_settings const& settings, progress_function const& progress) {
  render_result result;
  bool const known = with_schedule(settings.schedule, [&](auto const& schedule) {
    result = integrator<Backend, Set>{backend, scene, settings}.run(schedule, progress);
  });
  if (!known) throw std::invalid_argument("unknown schedule \"" + settings.schedule + "\"");
  return result;
}

}  // namespace path_tracer
