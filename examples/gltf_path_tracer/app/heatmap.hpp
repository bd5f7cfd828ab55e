// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/report.hpp"
#include "io/image.hpp"

namespace path_tracer {

/// Linear RGB of an efficiency in [0, 1]: dark violet over red and orange to pale yellow. Lightness
/// in Oklab rises in proportion to the value: equal steps look equal, in print without colour too.
rgb heat_color(float efficiency);

/// The heat maps of several renderings in one labelled picture: a row for each schedule, a column
/// for each of the first bounces, and a colour scale. A pixel has the colour of the efficiency of
/// its group of 32 requests.
class heatmap_sheet {
 public:
  static constexpr std::size_t most_columns = 16;
  /// Pictures that are larger are shown by every second pixel across and down, or third, and so on.
  static constexpr std::uint32_t largest_side = 320;

  explicit heatmap_sheet(render_settings const& settings);

  /// Takes the heat maps of a run that has statistics. Throws std::runtime_error if one of them has
  /// another size than the picture.
  void add(run const& r);

  image draw() const;

 private:
  struct heatmap {
    std::vector<float> efficiency;  ///< of the pixels shown
    double mean;                    ///< of all of the bounce's requests
  };
  struct row {
    std::string schedule;
    std::vector<heatmap> bounces;
  };

  image colored(heatmap const& map) const;
  std::vector<std::string> notes() const;

  std::uint32_t width_, height_, step_;
  bool whole_;  ///< whether a heat map covers the picture
  std::vector<row> rows_;
  std::size_t most_bounces_ = 0;
};

}  // namespace path_tracer
