// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <type_traits>

#include <deferred_shade/detail/cuda/architectures.hpp>
#include <deferred_shade/detail/cuda/tuning.hpp>
#include <deferred_shade/record_shaders.hpp>
#include <deferred_shade/shader_table.hpp>

namespace deferred_shade::detail {
inline namespace DEFERRED_SHADE_ARCHITECTURES {

/// Whether T is the type of an extended lambda. nvcc replaces it by another type for its host
/// compiler, with other traits: the choice of a kernel must not depend on them.
#ifdef __CUDACC_EXTENDED_LAMBDA__
template <class T>
inline constexpr bool is_extended_lambda = __nv_is_extended_device_lambda_closure_type(T) ||
                                           __nv_is_extended_host_device_lambda_closure_type(T);
#else
template <class T>
inline constexpr bool is_extended_lambda = false;
#endif

/// The common types of the record shaders of a table whose requests can pass through shared memory.
/// They have one type each of source, sink and result, all trivially copyable, and small records.
template <class... Shaders>
struct common_records {
  static constexpr bool possible = false;
};

template <class Source, class Sink, class... Functions>
struct common_records<record_shader<Source, Functions, Sink>...> {
  using source_type = Source;
  using sink_type = Sink;
  template <class Function>
  using shader = record_shader<Source, Function, Sink>;
  using first_shader = shader<std::tuple_element_t<0, std::tuple<Functions...>>>;
  using request = typename first_shader::request_type;
  using result = typename first_shader::result_type;

  /// The bytes of shared memory for a request and, in the same place, its result.
  static constexpr std::size_t slot = ((std::max)(sizeof(request), sizeof(result)) + 15) / 16 * 16;

  static constexpr bool possible =
      !is_extended_lambda<Source> && !is_extended_lambda<Sink> &&
      sizeof(Source) + sizeof(Sink) <= 256 && std::is_copy_assignable_v<request> &&
      std::is_copy_assignable_v<result> &&
      (std::is_same_v<result, typename shader<Functions>::result_type> && ...) &&
      is_copied_by_bytes<request> && is_copied_by_bytes<result> &&
      std::is_trivially_copyable_v<Source> && std::is_trivially_copyable_v<Sink> &&
      alignof(request) <= 16 && alignof(result) <= 16 && slot <= largest_staged_record;

  /// Whether requests lie in memory as in the slots. Then 16 bytes are copied at a time.
  static constexpr bool copies_words =
      std::is_pointer_v<Source> && sizeof(request) == slot && alignof(request) == 16;
};

/// The same for small tables only. In a large one, a tile that fits in shared memory has too few
/// requests of each shader to fill its rows.
template <bool Small, class... Shaders>
struct staging_if_small {
  static constexpr bool possible = false;
};
template <class... Shaders>
struct staging_if_small<true, Shaders...> : common_records<Shaders...> {};
template <class... Shaders>
using staging = staging_if_small<sizeof...(Shaders) <= most_staged_shaders, Shaders...>;

}  // namespace DEFERRED_SHADE_ARCHITECTURES
}  // namespace deferred_shade::detail
