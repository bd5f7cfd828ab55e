// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

#include <deferred_shade/config.hpp>
#include <deferred_shade/detail/bits.hpp>
#include <deferred_shade/detail/device_lambda.hpp>
#include <deferred_shade/detail/shared_shader.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade {

/// Takes the place of a shader that shader_table::only has left out. No code is generated for it.
struct no_shader {
  DEFERRED_SHADE_HOST_DEVICE void operator()(request_index) const {}
};

namespace detail {

// A table has one base class per shader, and finds a shader by conversion to its base. Unlike in a
// tuple, no fold or recursion over the pack limits the size or slows the compiler.
template <shader_id Id, class Shader>
struct table_slot {
  static_assert(is_device_lambda<Shader> || std::is_invocable_v<Shader const&, request_index>,
                "deferred_shade: a shader must be callable as shader(request_index), by an "
                "operator() that is const; pass functions of records to record_shaders");
  Shader shader;
};

template <class Ids, class... Shaders>
struct table_slots;
template <shader_id... Ids, class... Shaders>
struct table_slots<std::integer_sequence<shader_id, Ids...>, Shaders...>
    : table_slot<Ids, Shaders>... {
  constexpr explicit table_slots(Shaders... shaders)
      : table_slot<Ids, Shaders>{std::move(shaders)}... {}
};

template <class... Shaders>
using table_of = table_slots<std::make_integer_sequence<shader_id, sizeof...(Shaders)>, Shaders...>;

template <shader_id Id, class Shader>
DEFERRED_SHADE_HOST_DEVICE constexpr Shader const& shader_in(
    table_slot<Id, Shader> const& slot) noexcept {
  return slot.shader;
}

/// The position of the first type of a list that is `A`.
template <class A, class... T>
constexpr std::size_t position_of() {
  bool const same[] = {std::is_same_v<A, T>...};
  std::size_t position = 0;
  while (!same[position]) ++position;
  return position;
}

/// Which types of a list are equal.
template <class... T>
struct equal_types {
  /// For the first of equal types, their number; for the others, 0.
  std::size_t count[sizeof...(T)] = {};

  constexpr equal_types() {
    std::size_t const first[] = {detail::position_of<T, T...>()...};
    for (std::size_t const position : first) ++count[position];
  }
};

/// The shaders of a table: the part of it that kernels are given.
template <class... Shaders>
class shader_list {
 public:
  constexpr explicit shader_list(Shaders... shaders) : shaders_(std::move(shaders)...) {}

  /// The number of shaders.
  static constexpr shader_id size() noexcept { return static_cast<shader_id>(sizeof...(Shaders)); }

  /// Whether there is a shader at position `Id`: false if `only` has left it out.
  template <shader_id Id>
  static constexpr bool has =
      !std::is_same_v<std::decay_t<decltype(shader_in<Id>(std::declval<table_of<Shaders...>>()))>,
                      no_shader>;

  /// The lowest id that the table has a shader for.
  DEFERRED_SHADE_HOST_DEVICE static constexpr shader_id first_id() noexcept {
    constexpr bool present[] = {!std::is_same_v<Shaders, no_shader>...};
    shader_id id = 0;
    while (!present[id]) ++id;
    return id;
  }

  /// The shader at position `Id`.
  template <shader_id Id>
  DEFERRED_SHADE_HOST_DEVICE constexpr auto const& get() const noexcept {
    return detail::shader_in<Id>(shaders_);
  }

  /// Runs shader `id` on request `i`. Does nothing if the table has no such shader.
  DEFERRED_SHADE_EXEC_CHECK_DISABLE
  DEFERRED_SHADE_HOST_DEVICE void run(shader_id id, request_index i) const {
    visit(id, call_with{i});
  }

  /// Calls `f(shader)` for shader `id`. Does nothing if the table has no such shader.
  DEFERRED_SHADE_EXEC_CHECK_DISABLE
  template <class Function>
  DEFERRED_SHADE_HOST_DEVICE void visit(shader_id id, Function const& f) const {
    visit_among<0, size()>(id, f);
  }

  /// Calls `f(id, shader)` for every shader in order; `id` is a std::integral_constant.
  DEFERRED_SHADE_EXEC_CHECK_DISABLE
  template <class Function>
  DEFERRED_SHADE_HOST_DEVICE void for_each(Function&& f) const {
    for_each_among<0, size()>(f);
  }

 private:
  // Compilers turn the folded comparisons of a leaf into one switch. Larger tables are halved
  // first, because clang limits the depth of a fold to 256.
  static constexpr shader_id leaf_size = 32;

