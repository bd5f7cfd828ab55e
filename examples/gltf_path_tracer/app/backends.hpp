// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "app/render.hpp"
#include "effects/effects.hpp"
#include "scene/host_scene.hpp"

namespace path_tracer {

using progress_function = std::function<void(double)>;

// The backends, each in a file of its own, which is compiled once for every variant: side by side
// in one translation unit, they would share what the compiler grants it for inlining.
template <class Set>
render_result render_cpp(host_scene const&, render_settings const&, progress_function const&);
template <class Set>
render_result render_omp(host_scene const&, render_settings const&, progress_function const&);
template <class Set>
render_result render_tbb(host_scene const&, render_settings const&, progress_function const&);
template <class Set>
render_result render_cuda(host_scene const&, render_settings const&, progress_function const&);

namespace detail {

template <class Sets>
struct variants_in;
template <class... Sets>
struct variants_in<effect_list<Sets...>> {
  using type = effect_list<set_of<Sets>..., every_effect>;
};

}  // namespace detail

/// The sets of effects of all variants, the whole last.
using variant_sets = detail::variants_in<declared_sets>::type;
template <int Number>
using variant_set = typename detail::element_of<Number, variant_sets>::type;

static_assert(detail::count_of(variant_sets{}) == PATH_TRACER_VARIANTS,
              "CMakeLists.txt says how many variants are compiled");

}  // namespace path_tracer
