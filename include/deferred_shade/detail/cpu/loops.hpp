// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>

#include <deferred_shade/detail/cpu/item_source.hpp>
#include <deferred_shade/detail/cpu/parallel_for.hpp>
#include <deferred_shade/detail/cpu/pool.hpp>
#include <deferred_shade/detail/cpu/tuning.hpp>
#include <deferred_shade/detail/system.hpp>
#include <deferred_shade/items.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/types.hpp>
#include <deferred_shade/workspace.hpp>

// Loops on a CPU. A worker owns a pool of slots that its second-level cache holds, and runs rounds
// over it until no item is left. Workers share nothing but the number of the next item.

namespace deferred_shade::detail {

/// How the slots of a loop are divided among workers.
struct worker_slots {
  std::size_t workers;
  request_index each;  ///< the slots of one worker

  worker_slots(std::size_t slots, std::size_t threads, request_index most)
      : workers((std::min)(slots, threads)),
        each(static_cast<request_index>((std::min)(slots / workers, std::size_t{most}))) {}
};

template <class Policy, class Workspace>
worker_slots slots_of(Policy const& exec, items const& all, Workspace const&) {
  return {all.slots, detail::workers_of(exec), cpu_tuning_of<Workspace>::slots_of_worker};
}

/// Calls `f(pool, memory, source)` for each worker: with its slots, `more_bytes` of memory and the
/// items.
template <class Policy, class Begin, class... Stages, class Workspace, class Function>
void for_each_pool(Policy const& exec, items const& all, program<Begin, Stages...> const& what,
                   Workspace& scratch, std::size_t more_bytes, Function const& f) {
  using key = typename program<Begin, Stages...>::key;
  worker_slots const slots = detail::slots_of(exec, all, scratch);
  std::size_t const keys = detail::array_bytes<key>(slots.each);
  std::size_t const bytes = keys + more_bytes;
  auto const [memory] = scratch.take(elements<std::byte>(slots.workers * bytes));
  item_source source(all, slots.workers);
  detail::parallel_for(exec, slots.workers, [&, first = memory](std::size_t worker) {
    std::byte* const here = first + worker * bytes;
    pool<program<Begin, Stages...>> mine(what, static_cast<request_index>(worker * slots.each),
                                         slots.each, reinterpret_cast<key*>(here));
    f(mine, here + keys, source);
  });
}

/// Runs items one by one, each to its end.
template <class Policy, class Begin, class... Stages>
void run_depth_first(host_system, Policy const& exec, items const& all,
                     program<Begin, Stages...> const& what) {
  worker_slots const slots(all.slots, detail::workers_of(exec), 1);
  item_source source(all, slots.workers);
  detail::parallel_for(exec, slots.workers, [&](std::size_t worker) {
    auto const slot = static_cast<request_index>(worker);
    for (auto some = source.take(items_at_a_time); some.first != some.last;
         some = source.take(items_at_a_time)) {
      item_index ended = 0;
      for (item_index k = some.first; k != some.last; ++k) {
        if (!what.finish(slot, what.start(slot, k), source)) break;
        ++ended;
      }
      source.add_ended(ended);
    }
  });
}

}  // namespace deferred_shade::detail
