// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thrust/for_each.h>
#include <thrust/iterator/counting_iterator.h>
#include <algorithm>
#include <cstddef>

#include <deferred_shade/blocks.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/system.hpp>
#include <deferred_shade/types.hpp>
#include <deferred_shade/workspace.hpp>
#ifdef __CUDACC__
#include <deferred_shade/dispatch/cuda/implicit.hpp>
#endif

namespace deferred_shade {
namespace detail {

template <class Policy, class Ids, class... Shaders>
void run_implicit(host_system, Policy const& exec, request_index n, Ids ids,
                  shader_table<Shaders...> const& shaders) {
  thrust::for_each_n(
      exec, thrust::counting_iterator<request_index>(0), std::size_t{n},
      [ids, &shaders](request_index i) { shaders.run(shader_of(ids, i, sizeof...(Shaders)), i); });
}

// The switch is on the segment that holds the request, which a block finds once and then follows.
template <class Policy, class... Shaders>
void run_implicit(host_system, Policy const& exec, grouping group,
                  shader_table<Shaders...> const& shaders) {
  request_index const* const ends = group.offsets + 1;
  block_partition const blocks(group.offsets[sizeof...(Shaders)], 0);
  for_each_block(exec, blocks, [=, &shaders](std::size_t b) {
    auto const begin = static_cast<request_index>(blocks.begin(b));
    auto const end = static_cast<request_index>(blocks.end(b));
    auto id =
        static_cast<shader_id>(std::upper_bound(ends, ends + sizeof...(Shaders), begin) - ends);
    for (request_index p = begin; p < end; ++p) {
      while (p >= ends[id]) ++id;
      shaders.run(id, group.permutation[p]);
    }
  });
}

}  // namespace detail

/// One launch over all requests, with a switch: where neighbours need different shaders, the
/// hardware runs one after the other. Schedule 1 of Hoberock et al., HPG 2009, and, over a
/// grouping, the second half of its schedules 3 and 5. On CUDA, the loads and stores of record
/// shaders are taken out of the switch (docs/gpu.md).
struct implicit_serialization {
  /// The schedule: requests as they come.
  template <class Policy, class Count, class Ids, class... Shaders, class Workspace>
  void operator()(Policy const& exec, Count n, Ids ids, shader_table<Shaders...> const& shaders,
                  Workspace& scratch) const {
    [[maybe_unused]] auto const dispatched = scratch.begin_phase({"dispatch"});
    detail::run_implicit(detail::system_of<Policy>{}, exec, n, ids, shaders);
  }

  /// The dispatch: requests as `group` orders them. `scratch` is there for its observer.
  template <class Policy, class... Shaders, class Workspace = workspace<>>
  void operator()(Policy const& exec, grouping group, shader_table<Shaders...> const& shaders,
                  Workspace const& scratch = {}) const {
    [[maybe_unused]] auto const dispatched = scratch.begin_phase({"dispatch"});
    detail::run_implicit(detail::system_of<Policy>{}, exec, group, shaders);
  }
};

}  // namespace deferred_shade
