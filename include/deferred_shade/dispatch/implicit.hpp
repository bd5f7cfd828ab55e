// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thrust/for_each.h>
#include <thrust/iterator/counting_iterator.h>
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
  thrust::for_each_n(exec, thrust::counting_iterator<request_index>(0), std::size_t{n},
                     [ids, &shaders](request_index i) {
                       shaders.run(detail::shader_of(ids, i, sizeof...(Shaders)), i);
                     });
}

// The switch is on the segment that holds the request. Every block has its share of every segment,
// so that no worker has all requests of the slowest shader.
template <class Policy, class... Shaders>
void run_implicit(host_system, Policy const& exec, grouping group,
                  shader_table<Shaders...> const& shaders) {
  block_partition const blocks(group.offsets[sizeof...(Shaders)], sizeof...(Shaders));
  for_each_block(exec, blocks, [=, &shaders](std::size_t b) {
    for (shader_id k = 0; k < sizeof...(Shaders); ++k) {
      std::size_t const first = group.offsets[k];
      std::size_t const size = group.offsets[k + 1] - first;
      std::size_t const end = first + size * (b + 1) / blocks.count();
      for (std::size_t p = first + size * b / blocks.count(); p < end; ++p) {
        shaders.run(k, group.permutation[p]);
      }
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