  template <shader_id Id>
  using type_at =
      std::decay_t<decltype(detail::shader_in<Id>(std::declval<table_of<Shaders...> const&>()))>;

  struct call_with {
    request_index i;
    DEFERRED_SHADE_EXEC_CHECK_DISABLE
    template <class Shader>
    DEFERRED_SHADE_HOST_DEVICE void operator()(Shader const& shader) const {
      static_cast<void>(shader(i));
    }
  };

  DEFERRED_SHADE_EXEC_CHECK_DISABLE
  template <shader_id First, shader_id Last, class Function>
  DEFERRED_SHADE_HOST_DEVICE void visit_among(shader_id id, Function const& f) const {
    if constexpr (Last - First <= leaf_size) {
      visit_leaf<First>(id, f, std::make_integer_sequence<shader_id, Last - First>());
    } else {
      constexpr shader_id middle = First + (Last - First) / 2;
      if (id < middle) {
        visit_among<First, middle>(id, f);
      } else {
        visit_among<middle, Last>(id, f);
      }
    }
  }

  DEFERRED_SHADE_EXEC_CHECK_DISABLE
  template <shader_id First, class Function, shader_id... Offsets>
  DEFERRED_SHADE_HOST_DEVICE void visit_leaf(
      shader_id id, Function const& f, std::integer_sequence<shader_id, Offsets...> leaf) const {
    (void)(visit_type<First, First + Offsets>(id, f, leaf) || ...);
  }

  // Visits shader `id` if it is of the type of shader `Id`, and returns whether it is. Shaders of
  // one type share one copy of the code, for which the first of them stands: compilers would make a
  // copy of each, and lanes in different copies do not run together.
  DEFERRED_SHADE_EXEC_CHECK_DISABLE
  template <shader_id First, shader_id Id, class Function, shader_id... Offsets>
  DEFERRED_SHADE_HOST_DEVICE bool visit_type(shader_id id, Function const& f,
                                             std::integer_sequence<shader_id, Offsets...>) const {
    constexpr equal_types<type_at<First + Offsets>...> types;
    if constexpr (!has<Id> || types.count[Id - First] == 0) {
      return false;  // left out, or one before it stands for it
    } else if constexpr (types.count[Id - First] == 1) {
      if (id != Id) return false;
      f(get<Id>());
      return true;
    } else if constexpr (is_shared<type_at<Id>>) {
      bool const is_one_of_them =
          ((std::is_same_v<type_at<Id>, type_at<First + Offsets>> && id == First + Offsets) || ...);
      if (is_one_of_them) f(get<Id>().with_id(id));
      return is_one_of_them;
    } else {
      type_at<Id> const* shader = nullptr;
      (choose<First + Offsets>(id, shader), ...);
      if (shader != nullptr) f(*shader);
      return shader != nullptr;
    }
  }

  template <shader_id Id, class Shader>
  DEFERRED_SHADE_HOST_DEVICE void choose(shader_id id, Shader const*& shader) const {
    if constexpr (std::is_same_v<type_at<Id>, Shader>) {
      if (id == Id) shader = detail::address_of(get<Id>());
    }
  }

  DEFERRED_SHADE_EXEC_CHECK_DISABLE
  template <shader_id First, shader_id Last, class Function>
  DEFERRED_SHADE_HOST_DEVICE void for_each_among(Function& f) const {
    if constexpr (Last - First <= leaf_size) {
      for_each_leaf<First>(f, std::make_integer_sequence<shader_id, Last - First>());
    } else {
      constexpr shader_id middle = First + (Last - First) / 2;
      for_each_among<First, middle>(f);
      for_each_among<middle, Last>(f);
    }
  }

  DEFERRED_SHADE_EXEC_CHECK_DISABLE
  template <shader_id First, class Function, shader_id... Offsets>
  DEFERRED_SHADE_HOST_DEVICE void for_each_leaf(
      Function& f, std::integer_sequence<shader_id, Offsets...>) const {
    (call_for<First + Offsets>(f), ...);
  }

  DEFERRED_SHADE_EXEC_CHECK_DISABLE
  template <shader_id Id, class Function>
  DEFERRED_SHADE_HOST_DEVICE void call_for(Function& f) const {
    if constexpr (has<Id>) f(std::integral_constant<shader_id, Id>{}, get<Id>());
  }

  table_of<Shaders...> shaders_;
};

}  // namespace detail
}  // namespace deferred_shade
