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

/// Groups by one stream compaction per shader, then runs `Dispatch`: implicit_serialization or
/// explicit_serialization. Schedules 3 and 4 of Hoberock et al., HPG 2009.
///
/// For tables of a few shaders: its work grows with their number. That of sort_then_dispatch and
/// bucket_then_dispatch does not.
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

/// Groups by a radix sort of (id, index) pairs, then runs `Dispatch`: implicit_serialization or
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

/// Groups by one stable counting sort, then runs `Dispatch`: implicit_serialization or
/// explicit_serialization.
///
/// It does what sort_then_dispatch does, but moves no keys. Of the schedules that group a whole
/// batch, it reads and writes the least.
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

/// Sorts and shades tile by tile, in one launch. One worker or thread block owns a tile: as many
/// requests as the cache of a core or the shared memory of a multiprocessor holds. It uses no
/// memory but the worker's own.
///
/// `Sort` is `counting` or `bitonic`. `counting`, the default, sorts the tile by a stable counting
/// sort and runs it shader by shader. `bitonic` sorts it by a bitonic sort and runs it by a switch:
/// schedule 7 of Hoberock et al., HPG 2009.
///
/// On a CPU, record shaders run in vectors if the compiler vectorises them (docs/records.md,
/// "Vectors on a CPU"). A tile with long runs of one shader is not sorted.
///
/// On CUDA, record shaders pass through shared memory if the table has at most 16 of them, with one
/// type each of source, sink and result, and if records are trivially copyable and have at most 128
/// bytes (docs/limits.md, "Records"). A tile is loaded in memory order, shaded in shader order, and
/// stored in memory order. In a table of up to 8 index shaders, these are assumed to be short:
/// tiles are small, and a switch runs over the sorted requests.
template <class Sort = counting>
struct local_sort_then_dispatch {
  /// Takes no workspace.
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

/// Sorts each window of the batch by a stable counting sort and runs it shader by shader. A window
/// is as many neighbouring requests as fit in a second-level cache with what they load and store.
/// On a GPU, all multiprocessors share that cache, and a window has 128 Ki requests. On a CPU, each
/// core has its own, and this schedule is local_sort_then_dispatch.
///
/// On a GPU, it stands between local_sort_then_dispatch and bucket_then_dispatch. If a table has
/// many shaders, a tile has few requests of each. If shaders are long, each tile loads all their
/// code again, and instruction caches overflow. Buckets of a whole batch bring requests together
/// that lie far apart in memory: of each sector, most bytes are loaded for nothing.
///
/// On CUDA, a table of up to 32 shaders takes three launches; the last one is the switch. Larger
/// tables run as bucket_then_dispatch<implicit_serialization>.
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

/// Calls `f(name, schedule)` for every schedule of the library, with a `char const*` and an object
/// of its type. Command lines, benchmarks and tests then share the names.
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

/// All of them, for a workspace that is large enough for any.
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
