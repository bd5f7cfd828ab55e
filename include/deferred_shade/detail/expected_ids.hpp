// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bitset>
#include <cstddef>
#include <stdexcept>
#include <string>

#include <deferred_shade/detail/fail.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/types.hpp>

// What DEFERRED_SHADE_CHECKED adds to `shade`: a look at all ids before anything runs.

namespace deferred_shade::detail {

/// Throws std::invalid_argument if one of `n` requests names a shader that the table has, and that
/// shader_table::expecting was told not to occur.
template <class Ids, class... Shaders>
void check_expected_ids(std::size_t n, Ids const& ids, shader_table<Shaders...> const& shaders) {
  std::bitset<sizeof...(Shaders)> unexpected;
  shaders.for_each([&](auto id, auto const&) { unexpected.set(id); });
  unexpected &= ~shaders.expected();
  if (unexpected.none()) return;
  for (std::size_t i = 0; i < n; ++i) {
    shader_id const id = detail::shader_of(ids, static_cast<request_index>(i), sizeof...(Shaders));
    if (id == sizeof...(Shaders) || !unexpected[id]) continue;
    detail::fail<std::invalid_argument>("deferred_shade::shade: request " + std::to_string(i) +
                                        " names shader " + std::to_string(id) +
                                        ", which expecting() was told not to occur");
  }
}

template <class Policy, class Ids, class... Shaders>
void check_expected(host_system, Policy const&, request_index n, Ids const& ids,
                    shader_table<Shaders...> const& shaders) {
  detail::check_expected_ids(n, ids, shaders);
}

}  // namespace deferred_shade::detail
