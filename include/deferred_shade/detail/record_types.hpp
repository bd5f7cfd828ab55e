// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <type_traits>
#include <utility>

#include <deferred_shade/detail/device_lambda.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade::detail {

/// Stands for a request or a result if there is none because of an error.
struct no_record {};

/// The type of source(i) or source[i], or void.
template <class Source, class = void, class = void>
struct request_of {
  using type = void;
};
template <class Source, class Called>
struct request_of<Source, std::void_t<std::invoke_result_t<Source const&, request_index>>, Called> {
  using type = std::decay_t<std::invoke_result_t<Source const&, request_index>>;
};
template <class Source>
struct request_of<Source, std::enable_if_t<!std::is_invocable_v<Source const&, request_index>>,
                  std::void_t<decltype(std::declval<Source const&>()[request_index{}])>> {
  using type = std::decay_t<decltype(std::declval<Source const&>()[request_index{}])>;
};

/// The type that the function of a record shader returns, or void.
template <class Function, class Request, class = void>
struct result_of {
  using type = void;
};
template <class Function, class Request>
struct result_of<Function, Request,
                 std::void_t<std::invoke_result_t<Function const&, Request const&>>> {
  using type = std::decay_t<std::invoke_result_t<Function const&, Request const&>>;
};

/// Whether sink(i, result) or sink[i] = result can be written.
template <class Sink, class Result, class = void>
inline constexpr bool stores = std::is_invocable_v<Sink const&, request_index, Result const&>;
template <class Sink, class Result>
inline constexpr bool stores<Sink, Result,
                             std::void_t<decltype(std::declval<Sink const&>()[request_index{}] =
                                                      std::declval<Result const&>())>> = true;

/// The request and the result of a record shader, and what the library asks of its three parts. If
/// that is not met, nothing else of the shader is compiled: the first error is the only one.
template <class Source, class Function, class Sink>
struct record_types {
 private:
  static constexpr bool on_host =
      !is_device_lambda<Source> && !is_device_lambda<Function> && !is_device_lambda<Sink>;

  using loaded = typename request_of<Source>::type;
  static constexpr bool loads = !std::is_void_v<loaded>;

  using given = std::conditional_t<loads, loaded, no_record>;
  static constexpr bool calls = std::is_invocable_v<Function const&, given const&>;

  using returned = typename result_of<Function, given>::type;
  static constexpr bool returns = !std::is_void_v<returned>;

  static constexpr bool written = stores<Sink, std::conditional_t<returns, returned, no_record>>;

 public:
  static constexpr bool met = on_host && loads && calls && returns && written;
  using request = std::conditional_t<met, loaded, no_record>;
  using result = std::conditional_t<met, returned, no_record>;

  static_assert(on_host,
                "deferred_shade: lambdas of record shaders must be __host__ __device__, not "
                "__device__ alone; write [=] __host__ __device__ (...)");
  static_assert(!on_host || loads,
                "deferred_shade: the source of record shaders must be readable as source[i] or "
                "source(i) for a request_index; pass a pointer, an iterator or a const function "
                "that returns the request");
  static_assert(!on_host || !loads || calls,
                "deferred_shade: the function of a record shader must be callable with what the "
                "source gives, by an operator() that is const; give it a parameter Request const&");
  static_assert(!on_host || !loads || !calls || returns,
                "deferred_shade: the function of a record shader must return its result; put a "
                "shader that stores by itself into a shader_table");
  static_assert(
      !on_host || !loads || !calls || !returns || written,
      "deferred_shade: the sink of record shaders must be writable as sink[i] = result or "
      "sink(i, result) with what the function returns; pass a pointer that is not to "
      "const, an iterator or a const function, and no container");
};

}  // namespace deferred_shade::detail
