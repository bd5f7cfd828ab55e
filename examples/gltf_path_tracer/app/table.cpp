// SPDX-License-Identifier: Apache-2.0
#include "app/table.hpp"

#include <algorithm>
#include <cstdio>

namespace path_tracer {
namespace {

constexpr std::size_t line_width = 80;
constexpr char const* the_switch = "implicit";

template <class... Values>
std::string formatted(char const* format, Values... values) {
  char text[128];
  std::snprintf(text, sizeof(text), format, values...);
  return text;
}

double sum(run const& r, double bounce::*member) {
  double total = 0;
  for (bounce const& b : r.result.bounces) total += b.*member;
  return total;
}

timing timing_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  std::size_t const n = values.size();
  double const median = (values[n / 2] + values[(n - 1) / 2]) / 2;
  return {median, median > 0 ? (values.back() - values.front()) / median : 0};
}

/// The one that the others are compared with.
measurement const& base_of(std::vector<measurement> const& list) {
  auto const found = std::find_if(list.begin(), list.end(),
                                  [](measurement const& m) { return m.schedule == the_switch; });
  return found == list.end() ? list.front() : *found;
}

measurement const& fastest(std::vector<measurement> const& list, timing measurement::*what) {
  return *std::min_element(list.begin(), list.end(),
                           [&](measurement const& a, measurement const& b) {
                             return (a.*what).median < (b.*what).median;
                           });
}

double times_as_fast(measurement const& m, measurement const& base, timing measurement::*what) {
  return (m.*what).median > 0 ? (base.*what).median / (m.*what).median : 1;
}

/// One of the two halves of a row: a time, its spread, and how many times as fast it is.
struct half {
  timing measurement::*what;
  char const *unit, *format;
  bool spreads;

  std::string cells(measurement const& m, std::vector<measurement> const& all) const {
    std::string result = formatted(format, (m.*what).median);
    if (spreads) result += formatted(" %4.0f%%", 100 * (m.*what).spread);
    result += formatted(" %6.2fx", times_as_fast(m, base_of(all), what));
    return result + (&m == &fastest(all, what) ? '*' : ' ');
  }
  std::string heading() const {
    return formatted(" %7s", unit) + (spreads ? "    +-" : "") + "   times ";
  }
};

std::string explanation(std::vector<measurement> const& list) {
  measurement const& base = base_of(list);
  std::size_t const n = list.front().renderings;
  std::string result;
  if (n > 1)
    result = "Medians of " + std::to_string(n) +
             " renderings; +-: slowest minus fastest, in % of the median.\n";
  if (list.size() == 1) return result;
  if (base.schedule == the_switch)
    return result + "times: as fast as the switch (" + the_switch + "). *: the fastest.\n";
  return result + "times: as fast as " + base.schedule + "; the switch (" + the_switch +
         ") was not rendered. *: the fastest.\n";
}

std::string filled(std::string text, std::size_t width) {
  text.resize(std::max(text.size(), width), ' ');
  return text;
}

/// The schedule that is the fastest besides the one that it is compared with.
measurement const& best_other(std::vector<measurement> const& list, timing measurement::*what) {
  measurement const* const base = &base_of(list);
  measurement const* best = nullptr;
  for (measurement const& m : list)
    if (&m != base && (best == nullptr || (m.*what).median < (best->*what).median)) best = &m;
  return *best;
}

/// How far apart renderings are that should take the same time; nothing if there is one of each.
std::string noise_of(std::vector<measurement> const& list) {
  double most = 0;
  for (measurement const& m : list) most = std::max(most, m.picture_s.spread);
  if (list.front().renderings < 2) return "";
  return formatted("Noise: pictures by one schedule differ by up to %.0f %% in time.\n",
                   100 * most);
}

}  // namespace

std::vector<measurement> measurements_of(std::vector<run> const& runs) {
  std::vector<measurement> result;
  for (run const& first : runs) {
    if (std::any_of(result.begin(), result.end(),
                    [&](measurement const& m) { return m.schedule == first.schedule; }))
      continue;
    measurement m{first.schedule, 0, {}, {}, {}, {}};
    for (bounce const& b : first.result.bounces) m.efficiency.push_back(b.efficiency);
    std::vector<double> group, shading, picture;
    for (run const& r : runs) {
      if (r.schedule != first.schedule) continue;
      group.push_back(sum(r, &bounce::group_ms));
      shading.push_back(sum(r, &bounce::total_ms));
      picture.push_back(r.result.seconds);
    }
    m.renderings = group.size();
    m.group_ms = timing_of(group);
    m.shading_ms = timing_of(shading);
    m.picture_s = timing_of(picture);
    result.push_back(std::move(m));
  }
  return result;
}

std::string table(std::vector<run> const& runs) {
  std::vector<measurement> const list = measurements_of(runs);
  bool const spreads = list.front().renderings > 1;
  half const shading{&measurement::shading_ms, "ms", " %7.1f", spreads};
  half const picture{&measurement::picture_s, "s", " %7.3f", spreads};
  std::size_t name = 8, bounces = 0;
  for (measurement const& m : list) {
    name = std::max(name, m.schedule.size());
    bounces = std::max(bounces, m.efficiency.size());
  }
  std::vector<std::string> rows;
  std::size_t width = 0;
  for (measurement const& m : list) {
    rows.push_back(filled(m.schedule, name) + formatted(" %7.1f", m.group_ms.median) +
                   shading.cells(m, list) + picture.cells(m, list));
    width = std::max(width, rows.back().size());
  }
  constexpr std::size_t digits = 4;
  std::size_t const columns =
      std::min(bounces, (line_width - std::min(width, line_width)) / digits);

  std::string const head = filled("schedule", name) + "      ms" + shading.heading();
  std::string above = filled(filled("", name) + "   group     shade", head.size()) + "   picture";
  std::string const title = " % of lanes, by bounce";
  if (columns > 0)
    above = filled(above, width) + (width + title.size() <= line_width ? title : " % lanes");
  std::string result = explanation(list) + above + "\n" + head + picture.heading();
  for (std::size_t k = 0; k < columns; ++k) result += formatted("%4zu", k + 1);
  result += "\n";
  for (std::size_t i = 0; i < list.size(); ++i) {
    result += rows[i];
    for (std::size_t k = 0; k < std::min(columns, list[i].efficiency.size()); ++k)
      result += formatted("%4.0f", 100 * list[i].efficiency[k]);
    result += "\n";
  }
  return result;
}

std::string in_short(std::vector<run> const& runs) {
  std::vector<measurement> const list = measurements_of(runs);
  if (list.size() < 2) return "";
  measurement const& base = base_of(list);
  auto const gain = [&](timing measurement::*what) {
    measurement const& best = best_other(list, what);
    return best.schedule + formatted(" is %.2f times as fast", times_as_fast(best, base, what));
  };
  measurement const& best = best_other(list, &measurement::shading_ms);
  auto const percent = [](double part, double whole) {
    return formatted("%.0f %%", 100 * part / std::max(whole, 1e-9));
  };
  std::string const other = base.schedule == the_switch ? "the switch" : base.schedule;
  return "Shading: " + gain(&measurement::shading_ms) + " as " + other + ".\n" +
         "Whole picture: " + gain(&measurement::picture_s) + " (shading is " +
         percent(1e-3 * base.shading_ms.median, base.picture_s.median) + " of it).\n" +
         "Grouping: " + percent(best.group_ms.median, best.shading_ms.median) +
         " of the shading by " + best.schedule + ".\n" + noise_of(list);
}

}  // namespace path_tracer
