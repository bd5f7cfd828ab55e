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

#include "host_backend.hpp"
#include "host_scene.hpp"
#include "render.hpp"
#include "shaders.hpp"
#include "stages.hpp"
#include "statistics.hpp"

namespace path_tracer {

using progress_function = std::function<void(double)>;

/// A wave holds one sample of each pixel where that makes no more than 2^20 paths, else so many.
inline constexpr std::uint64_t small_wave = std::uint64_t{1} << 18;
inline constexpr std::uint64_t large_wave = std::uint64_t{1} << 20;

/// The first of an array of a backend.
template <class Array>
auto* data_of(Array& array) {
  return thrust::raw_pointer_cast(array.data());
}

/// The arrays behind a wave_view, in the memory of a backend.
template <class Backend>
class wave_storage {
 public:
  wave_storage(Backend const& backend, std::size_t paths)
      : vectors_(backend.template make_array<vec3>(7 * paths)),
        pdf_(backend.template make_array<float>(paths)),
        primitive_(backend.template make_array<std::uint32_t>(paths)),
        barycentric_(backend.template make_array<vec2>(paths)),
        id_(backend.template make_array<std::uint8_t>(paths)) {}

  wave_view view() {
    std::size_t const n = id_.size();
    vec3* const v = data_of(vectors_);
    wave_view w{};
    w.origin = v;
    w.direction = v + n;
    w.throughput = v + 2 * n;
    w.radiance = v + 3 * n;
    w.shadow_origin = v + 4 * n;
    w.shadow_vector = v + 5 * n;
    w.shadow_light = v + 6 * n;
    w.pdf = data_of(pdf_);
    w.primitive = data_of(primitive_);
    w.barycentric = data_of(barycentric_);
    w.id = data_of(id_);
    return w;
  }

 private:
  template <class T>
  using array = decltype(std::declval<Backend const&>().template make_array<T>(0));

  array<vec3> vectors_;
  array<float> pdf_;
  array<std::uint32_t> primitive_;
  array<vec2> barycentric_;
  array<std::uint8_t> id_;
};

/// The table that `enum shader` numbers.
inline auto make_shaders(wave_view const& w, scene_view const& s) {
  return deferred_shade::shader_table{surface_shader<shader::matte>{w, s},
                                      surface_shader<shader::metal>{w, s},
                                      surface_shader<shader::plastic>{w, s},
                                      surface_shader<shader::smooth_glass>{w, s},
                                      surface_shader<shader::rough_glass>{w, s},
                                      surface_shader<shader::clearcoat>{w, s},
                                      surface_shader<shader::sheen>{w, s},
                                      surface_shader<shader::marble>{w, s},
                                      surface_shader<shader::wood>{w, s},
                                      surface_shader<shader::emitter>{w, s},
                                      miss_shader{w, s}};
}

/// A wavefront path tracer on one backend: every stage runs over all paths of a wave, and the one
/// that diverges, shading, goes through the library.
template <class Backend>
class integrator {
 public:
  integrator(Backend const& backend, scene_view const& scene, render_settings const& settings)
      : backend_(backend),
        exec_(backend.policy()),
        scene_(scene),
        settings_(settings),
        scratch_(exec_),
        group_time_(backend),
        total_time_(backend) {}

  template <class Schedule>
  render_result run(Schedule const& schedule, progress_function const& progress) {
    auto const start = std::chrono::steady_clock::now();
    std::uint64_t const pixels = std::uint64_t{settings_.width} * settings_.height;
    std::uint64_t const items = pixels * settings_.samples;
    std::uint64_t const wave_size = glm::min(items, glm::clamp(pixels, small_wave, large_wave));
    wave_storage storage(backend_, wave_size);
    wave_view wave = storage.view();
    wave.seed = settings_.seed;
    wave.pixels = static_cast<std::uint32_t>(pixels);
    wave.max_depth = settings_.max_depth;
    auto sums = backend_.template make_array<glm::dvec3>(pixels);
    scratch_.reserve(wave_size, shader_count);
    if (settings_.statistics) warm_up(schedule, wave, static_cast<std::uint32_t>(wave_size));
    for (wave.first = 0; wave.first < items; wave.first += wave_size) {
      auto const paths = static_cast<std::uint32_t>(glm::min(wave_size, items - wave.first));
      trace_wave(schedule, wave, paths);
      auto const touched = static_cast<std::uint32_t>(glm::min(pixels, std::uint64_t{paths}));
      for_all(touched, accumulate_samples{wave, paths, data_of(sums)});
      result_.discarded_samples += sum_over(paths, count_discarded{wave});
      if (progress) progress(static_cast<double>(wave.first + paths) / static_cast<double>(items));
    }
    result_.pixels.reserve(pixels);
    for (glm::dvec3 const& sum : backend_.to_host(std::move(sums)))
      result_.pixels.emplace_back(sum / double(settings_.samples));
    for (bounce& b : result_.bounces) b.shade_ms = b.total_ms - b.group_ms;
    result_.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return std::move(result_);
  }

 private:
  using stopwatch = typename Backend::stopwatch;

