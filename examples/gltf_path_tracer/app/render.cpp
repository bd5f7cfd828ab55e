// SPDX-License-Identifier: Apache-2.0
#include "app/render.hpp"

#include <algorithm>
#include <deferred_shade/schedule.hpp>
#include <stdexcept>

#include "app/backends.hpp"
#include "effects/scene_effects.hpp"

namespace path_tracer {
namespace {

using render_function = render_result (*)(host_scene const&, render_settings const&,
                                          progress_function const&);

struct backend {
  std::string_view name;
  render_function render[PATH_TRACER_VARIANTS];
};

template <class... Sets>
std::vector<backend> backends_of(effect_list<Sets...>) {
  return {
#ifdef PATH_TRACER_HAS_CPP
      {"cpp", {render_cpp<Sets>...}},
#endif
#ifdef PATH_TRACER_HAS_OMP
      {"omp", {render_omp<Sets>...}},
#endif
#ifdef PATH_TRACER_HAS_TBB
      {"tbb", {render_tbb<Sets>...}},
#endif
#ifdef PATH_TRACER_HAS_CUDA
      {"cuda", {render_cuda<Sets>...}},
#endif
  };
}

std::vector<backend> const& all_backends() {
  static std::vector<backend> const list = backends_of(variant_sets{});
  return list;
}

void check(scene const& s, render_settings const& settings) {
  std::uint64_t const pixels = std::uint64_t{settings.width} * settings.height;
  if (pixels == 0 || pixels > 0x7fffffffu)
    throw std::invalid_argument("a picture has 1 to 2^31 - 1 pixels");
  if (settings.samples == 0) throw std::invalid_argument("a pixel has at least one sample");
  for (triangle const& t : s.triangles)
    if (t.material >= s.materials.size())
      throw std::invalid_argument("a triangle names a material that the scene does not have");
  if (s.sky.texels.size() != std::size_t{s.sky.width} * s.sky.height)
    throw std::invalid_argument("the environment has not as many texels as its size says");
  if (std::string const fault = fault_of(s.sky, s.environment_intensity); !fault.empty())
    throw std::invalid_argument("the environment is not usable: " + fault);
  effect_bits const called = called_for(s);
  if (effect_bits const missing = called & ~effects_of_variant(settings.variant); missing.any())
    throw std::invalid_argument("the variant has no code for " + join_names(missing) +
                                ", which the scene calls for");
  if ((shaders_of(called) & ~settings.expected).any())
    throw std::invalid_argument("a shader is not expected that the scene calls for");
}

}  // namespace

std::vector<std::string_view> backends() {
  std::vector<std::string_view> names;
  for (backend const& b : all_backends()) names.push_back(b.name);
  return names;
}

std::vector<std::string_view> schedules() {
  std::vector<std::string_view> names;
  deferred_shade::for_each_schedule([&](char const* name, auto const&) { names.push_back(name); });
  return names;
}

void specialize(render_settings& settings, scene const& s) {
  effect_bits const called = called_for(s);
  settings.variant = variant_for(called);
  settings.expected = shaders_of(called);
}

std::uint64_t batch_size_of(render_settings const& settings) {
  constexpr std::uint64_t small = std::uint64_t{1} << 18, large = std::uint64_t{1} << 20;
  std::uint64_t const pixels = std::uint64_t{settings.width} * settings.height;
  return std::min(pixels * settings.samples, std::clamp(pixels, small, large));
}

render_result render(scene const& s, render_settings const& settings,
                     std::function<void(double)> const& progress) {
  auto const& list = all_backends();
  auto const chosen = std::find_if(list.begin(), list.end(),
                                   [&](backend const& b) { return b.name == settings.backend; });
  if (chosen == list.end())
    throw std::invalid_argument("unknown backend \"" + settings.backend + "\"");
  check(s, settings);
  std::size_t const variant = std::min<std::size_t>(settings.variant, PATH_TRACER_VARIANTS - 1);
  return chosen->render[variant](host_scene(s, settings.accuracy), settings, progress);
}

}  // namespace path_tracer
