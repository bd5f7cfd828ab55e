// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deferred_shade/dispatch/explicit.hpp>
#include <deferred_shade/grouping/radix_sort.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/types.hpp>

namespace deferred_shade {

/// A radix sort of (id, index) pairs, then `Dispatch`, implicit_serialization or
/// explicit_serialization. Schedules 5 and 6 of Hoberock et al., HPG 2009.
template <class Dispatch = explicit_serialization>
struct sort_then_dispatch {
  template <class Policy, class Count, class Ids, class... Shaders, class Workspace>
  void operator()(Policy const& exec, Count n, Ids ids, shader_table<Shaders...> const& shaders,
                  Workspace& scratch) const {
    Dispatch{}(exec, group_by_radix_sort<sizeof...(Shaders)>(exec, n, ids, scratch), shaders,
               scratch);
  }
};

}  // namespace deferred_shade
