// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thrust/for_each.h>
#include <algorithm>
#include <array>
#include <deferred_shade/grouping.hpp>
#include <deferred_shade/shader_table.hpp>
#include <numeric>

/// A renderer's own schedule. Groups by buckets, then runs the shader with the most requests first:
/// short launches fill the gaps at the end.
struct largest_first_then_dispatch {
  template <class Policy, class Ids, class... Shaders, class Workspace>
  void operator()(Policy const& exec, deferred_shade::request_index n, Ids ids,
                  deferred_shade::shader_table<Shaders...> const& shaders,
                  Workspace& scratch) const {
    auto const group = deferred_shade::group_by_bucket<sizeof...(Shaders)>(exec, n, ids, scratch);
    auto const size = [&](auto k) { return group.offsets[k + 1] - group.offsets[k]; };
    std::array<deferred_shade::shader_id, sizeof...(Shaders)> order;
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return size(a) > size(b); });
    for (auto const k : order) {
      thrust::for_each_n(exec, group.permutation + group.offsets[k], size(k),
                         [&shaders, k](deferred_shade::request_index i) { shaders.run(k, i); });
    }
  }
};
