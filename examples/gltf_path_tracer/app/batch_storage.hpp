// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thrust/memory.h>

#include <cstddef>
#include <cstdint>
#include <utility>

#include "shading/path.hpp"

namespace path_tracer {

/// The first of an array of a backend.
template <class Array>
auto* data_of(Array& array) {
  return thrust::raw_pointer_cast(array.data());
}

template <class Backend, class T>
using array_of = decltype(std::declval<Backend const&>().template make_array<T>(0));

/// The array behind a path_array, where there is one.
template <class Backend, class Effect, class Set, bool Exists = path_array<Effect, Set>::exists>
struct path_array_storage {
  path_array_storage(Backend const&, std::size_t) {}
  void set(batch_view<Set>&) {}
};
template <class Backend, class Effect, class Set>
struct path_array_storage<Backend, Effect, Set, true> {
  using state = typename Effect::path_state;
  array_of<Backend, state> states;

  path_array_storage(Backend const& backend, std::size_t paths)
      : states(backend.template make_array<state>(paths)) {}
  void set(batch_view<Set>& batch) {
    static_cast<path_array<Effect, Set>&>(batch).states = data_of(states);
  }
};

template <class Backend, class Set, class Effects>
struct path_array_storages;
template <class Backend, class Set, class... Effects>
struct path_array_storages<Backend, Set, effect_list<Effects...>>
    : path_array_storage<Backend, Effects, Set>... {
  path_array_storages(Backend const& backend, std::size_t paths)
      : path_array_storage<Backend, Effects, Set>(backend, paths)... {}
  void set(batch_view<Set>& batch) { (path_array_storage<Backend, Effects, Set>::set(batch), ...); }
};

/// The arrays behind a batch_view, in the memory of a backend.
template <class Backend, class Set>
class batch_storage {
 public:
  batch_storage(Backend const& backend, std::size_t paths)
      : vectors_(backend.template make_array<vec3>(3 * paths)),
        directions_(backend.template make_array<stored_direction>(paths)),
        colors_(backend.template make_array<stored_color>(3 * paths)),
        pdf_(backend.template make_array<real>(paths)),
        primitive_(backend.template make_array<std::uint32_t>(paths)),
        barycentric_(backend.template make_array<vec2>(paths)),
        id_(backend.template make_array<std::uint8_t>(paths)),
        of_effects_(backend, paths) {}

  batch_view<Set> view() {
    std::size_t const n = id_.size();
    vec3* const v = data_of(vectors_);
    batch_view<Set> w{};
    w.origin = v;
    w.shadow_origin = v + n;
    w.shadow_vector = v + 2 * n;
    w.direction = data_of(directions_);
    stored_color* const c = data_of(colors_);
    w.throughput = c;
    w.radiance = c + n;
    w.shadow_light = c + 2 * n;
    w.pdf = data_of(pdf_);
    w.primitive = data_of(primitive_);
    w.barycentric = data_of(barycentric_);
    w.id = data_of(id_);
    of_effects_.set(w);
    return w;
  }

 private:
  array_of<Backend, vec3> vectors_;
  array_of<Backend, stored_direction> directions_;
  array_of<Backend, stored_color> colors_;
  array_of<Backend, real> pdf_;
  array_of<Backend, std::uint32_t> primitive_;
  array_of<Backend, vec2> barycentric_;
  array_of<Backend, std::uint8_t> id_;
  path_array_storages<Backend, Set, all_effects> of_effects_;
};

}  // namespace path_tracer
