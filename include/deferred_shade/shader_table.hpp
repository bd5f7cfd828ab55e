// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bitset>
#include <type_traits>
#include <utility>

#include <deferred_shade/detail/ids.hpp>
#include <deferred_shade/detail/shader_list.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade {

/// A set of shaders, by their ids: see `variants`.
template <shader_id... Ids>
struct ids {};

/// The shaders that requests can name. The id of a shader is its position.
///
/// A shader is a function object on the index of a request, `void operator()(request_index) const`.
/// It must be cheap to copy: it holds views of the renderer's memory, not the memory. It runs
/// concurrently with other requests, must not throw, and writes only what belongs to its own
/// request.
///
///     deferred_shade::shader_table shaders{matte{film, hits}, glass{film, hits}};
template <class... Shaders>
class shader_table : public detail::shader_list<Shaders...> {
  using list = detail::shader_list<Shaders...>;
  static_assert(sizeof...(Shaders) > 0, "deferred_shade: a shader table must have a shader");

 public:
  constexpr explicit shader_table(Shaders... shaders) : list(std::move(shaders)...) {}

  using list::first_id;  ///< first_id(): the lowest id that the table has a shader for
  using list::for_each;  ///< for_each(f): calls `f(id, shader)` for every shader in order
  using list::get;       ///< get<Id>(): the shader at position `Id`
  using list::has;       ///< has<Id>: whether there is one: false if `only` has left it out
  using list::run;       ///< run(id, i): runs shader `id` on request `i`, if there is one
  using list::size;      ///< size(): the number of shaders
  using list::visit;     ///< visit(id, f): calls `f(shader)` for shader `id`, if there is one

  /// The same table, with the same ids, but only with the shaders of `Ids`. Requests of the others
  /// are skipped, as if the table had no such id, and no code is generated for those shaders. Use
  /// it if a scene is known not to need them: the switch has fewer cases and takes fewer registers.
  /// See specialized.hpp for a choice at run time.
  template <shader_id... Ids>
  constexpr auto only() const {
    static_assert(sizeof...(Ids) > 0, "deferred_shade: only must be given an id");
    static_assert(detail::listed_ids<size()>::template of<Ids...>().fit,
                  "deferred_shade: only must be given ids of the table");
    return only_among<Ids...>(std::make_integer_sequence<shader_id, size()>());
  }

  /// The same table, for batches in which only the `occurring` shaders occur. Schedules with a
  /// launch or a compaction for each shader leave the others out, and requests that name them may
  /// be skipped. Use it if a scene is known to have no such material. Unlike `only`, it generates
  /// no code.
  shader_table expecting(std::bitset<sizeof...(Shaders)> const& occurring) const {
    shader_table result = *this;
    result.absent_ = ~occurring;
    return result;
  }

  /// The shaders that may occur: all except those that `only` and `expecting` leave out.
  std::bitset<sizeof...(Shaders)> expected() const {
    std::bitset<sizeof...(Shaders)> result;
    this->for_each([&](auto id, auto const&) { result[id] = !absent_[id]; });
    return result;
  }

 private:
  template <class... Others>
  friend class shader_table;

  template <shader_id... Ids, shader_id... All>
  constexpr auto only_among(std::integer_sequence<shader_id, All...>) const {
    constexpr auto kept = detail::listed_ids<size()>::template of<Ids...>();
    using table = shader_table<std::conditional_t<kept.has[All], Shaders, no_shader>...>;
    table result{get_if<All, kept.has[All]>()...};
    result.absent_ = absent_;
    return result;
  }

  template <shader_id Id, bool Keep>
  constexpr auto get_if() const {
    if constexpr (Keep) {
      return this->template get<Id>();
    } else {
      return no_shader{};
    }
  }

  std::bitset<sizeof...(Shaders)> absent_;
};

template <class... Shaders>
shader_table(Shaders...) -> shader_table<Shaders...>;

namespace detail {

template <class Function, shader_id... Ids>
constexpr auto shared_among(Function const& function, std::integer_sequence<shader_id, Ids...>) {
  return shader_table{shared_shader<Function>(function, Ids)...};
}

}  // namespace detail

/// A table of `Count` shaders that share a callable: `function(id, i)`, for request i of shader
/// `id`. A schedule with a switch runs the lanes of all of them together, and the callable branches
/// where they differ. For materials that share most of their code, next-event estimation for
/// example: compilers make a copy of that code for each of several types, and lanes in different
/// copies do not run together. (Shaders of one type share code without this.)
///
///     auto const shaders = ds::shared_shaders<6>(shade_any{scene, paths});
template <shader_id Count, class Function>
constexpr auto shared_shaders(Function const& function) {
  return detail::shared_among(function, std::make_integer_sequence<shader_id, Count>());
}

}  // namespace deferred_shade
