// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include <deferred_shade/detail/cpu/block_partition.hpp>
#include <deferred_shade/detail/cpu/parallel_for.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/types.hpp>
#include <deferred_shade/workspace.hpp>

namespace deferred_shade::detail {

template <class Policy, class Ids, class... Shaders, class Workspace>
void run_implicit(host_system, Policy const& exec, request_index n, Ids ids,
                  shader_table<Shaders...> const& shaders, Workspace const&) {
  detail::for_each_request(exec, n, [ids, &shaders](request_index i) {
    shaders.run(detail::shader_of(ids, i, sizeof...(Shaders)), i);
  });
}

// The switch is over the segment that holds the request. Every block has its share of every
// segment: no worker gets all requests of the slowest shader.
template <class Policy, class... Shaders, class Workspace>
void run_implicit(host_system, Policy const& exec, grouping group,
                  shader_table<Shaders...> const& shaders, Workspace const&) {
  block_partition const blocks(group.offsets[sizeof...(Shaders)], sizeof...(Shaders));
  detail::for_each_block(exec, blocks, [=, &shaders](std::size_t b) {
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

}  // namespace deferred_shade::detail
