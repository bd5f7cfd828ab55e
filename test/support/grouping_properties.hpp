// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deferred_shade/types.hpp>
#include <deferred_shade/workspace.hpp>
#include <vector>

#include "backends.hpp"
#include "catch.hpp"
#include "compare.hpp"
#include "random_ids.hpp"

namespace test {

namespace ds = deferred_shade;

/// What a grouping must be: the requests of shader 0 in the order in which they came, then those of
/// shader 1, and so on.
struct stable_grouping {
  template <class Id>
  stable_grouping(std::vector<Id> const& ids, ds::shader_id shaders) {
    std::vector<std::vector<ds::request_index>> requests(shaders);
    for (ds::request_index i = 0; i < ids.size(); ++i) {
      auto const id = static_cast<ds::shader_id>(ids[i]);
      if (id < shaders) requests[id].push_back(i);
    }
    offsets.push_back(0);
    for (auto const& list : requests) {
      permutation.insert(permutation.end(), list.begin(), list.end());
      offsets.push_back(static_cast<ds::request_index>(permutation.size()));
    }
  }
  std::vector<ds::request_index> permutation;
  std::vector<ds::request_index> offsets;
};

/// Compares `result`, which lies in the memory of a workspace, with `expected`.
template <class Backend>
void check_grouping(ds::grouping const& result, stable_grouping const& expected) {
  auto const offsets = Backend::read(result.offsets, expected.offsets.size());
  REQUIRE(first_difference(offsets, expected.offsets) == offsets.size());
  auto const permutation = Backend::read(result.permutation, expected.permutation.size());
  CHECK(first_difference(permutation, expected.permutation) == permutation.size());
}

/// Compares what `group(exec, n, ids, scratch)` returns with a plain loop.
template <class Backend, class Id, ds::shader_id Shaders, class Group>
void check_grouping_of(Group const& group) {
  auto const exec = Backend::policy();
  ds::workspace scratch{exec};
  for (std::uint32_t const n : edge_sizes<Backend>()) {
    for (layout const how : layouts) {
      std::uint32_t const seed = run_seed() + n + static_cast<std::uint32_t>(how);
      CAPTURE(n, static_cast<int>(how), seed, Shaders, sizeof(Id));
      std::vector<Id> const data = make_ids<Id>(how, n, Shaders, seed);
      auto const ids = on<Backend>(data);
      check_grouping<Backend>(group(exec, n, ids.data(), scratch), stable_grouping(data, Shaders));
    }
  }
}

}  // namespace test
