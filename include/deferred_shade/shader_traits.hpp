// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <type_traits>

namespace deferred_shade {
namespace detail {

// Only a static constant or an enumerator of these names counts. A data member is the shader's own
// business.
template <class Shader, class = void>
inline constexpr bool block_size_is_member = false;
template <class Shader>
inline constexpr bool block_size_is_member<Shader, std::void_t<decltype(&Shader::block_size)>> =
    std::is_member_pointer_v<decltype(&Shader::block_size)>;
template <class Shader, class = void>
inline constexpr bool declares_block_size = false;
template <class Shader>
inline constexpr bool declares_block_size<Shader, std::void_t<decltype(Shader::block_size)>> =
    !block_size_is_member<Shader> && std::is_convertible_v<decltype(Shader::block_size), int>;

template <class Shader, class = void>
inline constexpr bool runs_in_vectors_is_member = false;
template <class Shader>
inline constexpr bool
    runs_in_vectors_is_member<Shader, std::void_t<decltype(&Shader::runs_in_vectors)>> =
        std::is_member_pointer_v<decltype(&Shader::runs_in_vectors)>;
template <class Shader, class = void>
inline constexpr bool declares_runs_in_vectors = false;
template <class Shader>
inline constexpr bool
    declares_runs_in_vectors<Shader, std::void_t<decltype(Shader::runs_in_vectors)>> =
        !runs_in_vectors_is_member<Shader> &&
        std::is_convertible_v<decltype(Shader::runs_in_vectors), bool>;

template <class Shader>
constexpr int block_size_of() {
  if constexpr (declares_block_size<Shader>) {
    return Shader::block_size;
  } else {
    return 0;
  }
}
template <class Shader>
constexpr bool runs_in_vectors_of() {
  if constexpr (declares_runs_in_vectors<Shader>) {
    return Shader::runs_in_vectors;
  } else {
    return true;
  }
}

}  // namespace detail

/// What a shader declares by static constants, and the defaults if it declares nothing.
///
///     struct marble { static constexpr int block_size = 128; /* ... */ };
template <class Shader>
struct declared_shader_traits {
  /// CUDA: the threads of a block in a launch of this shader alone. 0, the default: the number up
  /// to 256 that maximises occupancy.
  static constexpr int block_size = detail::block_size_of<Shader>();
  /// CPU: whether the records of this function are packed, and run in a loop that the compiler can
  /// vectorise (docs/records.md, "Vectors on a CPU"). The default is true.
  static constexpr bool runs_in_vectors = detail::runs_in_vectors_of<Shader>();
};

/// What schedules ask about a shader, or about the function of a record shader. Specialise it for a
/// type that cannot have these members, a lambda for example. Derive from declared_shader_traits to
/// keep the other defaults:
///
///     inline auto marble = [](hit const& h) { /* ... */ };
///     template <>
///     struct deferred_shade::shader_traits<decltype(marble)>
///         : deferred_shade::declared_shader_traits<decltype(marble)> {
///       static constexpr int block_size = 128;
///     };
template <class Shader>
struct shader_traits : declared_shader_traits<Shader> {};

}  // namespace deferred_shade
