// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deferred_shade/dispatch/explicit.hpp>
#include <deferred_shade/grouping/compact.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade {

/// One stream compaction per shader, then `Dispatch`, implicit_serialization or
/// explicit_serialization. Schedules 3 and 4 of Hoberock et al., HPG 2009.
///
/// For a table of a few shaders; sort_then_dispatch and bucket_then_dispatch do the same work
/// whatever the number of shaders.
template <class Dispatch = explicit_serialization>
struct compact_then_dispatch {
  template <class Policy, class Count, class Ids, class... Shaders, class Workspace>
  void operator()(Policy const& exec, Count n, Ids ids, shader_table<Shaders...> const& shaders,
                  Workspace& scratch) const {
    Dispatch{}(exec,
               group_by_compaction<sizeof...(Shaders)>(exec, n, ids, scratch, shaders.expected()),
               shaders, scratch);
  }
};

}  // namespace deferred_shade