  template <class Function>
  void for_all(std::uint32_t count, Function const& f) {
    thrust::for_each_n(exec_, thrust::counting_iterator<request_index>(0), count, f);
  }
  template <class Function>
  std::uint64_t sum_over(std::uint32_t count, Function const& f) {
    thrust::counting_iterator<request_index> const first(0);
    return thrust::transform_reduce(exec_, first, first + count, f, std::uint64_t{0},
                                    thrust::plus<std::uint64_t>());
  }
  template <class Schedule, class Table>
  void timed_shade(Schedule const& schedule, std::uint32_t paths, std::uint8_t const* ids,
                   Table const& table, stopwatch& time) {
    time.start();
    deferred_shade::shade(exec_, schedule, paths, ids, table, scratch_);
    time.stop();
  }

  /// Runs the schedule over paths that are all finished, for no time to count what a first launch
  /// takes: the start of threads, or the way of the kernels to the device.
  template <class Schedule>
  void warm_up(Schedule const& schedule, wave_view const& wave, std::uint32_t paths) {
    thrust::fill_n(exec_, wave.id, paths, finished);
    timed_shade(schedule, paths, wave.id, uniform_table(empty_shader{}), group_time_);
    timed_shade(schedule, paths, wave.id, make_shaders(wave, scene_), total_time_);
  }

  template <class Schedule>
  void trace_wave(Schedule const& schedule, wave_view wave, std::uint32_t paths) {
    for_all(paths, generate_paths{wave, scene_.view, settings_.width, settings_.height});
    ray_count rays{paths, 0};
    for (wave.bounce = 0; rays.extended > 0 && wave.bounce != wave.max_depth; ++wave.bounce) {
      for_all(paths, find_hits{wave, scene_});
      if (result_.bounces.size() == wave.bounce) result_.bounces.emplace_back();
      bounce& b = result_.bounces[wave.bounce];
      b.requests += rays.extended;
      if (settings_.statistics)
        timed_shade(schedule, paths, wave.id, uniform_table(empty_shader{}), group_time_);
      timed_shade(schedule, paths, wave.id, make_shaders(wave, scene_), total_time_);
      for_all(paths, trace_shadows{wave, scene_.bvh});
      result_.rays += rays.extended;
      rays = ray_count::unpacked(sum_over(paths, count_rays{wave}));
      result_.rays += rays.shadow;
      b.total_ms += total_time_.milliseconds();
      if (settings_.statistics) b.group_ms += group_time_.milliseconds();
      if (settings_.statistics && wave.first == 0)
        measure_efficiency(schedule, backend_.to_host(wave.id, paths), wave, b);
    }
  }

  Backend const& backend_;
  decltype(std::declval<Backend const&>().policy()) exec_;
  scene_view scene_;
  render_settings settings_;
  decltype(deferred_shade::workspace{std::declval<Backend const&>().policy()}) scratch_;
  stopwatch group_time_, total_time_;
  render_result result_;
};

/// Calls `f` with the schedule that goes by `name`; false if there is none.
template <class Function>
bool with_schedule(std::string_view name, Function const& f) {
  namespace ds = deferred_shade;
  using implicit = ds::implicit_serialization;
  using explicit_ = ds::explicit_serialization;
  auto const is = [&](std::string_view n, auto const& schedule) {
    if (name == n) f(schedule);
    return name == n;
  };
  return is("implicit", implicit{}) || is("explicit", explicit_{}) ||
         is("compact+implicit", ds::compact_then_dispatch<implicit>{}) ||
         is("compact+explicit", ds::compact_then_dispatch<explicit_>{}) ||
         is("sort+implicit", ds::sort_then_dispatch<implicit>{}) ||
         is("sort+explicit", ds::sort_then_dispatch<explicit_>{}) ||
         is("bucket+implicit", ds::bucket_then_dispatch<implicit>{}) ||
         is("bucket+explicit", ds::bucket_then_dispatch<explicit_>{}) ||
         is("local-bitonic", ds::local_sort_then_dispatch<ds::bitonic>{}) ||
         is("local", ds::local_sort_then_dispatch<>{}) ||
         is("window", ds::window_sort_then_dispatch{});
}

/// Renders a scene in the memory of `backend` by the schedule that the settings name.
template <class Backend>
render_result integrate(Backend const& backend, scene_view const& scene,
                        render_settings const& settings, progress_function const& progress) {
  render_result result;
  bool const known = with_schedule(settings.schedule, [&](auto const& schedule) {
    result = integrator<Backend>{backend, scene, settings}.run(schedule, progress);
  });
  if (!known) throw std::invalid_argument("unknown schedule \"" + settings.schedule + "\"");
  return result;
}

// One per backend, each in a file of its own.
render_result render_cpp(host_scene const&, render_settings const&, progress_function const&);
render_result render_omp(host_scene const&, render_settings const&, progress_function const&);
render_result render_tbb(host_scene const&, render_settings const&, progress_function const&);
render_result render_cuda(host_scene const&, render_settings const&, progress_function const&);

}  // namespace path_tracer
