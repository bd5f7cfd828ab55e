// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdio>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/statistics.hpp>
#include <vector>

/// Runs `Schedule`, and prints the efficiency of the batch and the time of shading. For CPU
/// policies, which return when the batch is shaded.
template <class Schedule>
struct reported {
  template <class Policy, class Ids, class... Shaders, class Workspace>
  void operator()(Policy const& exec, deferred_shade::request_index n, Ids ids,
                  deferred_shade::shader_table<Shaders...> const& shaders,
                  Workspace& scratch) const {
    std::vector<double> const costs(sizeof...(Shaders), 1.0);  // better: what each shader takes
    deferred_shade::efficiency_model const eight_lanes{costs.data(), shaders.size(), 8};
    double const efficiency = deferred_shade::heterogeneous_efficiency(exec, n, ids, eight_lanes);
    auto const start = std::chrono::steady_clock::now();
    Schedule{}(exec, n, ids, shaders, scratch);
    std::chrono::duration<double, std::milli> const time = std::chrono::steady_clock::now() - start;
    std::fprintf(stderr, "%u requests, efficiency %.4f, %.3f ms\n", n, efficiency, time.count());
  }
};
