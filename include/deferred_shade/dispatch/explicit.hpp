// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thrust/for_each.h>
#include <thrust/iterator/counting_iterator.h>
#include <cstddef>

#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade {

/// One launch per shader. Schedule 2 of Hoberock et al., HPG 2009, and, over a grouping, the
/// second half of its schedules 4 and 6.
struct explicit_serialization {
  /// The schedule: every launch visits all requests and masks those of other shaders.
  template <class Policy, class Ids, class... Shaders, class Workspace>
  void operator()(Policy const& exec, request_index n, Ids ids,
                  shader_table<Shaders...> const& shaders, Workspace&) const {
    shaders.for_each([&](auto id, auto const& shader) {
      thrust::for_each_n(exec, thrust::counting_iterator<request_index>(0), std::size_t{n},
                         [ids, &shader](request_index i) {
                           if (shader_of(ids, i, sizeof...(Shaders)) == decltype(id)::value) {
                             shader(i);
                           }
                         });
    });
  }

  /// The dispatch: every launch visits the segment of its shader; an empty one is not launched.
  template <class Policy, class... Shaders>
  void operator()(Policy const& exec, grouping group,
                  shader_table<Shaders...> const& shaders) const {
    shaders.for_each([&](auto id, auto const& shader) {
      request_index const begin = group.offsets[id];
      request_index const end = group.offsets[id + 1];
      if (begin == end) return;
      thrust::for_each_n(exec, group.permutation + begin, std::size_t{end - begin},
                         [&shader](request_index i) { shader(i); });
    });
  }
};

}  // namespace deferred_shade
