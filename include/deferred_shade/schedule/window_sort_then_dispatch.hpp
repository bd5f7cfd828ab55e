// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deferred_shade/grouping/tile.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/system.hpp>
#include <deferred_shade/types.hpp>
#ifdef __CUDACC__
#include <deferred_shade/schedule/cuda/window_sort_then_dispatch.hpp>
#endif

namespace deferred_shade {
namespace detail {

template <class Policy, class Ids, class... Shaders, class Workspace>
void run_windows(host_system here, Policy const& exec, request_index n, Ids ids,
                 shader_table<Shaders...> const& shaders, Workspace& scratch) {
  [[maybe_unused]] auto const dispatched = scratch.begin_phase({"dispatch"});
  run_tiles(here, counting{}, exec, n, ids, shaders);
}

}  // namespace detail

/// Sorts each window of the batch by a stable counting sort, and runs it shader by shader. A window
/// is as many neighbouring requests as a second-level cache holds with what they load and store. On
/// a CPU that is the cache of a core, and the schedule the same as local_sort_then_dispatch; on a
/// GPU it is the one that all multiprocessors share.
///
/// There it stands between local_sort_then_dispatch and bucket_then_dispatch. Tiles have few
/// requests of each shader where shaders are many, and code that changes all the time falls out of
/// instruction caches where shaders are long. Buckets of a whole batch bring requests of one shader
/// together that lie far apart, and of what is loaded for one request a neighbour's share goes to
/// waste.
///
/// On CUDA, three launches for up to 32 shaders, of which the last one is the switch; for larger
/// tables, what bucket_then_dispatch<implicit_serialization> does.
struct window_sort_then_dispatch {
  template <class Policy, class Count, class Ids, class... Shaders, class Workspace>
  void operator()(Policy const& exec, Count n, Ids ids, shader_table<Shaders...> const& shaders,
                  Workspace& scratch) const {
    detail::run_windows(detail::system_of<Policy>{}, exec, n, ids, shaders, scratch);
  }
};

}  // namespace deferred_shade
