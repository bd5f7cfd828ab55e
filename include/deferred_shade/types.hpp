// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <type_traits>

#include <deferred_shade/config.hpp>
#include <deferred_shade/detail/ids.hpp>

namespace deferred_shade {

/// The position of a request in its batch, 0 to n - 1. A shader is called with it.
using request_index = std::uint32_t;

/// The position of a shader in its table. An id at or above the size of the table names no shader.
using shader_id = std::uint32_t;

/// The most requests that one batch can hold.
inline constexpr std::size_t max_requests = (std::numeric_limits<request_index>::max)();

/// A number of requests in memory where `shade` runs. It is read when the batch runs, not when it
/// is submitted. The renderer guarantees that it is at most `maximum`, by which the workspace is
/// sized. On CUDA the host cannot see the number: a negative one counts as 0, and one above
/// `maximum` as `maximum`.
template <class Integer>
struct device_count {
  static_assert(std::is_integral_v<Integer> && !std::is_same_v<std::remove_cv_t<Integer>, bool>,
                "deferred_shade: device_count must point at an integer that is not bool");
  Integer const* pointer;
  std::size_t maximum;
};

template <class Integer>
device_count(Integer*, std::size_t) -> device_count<std::remove_const_t<Integer>>;

/// The requests of a batch, grouped by shader: a view of memory that a workspace owns.
///
/// Both arrays lie where the execution policy runs. With cpp, omp and tbb, the host may read them.
/// With CUDA, they can be read when the work on the stream is done. `permutation[offsets[k]]` to
/// `permutation[offsets[k + 1] - 1]` are the requests of shader k in the order of the batch;
/// `offsets` holds one entry more than the table has shaders. The entries of `permutation` from
/// `offsets[shaders]` on are unspecified. `maximum` is an upper bound of the number of requests,
/// for the host.
struct grouping {
  request_index const* permutation;
  request_index const* offsets;
  std::size_t maximum = max_requests;
};

/// An order of requests: at place p stands request `permutation[p]`, for p from 0 to n - 1. Both
/// lie where the execution policy runs.
struct request_order {
  request_index const* permutation;
  device_count<request_index> n;
};

/// All requests of a batch, grouped by shader, as `group` returns them: a view of memory that a
/// workspace owns. Dispatches take it, because it is a grouping. A last segment follows those of
/// the shaders, from `offsets[shaders]` to `offsets[shaders + 1] - 1`: the requests that name no
/// shader. Every segment keeps the order of the batch. `offsets[shaders + 1]` is the number of all
/// requests.
struct request_groups : grouping {
  shader_id shaders;

  /// All requests: those that name no shader come last.
  request_order all() const { return {permutation, {offsets + shaders + 1, maximum}}; }
  /// The requests that name a shader. `live().n` is their number, for the next batch.
  request_order live() const { return {permutation, {offsets + shaders, maximum}}; }
};

/// An array of a batch, and the array that its elements go to.
template <class T>
struct moved {
  T const* from;
  T* to;
};

template <class From, class To>
moved(From*, To*) -> moved<To>;

/// A part of what a schedule does, as an observer is told of it: see `observed`. A renderer's own
/// schedule may have phases by other names.
struct phase {
  char const* name;                       ///< "run", "group", "dispatch" or, within it, "shader"
  std::optional<shader_id> shader{};      ///< its id, if the name is "shader"
  std::optional<std::size_t> requests{};  ///< their number, if the host knows it
};

/// The shader that `ids` names for request `i`, or `shaders` if it names none.
///
/// `Ids` is a random-access iterator over an integer or an enumeration of 8 to 32 bits. A negative
/// id names no shader.
DEFERRED_SHADE_EXEC_CHECK_DISABLE
template <class Ids>
DEFERRED_SHADE_HOST_DEVICE inline shader_id shader_of(Ids const& ids, request_index i,
                                                      shader_id shaders) {
  if constexpr (detail::requirements_of_ids<Ids>::met) {
    using traits = std::iterator_traits<Ids>;
    typename traits::value_type const value = ids[static_cast<typename traits::difference_type>(i)];
    auto const id = static_cast<shader_id>(value);
    return id < shaders ? id : shaders;
  } else {
    return shaders;
  }
}

/// Whether objects of type T are copied by copying their bytes. Specialise it for a type with a
/// copy constructor of its own that does no more: the vector types of many renderers have one. Then
/// records with such members pass through shared memory and vectors, and `gather` takes them.
///
///     template <> inline constexpr bool deferred_shade::is_copied_by_bytes<my::hit> = true;
template <class T>
inline constexpr bool is_copied_by_bytes = std::is_trivially_copyable_v<T>;

namespace detail {

using deferred_shade::shader_of;  // for calls that find no function of a renderer's

/// The upper bound of the number of requests that the host knows.
inline std::size_t maximum_of(request_index n) { return n; }
template <class Integer>
std::size_t maximum_of(device_count<Integer> n) {
  return n.maximum;
}

/// The narrowest key that holds the ids 0 to `Shaders`, the last one for requests that name none.
template <shader_id Shaders>
using sort_key =
    std::conditional_t<(Shaders <= 0xff), std::uint8_t,
                       std::conditional_t<(Shaders <= 0xffff), std::uint16_t, std::uint32_t>>;

}  // namespace detail
}  // namespace deferred_shade
