// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deferred_shade/deferred_shade.hpp>

namespace test {

/// Calls `f` with every schedule of the library.
template <class Function>
void for_each_schedule(Function const& f) {
  deferred_shade::for_each_schedule([&](char const*, auto const& schedule) { f(schedule); });
}

}  // namespace test
