// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deferred_shade/config.hpp>  // first: it refuses what is too old

#include <algorithm>
#include <cstddef>

#include <deferred_shade/detail/cpu/tile.hpp>
#include <deferred_shade/detail/cuda/workspace_bytes.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/detail/tile_sorts.hpp>
#include <deferred_shade/dispatch.hpp>
#include <deferred_shade/grouping.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/types.hpp>
#ifdef __CUDACC__
#include <deferred_shade/detail/cuda/tile.hpp>
#include <deferred_shade/detail/cuda/window.hpp>
#endif

namespace deferred_shade {

/// One stream compaction per shader, then `Dispatch`, implicit_serialization or
/// explicit_serialization. Schedules 3 and 4 of Hoberock et al., HPG 2009.
///
/// For a table of a few shaders; sort_then_dispatch and bucket_then_dispatch do the same work
/// whatever the number of shaders.
template <class Dispatch = explicit_serialization>
struct compact_then_dispatch {
  /// The bytes of workspace that batches of up to `n` requests over up to `shaders` shaders take.
  template <class Policy>
  static constexpr std::size_t workspace_bytes(Policy const&, std::size_t n, std::size_t shaders) {
    return detail::compact_bytes(detail::system_of<Policy>{}, n, shaders);
  }

  template <class Policy, class Count, class Ids, class... Shaders, class Workspace>
  void operator()(Policy const& exec, Count n, Ids ids, shader_table<Shaders...> const& shaders,
                  Workspace& scratch) const {
    Dispatch{}(exec,
               deferred_shade::group_by_compaction<sizeof...(Shaders)>(exec, n, ids, scratch,
                                                                       shaders.expected()),
               shaders, scratch);
  }
};

/// A radix sort of (id, index) pairs, then `Dispatch`, implicit_serialization or
/// explicit_serialization. Schedules 5 and 6 of Hoberock et al., HPG 2009.
template <class Dispatch = explicit_serialization>
struct sort_then_dispatch {
  /// The bytes of workspace that batches of up to `n` requests over up to `shaders` shaders take.
  template <class Policy>
  static constexpr std::size_t workspace_bytes(Policy const&, std::size_t n, std::size_t shaders) {
    return detail::radix_bytes(detail::system_of<Policy>{}, n, shaders);
  }

  template <class Policy, class Count, class Ids, class... Shaders, class Workspace>
  void operator()(Policy const& exec, Count n, Ids ids, shader_table<Shaders...> const& shaders,
                  Workspace& scratch) const {
    Dispatch{}(exec, deferred_shade::group_by_radix_sort<sizeof...(Shaders)>(exec, n, ids, scratch),
               shaders, scratch);
  }
};

/// One stable counting pass straight to a permutation and the offsets of its segments, then
/// `Dispatch`, implicit_serialization or explicit_serialization.
///
/// What sort_then_dispatch does, without keys that move: of the schedules that group a whole batch
/// it reads and writes least.
template <class Dispatch = explicit_serialization>
struct bucket_then_dispatch {
  /// The bytes of workspace that batches of up to `n` requests over up to `shaders` shaders take.
  template <class Policy>
  static constexpr std::size_t workspace_bytes(Policy const&, std::size_t n, std::size_t shaders) {
    return detail::bucket_bytes(detail::system_of<Policy>{}, n, shaders);
  }

  template <class Policy, class Count, class Ids, class... Shaders, class Workspace>
  void operator()(Policy const& exec, Count n, Ids ids, shader_table<Shaders...> const& shaders,
                  Workspace& scratch) const {
    Dispatch{}(exec, deferred_shade::group_by_bucket<sizeof...(Shaders)>(exec, n, ids, scratch),
               shaders, scratch);
  }
};

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
  /// It takes none of a workspace.
  template <class Policy>
  static constexpr std::size_t workspace_bytes(Policy const&, std::size_t, std::size_t) {
    return 0;
  }

  template <class Policy, class Count, class Ids, class... Shaders, class Workspace>
  void operator()(Policy const& exec, Count n, Ids ids, shader_table<Shaders...> const& shaders,
                  Workspace& scratch) const {
    [[maybe_unused]] auto const dispatched = scratch.begin_phase({"dispatch"});
    detail::run_tiles(detail::system_of<Policy>{}, Sort{}, exec, n, ids, shaders, scratch);
  }
};

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
  /// The bytes of workspace that batches of up to `n` requests over up to `shaders` shaders take.
  template <class Policy>
  static constexpr std::size_t workspace_bytes(Policy const&, std::size_t n, std::size_t shaders) {
    return detail::window_bytes(detail::system_of<Policy>{}, n, shaders);
  }

  template <class Policy, class Count, class Ids, class... Shaders, class Workspace>
  void operator()(Policy const& exec, Count n, Ids ids, shader_table<Shaders...> const& shaders,
                  Workspace& scratch) const {
    using machine = detail::system_of<Policy>;
    if constexpr (detail::has_windows<Workspace>(machine{}, sizeof...(Shaders))) {
      detail::run_windows(machine{}, exec, n, ids, shaders, scratch);
    } else {
      bucket_then_dispatch<implicit_serialization>{}(exec, n, ids, shaders, scratch);
    }
  }
};

/// Calls `f(name, schedule)` with every schedule of the library: a `char const*`, and an object of
/// its type. For command lines, benchmarks and tests, which then know them all by the same names.
template <class Function>
constexpr void for_each_schedule(Function&& f) {
  f("implicit", implicit_serialization{});
  f("explicit", explicit_serialization{});
  f("compact+implicit", compact_then_dispatch<implicit_serialization>{});
  f("compact+explicit", compact_then_dispatch<explicit_serialization>{});
  f("sort+implicit", sort_then_dispatch<implicit_serialization>{});
  f("sort+explicit", sort_then_dispatch<explicit_serialization>{});
  f("bucket+implicit", bucket_then_dispatch<implicit_serialization>{});
  f("bucket+explicit", bucket_then_dispatch<explicit_serialization>{});
  f("local-bitonic", local_sort_then_dispatch<bitonic>{});
  f("local", local_sort_then_dispatch<counting>{});
  f("window", window_sort_then_dispatch{});
}

namespace detail {

/// All of them, for a workspace that serves any.
struct every_schedule {
  template <class Machine>
  static constexpr std::size_t workspace_bytes(Machine const& where, std::size_t n,
                                               std::size_t shaders) {
    std::size_t most = 0;
    deferred_shade::for_each_schedule([&](char const*, auto const& schedule) {
      most = (std::max)(most, schedule.workspace_bytes(where, n, shaders));
    });
    return most;
  }
};

}  // namespace detail
}  // namespace deferred_shade
