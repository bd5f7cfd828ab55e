// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <deferred_shade/deferred_shade.hpp>
#include <vector>

/// A loop of a renderer's own, for a CPU: fills all slots with items, and runs rounds by `Schedule`
/// until all of them have ended. The simplest loop there is, and the one of most wavefront
/// renderers: near the end of such a batch, most slots are empty.
template <class Schedule>
struct slots_at_once {
  Schedule schedule{};

  template <class Policy, class Begin, class... Stages, class Workspace>
  void operator()(Policy const& exec, deferred_shade::items const& all, Begin const& begin,
                  deferred_shade::shader_table<Stages...> const& stages, Workspace& scratch) const {
    using deferred_shade::shader_id;
    std::vector<shader_id> ids, next;
    auto const is_live = [&](shader_id id) { return id < stages.size(); };
    for (deferred_shade::item_index done = 0; done < all.count; done += ids.size()) {
      ids.resize(static_cast<std::size_t>(std::min<std::uint64_t>(all.slots, all.count - done)));
      for (std::size_t slot = 0; slot < ids.size(); ++slot) {
        ids[slot] = static_cast<shader_id>(
            begin(static_cast<deferred_shade::request_index>(slot), all.first + done + slot));
      }
      while (std::any_of(ids.begin(), ids.end(), is_live)) {
        next.assign(ids.size(), stages.size());  // where no stage runs, the request has ended
        deferred_shade::shade(exec, schedule, ids.size(), ids.data(),
                              deferred_shade::stepping(stages, next.data()), scratch);
        ids.swap(next);
      }
    }
  }
};
