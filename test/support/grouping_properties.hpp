// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <deferred_shade/types.hpp>
#include <deferred_shade/workspace.hpp>
#include <numeric>
#include <vector>

#include "../catch.hpp"
#include "backends.hpp"
#include "random_ids.hpp"

namespace test {

namespace ds = deferred_shade;

/// Compares what `group(exec, n, ids, scratch)` returns with a sort by (id, index), which is the
/// stable sort by id.
template <class Id, ds::shader_id Shaders, class Policy, class Group>
void check_grouping_of(Policy const& exec, Group const& group) {
  ds::workspace scratch{exec};
  for (std::uint32_t const n : edge_sizes()) {
    for (layout const how : layouts) {
      std::uint32_t const seed = run_seed() + n + static_cast<std::uint32_t>(how);
      CAPTURE(n, static_cast<int>(how), seed, Shaders, sizeof(Id));
      std::vector<Id> const ids = make_ids<Id>(how, n, Shaders, seed);

      std::vector<ds::request_index> expected(n);
      std::iota(expected.begin(), expected.end(), 0U);
      auto const id = [&ids](std::uint32_t i) { return static_cast<std::uint32_t>(ids[i]); };
      expected.erase(std::remove_if(expected.begin(), expected.end(),
                                    [&](std::uint32_t i) { return id(i) >= Shaders; }),
                     expected.end());
      std::sort(expected.begin(), expected.end(), [&](std::uint32_t a, std::uint32_t b) {
        return id(a) != id(b) ? id(a) < id(b) : a < b;
      });

      ds::grouping const result = group(exec, n, ids.data(), scratch);
      for (ds::shader_id k = 0; k <= Shaders; ++k) {
        auto const below = std::count_if(expected.begin(), expected.end(),
                                         [&](std::uint32_t i) { return id(i) < k; });
        REQUIRE(result.offsets[k] == below);
      }
      bool const same = std::equal(expected.begin(), expected.end(), result.permutation);
      CHECK(same);
    }
  }
}

}  // namespace test
