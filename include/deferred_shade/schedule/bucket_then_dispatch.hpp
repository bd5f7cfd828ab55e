// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deferred_shade/dispatch/explicit.hpp>
#include <deferred_shade/grouping/bucket.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade {

/// One stable counting pass straight to a permutation and the offsets of its segments, then
/// `Dispatch`, implicit_serialization or explicit_serialization.
///
/// What sort_then_dispatch does, without keys that move: of the schedules that group a whole batch
/// it reads and writes least.
template <class Dispatch = explicit_serialization>
struct bucket_then_dispatch {
  template <class Policy, class Count, class Ids, class... Shaders, class Workspace>
  void operator()(Policy const& exec, Count n, Ids ids, shader_table<Shaders...> const& shaders,
                  Workspace& scratch) const {
    Dispatch{}(exec, group_by_bucket<sizeof...(Shaders)>(exec, n, ids, scratch), shaders, scratch);
  }
};

}  // namespace deferred_shade
