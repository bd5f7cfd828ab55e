// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

#include <deferred_shade/grouping/tile.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/system.hpp>
#include <deferred_shade/types.hpp>
#ifdef __CUDACC__
#include <deferred_shade/schedule/cuda/local_sort_then_dispatch.hpp>
#endif

namespace deferred_shade {
namespace detail {

template <class Policy, class Ids, class... Shaders>
void run_tiles(host_system, bitonic, Policy const& exec, request_index n, Ids ids,
               shader_table<Shaders...> const& shaders) {
  for_each_tile<bitonic::tile>(exec, n, [ids, &shaders](request_index first, request_index size) {
    std::uint32_t keys[bitonic::tile];
    for (request_index i = 0; i < size; ++i) {
      keys[i] =
          bitonic_key<sizeof...(Shaders)>(detail::shader_of(ids, first + i, sizeof...(Shaders)), i);
    }
    std::fill(keys + size, keys + bitonic::tile, 0xffffffffU);
    bitonic_sort(keys);
    for (request_index i = 0; i < size; ++i) {
      shaders.run(keys[i] / bitonic::tile, first + keys[i] % bitonic::tile);
    }
  });
}

}  // namespace detail

/// Sorts and shades tile by tile: a tile is as many requests as one core's cache or one
/// multiprocessor's shared memory holds, and one worker or thread block owns it. One launch, and no
/// memory but the worker's own.
///
/// `Sort` is `counting`, the default: a stable counting sort inside the tile, then shader by shader
/// over its requests. Or it is `bitonic`: a bitonic sort inside the tile, then the switch, schedule
/// 7 of Hoberock et al., HPG 2009.
///
/// On CPUs, record shaders run in vectors where the compiler makes them (docs/records.md, "Vectors
/// on a CPU"), and a tile whose neighbours mostly name the same shader is run as it lies.
///
/// On CUDA, a table of record shaders with sources of one type and sinks of one type, whose
/// requests and results are trivially copyable and small enough, passes through shared memory: the
/// requests of a tile are loaded in the order in which they lie, shaded in the order of their
/// shaders, and their results stored in the order in which they lie. A table of up to 8 index
/// shaders is taken for one of short ones: tiles are small, and run by a switch over the sorted
/// requests.
template <class Sort = counting>
struct local_sort_then_dispatch {
  template <class Policy, class Count, class Ids, class... Shaders, class Workspace>
  void operator()(Policy const& exec, Count n, Ids ids, shader_table<Shaders...> const& shaders,
                  Workspace& scratch) const {
    [[maybe_unused]] auto const dispatched = scratch.begin_phase({"dispatch"});
    detail::run_tiles(detail::system_of<Policy>{}, Sort{}, exec, n, ids, shaders);
  }
};

}  // namespace deferred_shade
