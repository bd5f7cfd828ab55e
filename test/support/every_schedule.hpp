// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deferred_shade/deferred_shade.hpp>

namespace test {

/// Calls `f` with every schedule of the library.
template <class Function>
void for_each_schedule(Function const& f) {
  namespace ds = deferred_shade;
  f(ds::implicit_serialization{});
  f(ds::explicit_serialization{});
  f(ds::compact_then_dispatch<>{});
  f(ds::compact_then_dispatch<ds::implicit_serialization>{});
  f(ds::sort_then_dispatch<>{});
  f(ds::sort_then_dispatch<ds::implicit_serialization>{});
  f(ds::bucket_then_dispatch<>{});
  f(ds::bucket_then_dispatch<ds::implicit_serialization>{});
  f(ds::local_sort_then_dispatch<>{});
  f(ds::local_sort_then_dispatch<ds::bitonic>{});
  f(ds::window_sort_then_dispatch{});
}

}  // namespace test
