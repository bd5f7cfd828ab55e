// SPDX-License-Identifier: Apache-2.0
// A workspace by itself does not know what schedules take.
// error: reserve and bytes_for ask every schedule what it takes; include
// <deferred_shade/schedule.hpp>
// errors: 3
#include <deferred_shade/workspace.hpp>
#ifdef RIGHT
#include <deferred_shade/schedule.hpp>
#endif

void f(deferred_shade::workspace<>& scratch) { scratch.reserve(10, 2); }
