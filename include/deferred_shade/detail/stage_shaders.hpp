// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <type_traits>

#include <deferred_shade/config.hpp>
#include <deferred_shade/detail/device_lambda.hpp>
#include <deferred_shade/detail/ids.hpp>
#include <deferred_shade/detail/shared_shader.hpp>
#include <deferred_shade/record_shaders.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/shader_traits.hpp>
#include <deferred_shade/types.hpp>

// Stages are shaders that return the id of the stage that their request needs next. Schedules run
// them as shaders that store it.

namespace deferred_shade::detail {

/// What a stage returns, or void.
template <class Stage, class = void>
struct returned_by {
  using type = void;
};
template <class Stage>
struct returned_by<Stage, std::void_t<std::invoke_result_t<Stage const&, request_index>>> {
  using type = std::decay_t<std::invoke_result_t<Stage const&, request_index>>;
};
template <class Function>
struct returned_by<shared_shader<Function>,
                   std::void_t<std::invoke_result_t<Function const&, shader_id, request_index>>> {
  using type = std::decay_t<std::invoke_result_t<Function const&, shader_id, request_index>>;
};
template <class Source, class Function, class Sink>
struct returned_by<record_shader<Source, Function, Sink>,
                   std::void_t<std::invoke_result_t<
                       Sink const&, request_index,
                       typename record_shader<Source, Function, Sink>::result_type const&>>> {
  using type = std::decay_t<
      std::invoke_result_t<Sink const&, request_index,
                           typename record_shader<Source, Function, Sink>::result_type const&>>;
};

/// Whether a value of this type names a stage.
template <class T>
constexpr bool names_stage() {
  if constexpr (std::is_void_v<T>) {
    return false;
  } else {
    return is_id<T> && !std::is_same_v<T, bool>;
  }
}

/// Whether a stage says which one is next. nvcc does not tell what a lambda for the device alone
/// returns.
template <class Stage>
inline constexpr bool is_stage = is_device_lambda<Stage> || std::is_same_v<Stage, no_shader> ||
                                 names_stage<typename returned_by<Stage>::type>();

/// Runs a stage on a slot, and returns the id that it returns.
DEFERRED_SHADE_EXEC_CHECK_DISABLE
template <class Stage>
DEFERRED_SHADE_HOST_DEVICE shader_id run_stage(Stage const& stage, request_index slot) {
  if constexpr (is_record_shader<Stage>) {
    typename Stage::request_type const request = detail::load(stage.source, slot);
    return static_cast<shader_id>(stage.sink(slot, stage.function(request)));
  } else if constexpr (is_shared<Stage>) {
    return static_cast<shader_id>(stage.result(slot));
  } else {
    return static_cast<shader_id>(stage(slot));
  }
}

/// The slots from `first` on, and the keys of the stages that they need next: `none` for a slot
/// whose request has ended.
template <class Key>
struct next_stages {
  Key* next;
  request_index first;
  shader_id none;

  DEFERRED_SHADE_HOST_DEVICE void set(request_index i, shader_id id) const {
    next[i] = static_cast<Key>(id < none ? id : none);
  }
};

/// A stage as a shader, which stores what the stage returns.
template <class Stage, class Key>
struct stage_shader {
  Stage stage;
  next_stages<Key> to;

  DEFERRED_SHADE_EXEC_CHECK_DISABLE
  DEFERRED_SHADE_HOST_DEVICE void operator()(request_index i) const {
    to.set(i, detail::run_stage(stage, to.first + i));
  }
};

/// The source of a record shader, from slot `first` on.
template <class Source>
struct source_from {
  Source source;
  request_index first;
  DEFERRED_SHADE_EXEC_CHECK_DISABLE
  DEFERRED_SHADE_HOST_DEVICE decltype(auto) operator()(request_index i) const {
    return detail::load(source, first + i);
  }
};

/// The sink of a record shader, from slot `first` on, which stores what that sink returns.
template <class Sink, class Key>
struct stage_sink {
  Sink sink;
  next_stages<Key> to;
  DEFERRED_SHADE_EXEC_CHECK_DISABLE
  template <class Result>
  DEFERRED_SHADE_HOST_DEVICE void operator()(request_index i, Result const& result) const {
    to.set(i, static_cast<shader_id>(sink(to.first + i, result)));
  }
};

template <class Source>
auto shifted(Source const& source, request_index first) {
  if constexpr (std::is_pointer_v<Source>) {
    return source + first;
  } else {
    return source_from<Source>{source, first};
  }
}

template <class Stage, class Key>
auto as_shader(Stage const& stage, next_stages<Key> const& to) {
  return stage_shader<Stage, Key>{stage, to};
}
template <class Source, class Function, class Sink, class Key>
auto as_shader(record_shader<Source, Function, Sink> const& stage, next_stages<Key> const& to) {
  auto const source = detail::shifted(stage.source, to.first);
  return record_shader<std::decay_t<decltype(source)>, Function, stage_sink<Sink, Key>>{
      source, stage.function, {stage.sink, to}};
}
template <class Key>
no_shader as_shader(no_shader, next_stages<Key> const&) {
  return {};
}

/// The stages as shaders, on requests from 0 on.
template <class... Stages, class Key, shader_id... Ids>
auto stage_shaders(shader_table<Stages...> const& stages, next_stages<Key> const& to,
                   std::integer_sequence<shader_id, Ids...>) {
  return shader_table{detail::as_shader(stages.template get<Ids>(), to)...}.expecting(
      stages.expected());
}
template <class... Stages, class Key>
auto stage_shaders(shader_table<Stages...> const& stages, next_stages<Key> const& to) {
  return detail::stage_shaders(stages, to,
                               std::make_integer_sequence<shader_id, sizeof...(Stages)>());
}

}  // namespace deferred_shade::detail

namespace deferred_shade {

/// A stage has the same traits as a shader.
template <class Stage, class Key>
struct shader_traits<detail::stage_shader<Stage, Key>> : shader_traits<Stage> {};

}  // namespace deferred_shade
