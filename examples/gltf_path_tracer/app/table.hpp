// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/report.hpp"

namespace path_tracer {

/// A time of several renderings: the median, and how far the slowest is from the fastest, as a part
/// of it.
struct timing {
  double median = 0, spread = 0;
};

/// What the renderings with one schedule took.
struct measurement {
  std::string schedule;
  std::size_t renderings = 0;
  timing group_ms, shading_ms, picture_s;  ///< `shading_ms` is with grouping
  std::vector<double> efficiency;          ///< by bounce
};

/// One for each schedule, in the order of its first occurrence.
std::vector<measurement> measurements_of(std::vector<run> const& runs);

/// A table with a row for each schedule and no line of more than 80 characters: times to group, to
/// shade and for the picture, how many times as fast that is as the switch, and the efficiency of
/// as many bounces as fit. Spreads are in it if a schedule has several renderings.
std::string table(std::vector<run> const& runs);

/// What it comes to, in a sentence each: the gain in shading, the gain in the whole picture, and
/// what grouping takes, and the noise if a schedule has several renderings. Empty for a single
/// schedule.
std::string in_short(std::vector<run> const& runs);

}  // namespace path_tracer
