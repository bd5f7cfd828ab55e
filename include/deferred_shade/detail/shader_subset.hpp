// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thrust/iterator/transform_iterator.h>
#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/observer.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade::detail {

/// The ids of the shaders that a table has: the first `count` of `ids`, and a bit for each below
/// 32.
template <class... Shaders>
struct present_ids {
  std::array<shader_id, sizeof...(Shaders)> ids{};
  std::size_t count = 0;
  std::uint32_t bits = 0;

  constexpr present_ids() {
    bool const present[] = {!std::is_same_v<Shaders, no_shader>...};
    for (shader_id id = 0; id < sizeof...(Shaders); ++id) {
      if (!present[id]) continue;
      ids[count++] = id;
      if (id < 32) bits |= std::uint32_t{1} << id;
    }
  }
};

/// The place of an id among those of `Present`, or 32 if it is not one of them.
template <std::uint32_t Present>
struct place_among {
  template <class Id>
  DEFERRED_SHADE_HOST_DEVICE shader_id operator()(Id const& value) const {
    static_assert(is_id<Id>,
                  "deferred_shade: place_among must be called with an integer or an enumeration of "
                  "at most 32 bits");
    auto const id = static_cast<shader_id>(value);
    if (id >= 32 || (Present >> id & 1U) == 0) return 32;
    std::uint32_t const below = Present & ((std::uint32_t{1} << id) - 1);
#ifdef __CUDA_ARCH__
    return static_cast<shader_id>(__popc(below));
#else
    return static_cast<shader_id>(std::bitset<32>(below).count());
#endif
  }
};

/// The workspace for a table whose shader k is shader `ids[k]` of the renderer's table. An observer
/// is told the renderer's id.
template <class Workspace>
struct renumbered : workspace_wrapper<Workspace> {
  shader_id const* ids;

  renumbered(Workspace& scratch, shader_id const* there)
      : workspace_wrapper<Workspace>(scratch), ids(there) {}

  auto begin_phase(phase p) const {
    if (p.shader) p.shader = ids[*p.shader];
    return this->scratch.begin_phase(p);
  }
};

/// Whether a schedule takes a table with its gaps, because it uses ids itself.
template <class Schedule>
inline constexpr bool takes_gaps = false;

/// A table of the shaders that `shaders` has, without gaps.
template <class... Shaders, std::size_t... Places>
auto without_gaps(shader_table<Shaders...> const& shaders, std::index_sequence<Places...>) {
  constexpr present_ids<Shaders...> present;
  shader_table dense{shaders.template get<present.ids[Places]>()...};
  auto const expected = shaders.expected();
  std::bitset<sizeof...(Places)> expected_here;
  ((expected_here[Places] = expected[present.ids[Places]]), ...);
  return dense.expecting(expected_here);
}

/// Runs a schedule. On a GPU, tables of up to 32 places are compacted: empty places are dropped and
/// ids renumbered. Nothing is then counted, sorted or launched for a shader that is not there. (On
/// a CPU, renumbering every id costs more than that gains.)
template <class System, class Schedule, class Policy, class Count, class Ids, class... Shaders,
          class Workspace>
void run_schedule(System, Schedule const& schedule, Policy const& exec, Count n, Ids ids,
                  shader_table<Shaders...> const& shaders, Workspace& scratch) {
  constexpr present_ids<Shaders...> present;
  constexpr bool closes_gaps = std::is_same_v<System, cuda_system> && !takes_gaps<Schedule> &&
                               present.count > 0 && present.count < sizeof...(Shaders) &&
                               sizeof...(Shaders) <= 32;
  if constexpr (closes_gaps) {
    using dense_ids =
        thrust::transform_iterator<place_among<present.bits>, Ids, shader_id, shader_id>;
    static constexpr present_ids<Shaders...> those;
    renumbered seen(scratch, those.ids.data());
    schedule(exec, n, dense_ids(ids, {}),
             detail::without_gaps(shaders, std::make_index_sequence<present.count>()), seen);
  } else {
    schedule(exec, n, ids, shaders, scratch);
  }
}

}  // namespace deferred_shade::detail
