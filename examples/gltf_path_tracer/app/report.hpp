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
};

/// Throws std::runtime_error that names `b`'s schedule and the first pixel at which the two
/// pictures differ in any bit.
void require_identical(run const& a, run const& b);

/// A table with one row for each run: schedule, ms to group, to shade and in total, and the
/// heterogeneous efficiency over all of the first bounces, as many as fit.
std::string table(std::vector<run> const& runs);

/// All settings and measurements as JSON.
std::string json_report(options const& o, std::size_t triangle_count, std::vector<run> const& runs);

/// Writes `<folder>/bounce_<n>.png` for each bounce of a run that has statistics, with the schedule
/// before it in the name if `name_schedule`. Colour: the efficiency of each pixel's group, see
/// `heat_color`; dark grey: no request. Throws std::runtime_error.
void write_heatmaps(std::string const& folder, render_settings const& settings, run const& r,
                    bool name_schedule);

/// Linear RGB of an efficiency in [0, 1]: dark violet over red and orange to pale yellow. Lightness
/// in Oklab (Ottosson 2020) rises in proportion to the value, so that equal steps look equal, in
/// print without colour too.
rgb heat_color(float efficiency);

}  // namespace path_tracer
