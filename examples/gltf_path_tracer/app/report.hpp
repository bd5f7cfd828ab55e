// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/options.hpp"
#include "app/render.hpp"

namespace path_tracer {

/// One rendering and the schedule that made it.
struct run {
  std::string schedule;
  render_result result;
  std::size_t repetition = 1;  ///< counts the renderings with this schedule
};

/// Throws std::runtime_error that names `b`'s schedule and the first pixel at which the two
/// pictures differ in any bit.
void require_identical(run const& a, run const& b);

/// All settings and measurements as JSON.
std::string json_report(options const& o, std::size_t triangle_count, std::vector<run> const& runs);

}  // namespace path_tracer
