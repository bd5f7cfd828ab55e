// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include <deferred_shade/config.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade::detail {

template <class Function>
class shared_shader;
template <class Function, shader_id... Ids>
constexpr auto shared_among(Function const& function, std::integer_sequence<shader_id, Ids...>);

/// A shader of shared_shaders, which makes all that there are: those of one table hold the same
/// function.
template <class Function>
class shared_shader {
 public:
  DEFERRED_SHADE_EXEC_CHECK_DISABLE
  DEFERRED_SHADE_HOST_DEVICE void operator()(request_index i) const {
    static_cast<void>(function_(id_, i));
  }

  /// The same, and returns what the function returns.
  DEFERRED_SHADE_EXEC_CHECK_DISABLE
  DEFERRED_SHADE_HOST_DEVICE decltype(auto) result(request_index i) const {
    return function_(id_, i);
  }

  /// The one with that id, which need not be looked for.
  DEFERRED_SHADE_HOST_DEVICE shared_shader with_id(shader_id id) const {
    return shared_shader(function_, id);
  }

 private:
  template <class F, shader_id... Ids>
  friend constexpr auto shared_among(F const&, std::integer_sequence<shader_id, Ids...>);

  DEFERRED_SHADE_HOST_DEVICE constexpr shared_shader(Function const& function, shader_id id)
      : function_(function), id_(id) {}

  Function function_;
  shader_id id_;
};
template <class T>
inline constexpr bool is_shared = false;
template <class Function>
inline constexpr bool is_shared<shared_shader<Function>> = true;

}  // namespace deferred_shade::detail
