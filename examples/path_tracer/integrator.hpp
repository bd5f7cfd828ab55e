// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thrust/count.h>
#include <thrust/for_each.h>
#include <thrust/functional.h>
#include <thrust/iterator/counting_iterator.h>
#include <thrust/transform_reduce.h>

#include <chrono>
#include <deferred_shade/deferred_shade.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "render.hpp"
#include "shaders.hpp"
#include "stages.hpp"
#include "statistics.hpp"

namespace path_tracer {

using progress_function = std::function<void(double)>;

/// A wave holds one sample of each pixel where that makes no more than 2^20 paths, else so many.
inline constexpr std::uint64_t small_wave = std::uint64_t{1} << 18;
inline constexpr std::uint64_t large_wave = std::uint64_t{1} << 20;

/// The arrays behind a wave_view.
class wave_storage {
 public:
  explicit wave_storage(std::size_t paths)
      : vectors_(7 * paths), pdf_(paths), primitive_(paths), barycentric_(paths), id_(paths) {}

  wave_view view() {
    std::size_t const n = id_.size();
    vec3* const v = vectors_.data();
    wave_view w{};
    w.origin = v;
    w.direction = v + n;
    w.throughput = v + 2 * n;
    w.radiance = v + 3 * n;
    w.shadow_origin = v + 4 * n;
    w.shadow_vector = v + 5 * n;
    w.shadow_light = v + 6 * n;
    w.pdf = pdf_.data();
    w.primitive = primitive_.data();
    w.barycentric = barycentric_.data();
    w.id = id_.data();
    return w;
  }

 private:
  std::vector<vec3> vectors_;
  std::vector<float> pdf_;
  std::vector<std::uint32_t> primitive_;
  std::vector<vec2> barycentric_;
  std::vector<std::uint8_t> id_;
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

/// A wavefront path tracer on one Thrust backend: every stage runs over all paths of a wave, and
/// the one that diverges, shading, goes through the library.
template <class Policy>
class integrator {
 public:
  integrator(Policy exec, scene_view const& scene, render_settings const& settings)
      : exec_(exec), scene_(scene), settings_(settings), scratch_(exec) {}

  template <class Schedule>
  render_result run(Schedule const& schedule, progress_function const& progress) {
    auto const start = clock::now();
    std::uint64_t const pixels = std::uint64_t{settings_.width} * settings_.height;
    std::uint64_t const items = pixels * settings_.samples;
    std::uint64_t const wave_size = glm::min(items, glm::clamp(pixels, small_wave, large_wave));
    wave_storage storage(wave_size);
    wave_view wave = storage.view();
    wave.seed = settings_.seed;
    wave.pixels = static_cast<std::uint32_t>(pixels);
    wave.max_depth = settings_.max_depth;
    std::vector<glm::dvec3> sums(pixels, glm::dvec3{0});
    scratch_.reserve(wave_size, shader_count);
    for (wave.first = 0; wave.first < items; wave.first += wave_size) {
      auto const paths = static_cast<std::uint32_t>(glm::min(wave_size, items - wave.first));
      trace_wave(schedule, wave, paths);
      auto const touched = static_cast<std::uint32_t>(glm::min(pixels, std::uint64_t{paths}));
      result_.discarded_samples += sum_over(touched, accumulate_samples{wave, paths, sums.data()});
      if (progress) progress(static_cast<double>(wave.first + paths) / static_cast<double>(items));
    }
    result_.pixels.reserve(pixels);
    for (glm::dvec3 const& sum : sums) result_.pixels.emplace_back(sum / double(settings_.samples));
    for (bounce& b : result_.bounces) b.shade_ms = b.total_ms - b.group_ms;
    result_.seconds = std::chrono::duration<double>(clock::now() - start).count();
    return std::move(result_);
  }

 private:
  using clock = std::chrono::steady_clock;

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
  double timed_shade(Schedule const& schedule, std::uint32_t paths, std::uint8_t const* ids,
                     Table const& table) {
    auto const start = clock::now();
    deferred_shade::shade(exec_, schedule, paths, ids, table, scratch_);
    return std::chrono::duration<double, std::milli>(clock::now() - start).count();
  }

  template <class Schedule>
  void trace_wave(Schedule const& schedule, wave_view wave, std::uint32_t paths) {
    for_all(paths, generate_paths{wave, scene_.view, settings_.width, settings_.height});
    for (wave.bounce = 0; wave.bounce < wave.max_depth; ++wave.bounce) {
      for_all(paths, find_hits{wave, scene_});
      std::uint64_t const requests = paths - static_cast<std::uint64_t>(thrust::count(
                                                 exec_, wave.id, wave.id + paths, finished));
      if (requests == 0) return;
      if (result_.bounces.size() == wave.bounce) result_.bounces.emplace_back();
      bounce& b = result_.bounces[wave.bounce];
      b.requests += requests;
      if (settings_.statistics) {
        b.group_ms += timed_shade(schedule, paths, wave.id, uniform_table(empty_shader{}));
        if (wave.first == 0) measure_efficiency(schedule, paths, wave, b);
      }
      b.total_ms += timed_shade(schedule, paths, wave.id, make_shaders(wave, scene_));
      result_.rays += requests + sum_over(paths, trace_shadows{wave, scene_.bvh});
    }
  }

  Policy exec_;
  scene_view scene_;
  render_settings settings_;
  decltype(deferred_shade::workspace{std::declval<Policy>()}) scratch_;
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
         is("local", ds::local_sort_then_dispatch<>{});
}

/// Renders on `exec` by the schedule that the settings name.
template <class Policy>
render_result integrate(Policy const& exec, scene_view const& scene,
                        render_settings const& settings, progress_function const& progress) {
  render_result result;
  bool const known = with_schedule(settings.schedule, [&](auto const& schedule) {
    result = integrator<Policy>{exec, scene, settings}.run(schedule, progress);
  });
  if (!known) throw std::invalid_argument("unknown schedule \"" + settings.schedule + "\"");
  return result;
}

// One per backend, each in a file of its own.
render_result render_cpp(scene_view const&, render_settings const&, progress_function const&);
render_result render_omp(scene_view const&, render_settings const&, progress_function const&);
render_result render_tbb(scene_view const&, render_settings const&, progress_function const&);

}  // namespace path_tracer
