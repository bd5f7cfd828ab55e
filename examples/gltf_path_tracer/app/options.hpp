// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <ostream>
#include <stdexcept>
#include <string>

#include "app/render.hpp"

namespace path_tracer {

/// The command line is wrong by itself, whatever files there are: exit code 2.
struct usage_error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct options {
  std::string scene;
  std::string output = "render.png";
  render_settings settings;      ///< `schedule` may also be "all"
  std::string report;            ///< file for the JSON report; empty: none
  std::string heatmap_folder;    ///< empty: no heat maps
  std::string trace;             ///< file for the timeline; empty: none
  std::string effects = "auto";  ///< or "all", or names
  bool explain = false;
  bool quiet = false;
};

/// Reads the command line. Returns nothing when all it asks for is --help or --version, which then
/// stands in `out`. Throws usage_error with one line.
std::optional<options> parse_options(int argc, char const* const* argv, std::ostream& out);

}  // namespace path_tracer
