// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <cstdlib>
#include <deferred_shade/deferred_shade.hpp>

#include "examples/05_renderer/reported.hpp"
#include "test/support/every_schedule.hpp"

/// The schedule of the library whose number, from 0, the environment variable SCHEDULE has,
/// reported. Ends the program with 2 if there is none.
struct numbered_schedule {
  template <class Policy, class Ids, class... Shaders, class Workspace>
  void operator()(Policy const& exec, deferred_shade::request_index n, Ids ids,
                  deferred_shade::shader_table<Shaders...> const& shaders,
                  Workspace& scratch) const {
    char const* const wanted = std::getenv("SCHEDULE");
    long left = wanted == nullptr ? -1 : std::strtol(wanted, nullptr, 10);
    bool found = false;
    test::for_each_schedule([&](auto schedule) {
      if (left-- != 0) return;
      found = true;
      reported<decltype(schedule)>{}(exec, n, ids, shaders, scratch);
    });
    if (found) return;
    std::fprintf(stderr, "SCHEDULE is the number of no schedule\n");
    std::exit(2);
  }
};
