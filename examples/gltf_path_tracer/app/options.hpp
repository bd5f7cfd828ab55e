// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/render.hpp"

namespace path_tracer {

/// The command line is wrong by itself, whatever files there are: exit code 2.
struct usage_error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct options {
  std::string scene;
  std::string output = "render.png";
  float exposure = 0;                  ///< stops by which a PNG is brighter
  render_settings settings;            ///< all except `schedule`
  std::vector<std::string> schedules;  ///< to render with, each once
  unsigned repeat = 1;                 ///< renderings with each schedule
  std::string report;                  ///< file for the JSON report; empty: none
  std::string heatmap_sheet;           ///< file for the heat maps; empty: none
  std::string shader_ids;              ///< file for the picture of shader ids; empty: none
  std::string trace;                   ///< file for the timeline; empty: none
  std::string effects = "auto";        ///< or "all", or names
  bool explain = false;
  bool quiet = false;

  /// Whether there is a table to print.
  bool compares() const { return schedules.size() > 1 || repeat > 1; }
};

/// Reads the command line. Returns nothing when all it asks for is --help or --version, which then
/// stands in `out`. Throws usage_error with one line.
std::optional<options> parse_options(int argc, char const* const* argv, std::ostream& out);

}  // namespace path_tracer
