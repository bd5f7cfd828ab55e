// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <type_traits>
#include <utility>

#include <deferred_shade/config.hpp>
#include <deferred_shade/detail/record_types.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/shader_traits.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade {
namespace detail {

DEFERRED_SHADE_EXEC_CHECK_DISABLE
template <class Source>
DEFERRED_SHADE_HOST_DEVICE decltype(auto) load(Source const& source, request_index i) {
  if constexpr (std::is_invocable_v<Source const&, request_index>) {
    return source(i);
  } else {
    return source[i];
  }
}

DEFERRED_SHADE_EXEC_CHECK_DISABLE
template <class Sink, class Result>
DEFERRED_SHADE_HOST_DEVICE void store(Sink const& sink, request_index i, Result const& result) {
  if constexpr (std::is_invocable_v<Sink const&, request_index, Result const&>) {
    static_cast<void>(sink(i, result));
  } else {
    static_cast<void>(sink[i] = result);
  }
}

}  // namespace detail

/// A pure function from a request to its result, `Result operator()(Request const&) const`, with a
/// source of requests and a sink for results.
///
/// It works wherever an index shader works. Because its loads and stores are separate from its
/// arithmetic, a schedule can load several requests, run them side by side and store their results.
/// The source is called as `source(i)` or read as `source[i]`. The sink is called as
/// `sink(i, result)` or written as `sink[i] = result`. Both may be pointers.
template <class Source, class Function, class Sink>
struct record_shader {
  Source source;
  Function function;
  Sink sink;

  /// The type of a request, without reference or const.
  using request_type = typename detail::record_types<Source, Function, Sink>::request;
  /// The type of a result, without reference or const.
  using result_type = typename detail::record_types<Source, Function, Sink>::result;

  DEFERRED_SHADE_EXEC_CHECK_DISABLE
  DEFERRED_SHADE_HOST_DEVICE void operator()([[maybe_unused]] request_index i) const {
    if constexpr (detail::record_types<Source, Function, Sink>::met) {
      request_type const request = detail::load(source, i);
      detail::store(sink, i, function(request));
    }
  }
};

/// Makes a table of record shaders that share one source and one sink. Both are copied with every
/// shader: pass pointers, iterators or functions, not containers.
///
///     struct matte { rgb operator()(hit const& h) const; };
///     auto shaders = deferred_shade::record_shaders(hits.data(), radiance.data(),
///                                                   matte{}, glass{});
template <class Source, class Sink, class... Functions>
auto record_shaders(Source source, Sink sink, Functions... functions) {
  return shader_table{
      record_shader<Source, Functions, Sink>{source, std::move(functions), sink}...};
}

/// A record shader has the traits of its function.
template <class Source, class Function, class Sink>
struct shader_traits<record_shader<Source, Function, Sink>> : shader_traits<Function> {};

/// Whether `Shader` is a record_shader.
template <class Shader>
inline constexpr bool is_record_shader = false;
template <class Source, class Function, class Sink>
inline constexpr bool is_record_shader<record_shader<Source, Function, Sink>> = true;

}  // namespace deferred_shade
