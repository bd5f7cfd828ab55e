// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deferred_shade/config.hpp>  // first: it refuses what is too old

#include <bitset>
#include <cstddef>
#include <initializer_list>

#include <deferred_shade/detail/shader_subset.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade {
namespace detail {

template <class Variant>
struct variant_traits;
template <shader_id... Ids>
struct variant_traits<ids<Ids...>> {
  /// The shaders of the variant, each counted once.
  template <std::size_t Shaders>
  static constexpr std::size_t size = listed_ids<Shaders>::template of<Ids...>().count;

  template <std::size_t Shaders>
  static bool covers(std::bitset<Shaders> occurring) {
    static_assert(listed_ids<Shaders>::template of<Ids...>().fit,
                  "deferred_shade: a variant must list ids of the table");
    for (shader_id const id : {Ids...}) occurring.reset(id);
    return occurring.none();
  }

  template <class Table>
  static auto table(Table const& shaders) {
    return shaders.template only<Ids...>();
  }
};

}  // namespace detail

/// Sets of shaders, each an `ids<...>`, that a renderer wants code for: of a table of dozens, the
/// sets that its scenes typically need. Each set is compiled, so the renderer has to declare them.
template <class... Variants>
struct variants {
  static_assert(sizeof...(Variants) > 0,
                "deferred_shade: variants must have at least one ids<...>");

  /// The number of variants. As the number of one, it stands for the whole table.
  static constexpr std::size_t count = sizeof...(Variants);

  /// The number of the smallest variant that has all shaders of `occurring`, the first among
  /// equals; `count` if none has.
  template <std::size_t Shaders>
  static std::size_t covering(std::bitset<Shaders> const& occurring) {
    std::size_t best = count, best_size = Shaders + 1, number = 0;
    auto const consider = [&](bool covers, std::size_t size) {
      if (covers && size < best_size) {
        best = number;
        best_size = size;
      }
      ++number;
    };
    (consider(detail::variant_traits<Variants>::covers(occurring),
              detail::variant_traits<Variants>::template size<Shaders>),
     ...);
    return best;
  }
};

namespace detail {

/// Calls `f(table)` with the shaders of variant number `chosen`, or with the whole table if there
/// is no such variant.
template <class... Variants, class Table, class Function>
void with_variant(variants<Variants...>, std::size_t chosen, Table const& shaders,
                  Function const& f) {
  std::size_t number = 0;
  bool const ran =
      ((chosen == number++ && (f(variant_traits<Variants>::table(shaders)), true)) || ...);
  if (!ran) f(shaders);
}

}  // namespace detail

/// A schedule for scenes that do not need all shaders of a table. It runs `schedule` over the
/// smallest variant that has all shaders that can occur, or over the whole table if none has. A
/// launch for each shader is made only for those that can occur.
///
///     using some = deferred_shade::variants<deferred_shade::ids<0, 1>,
///                                           deferred_shade::ids<0, 1, 4>>;
///     deferred_shade::specialized const schedule{
///         deferred_shade::window_sort_then_dispatch{}, some{}, scene.shaders()};
///
/// `occurring` has a bit for each shader of the table. The renderer knows it from the materials of
/// its scene, and must keep it true: a request that names another shader may be skipped.
/// count_occurrences finds it for one batch.
template <class Schedule, class Variants, std::size_t Shaders>
struct specialized {
  Schedule schedule;               ///< what runs
  Variants sets;                   ///< a variants<...>
  std::bitset<Shaders> occurring;  ///< the shaders that can occur

  /// The bytes of workspace that `schedule` takes.
  template <class Policy>
  constexpr std::size_t workspace_bytes(Policy const& exec, std::size_t n,
                                        std::size_t shaders) const {
    return schedule.workspace_bytes(exec, n, shaders);
  }

  /// The number of the variant that runs; variants::count for the whole table.
  std::size_t variant() const { return sets.covering(occurring); }

  template <class Policy, class Count, class Ids, class... AllShaders, class Workspace>
  void operator()(Policy const& exec, Count n, Ids ids, shader_table<AllShaders...> const& shaders,
                  Workspace& scratch) const {
    static_assert(
        sizeof...(AllShaders) == Shaders,
        "deferred_shade: occurring must have as many bits as the table has shaders; pass a "
        "std::bitset<table.size()>");
    if constexpr (sizeof...(AllShaders) == Shaders) {
      detail::with_variant(sets, variant(), shaders, [&](auto const& table) {
        detail::run_schedule(detail::system_of<Policy>{}, schedule, exec, n, ids,
                             table.expecting(occurring), scratch);
      });
    }
  }
};

template <class Schedule, class Variants, std::size_t Shaders>
specialized(Schedule, Variants, std::bitset<Shaders>) -> specialized<Schedule, Variants, Shaders>;

template <class Schedule, class Variants, std::size_t Shaders>
inline constexpr bool detail::takes_gaps<specialized<Schedule, Variants, Shaders>> = true;

}  // namespace deferred_shade
