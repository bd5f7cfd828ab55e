// SPDX-License-Identifier: Apache-2.0
#include "app/report.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <deferred_shade/version.hpp>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "effects/scene_effects.hpp"

namespace path_tracer {
namespace {

constexpr std::size_t bounces_in_table = 6;

/// Requests by the names of the shaders that have any.
nlohmann::ordered_json requests_by_shader(bounce const& b) {
  auto const names = shader_names();
  auto result = nlohmann::ordered_json::object();
  for (std::size_t k = 0; k < b.shader_requests.size(); ++k)
    if (b.shader_requests[k] > 0) result[std::string(names.at(k))] = b.shader_requests[k];
  return result;
}

double sum(std::vector<bounce> const& bounces, double bounce::*member) {
  double total = 0;
  for (bounce const& b : bounces) total += b.*member;
  return total;
}

}  // namespace

void require_identical(run const& a, run const& b) {
  std::vector<rgb> const &p = a.result.pixels, &q = b.result.pixels;
  std::string const pair = "the pictures of schedules " + a.schedule + " and " + b.schedule;
  if (p.size() != q.size()) throw std::runtime_error(pair + " differ in size");
  for (std::size_t i = 0; i < p.size(); ++i)
    if (std::memcmp(&p[i], &q[i], sizeof(rgb)) != 0)
      throw std::runtime_error(pair + " differ, first at pixel " + std::to_string(i) +
                               " from the upper left");
}

std::string table(std::vector<run> const& runs) {
  std::size_t name = 8, columns = 0;
  for (run const& r : runs) {
    name = std::max(name, r.schedule.size());
    columns = std::max(columns, std::min(bounces_in_table, r.result.bounces.size()));
  }
  std::string result;
  char cell[64];
  auto const append = [&](char const* format, auto... values) {
    std::snprintf(cell, sizeof(cell), format, values...);
    result += cell;
  };
  auto const left = [&](std::string const& text) {
    result += text + std::string(name - text.size(), ' ');
  };
  left("");
  append("%35s%s\n", "", columns > 0 ? "  efficiency at bounce" : "");
  left("schedule");
  append("  %9s  %9s  %9s ", "group ms", "shade ms", "total ms");
  for (std::size_t i = 0; i < columns; ++i) append("  %6zu", i + 1);
  result += "\n";
  for (run const& r : runs) {
    std::vector<bounce> const& b = r.result.bounces;
    left(r.schedule);
    append("  %9.1f  %9.1f  %9.1f ", sum(b, &bounce::group_ms), sum(b, &bounce::shade_ms),
           sum(b, &bounce::total_ms));
    for (std::size_t i = 0; i < std::min(columns, b.size()); ++i)
      append("  %4.0f %%", 100 * b[i].efficiency);
    result += "\n";
  }
  return result;
}

std::string json_report(options const& o, std::size_t triangle_count,
                        std::vector<run> const& runs) {
  using json = nlohmann::ordered_json;
  render_settings const& s = o.settings;
  json schedules = json::array();
  for (run const& r : runs) {
    json bounces = json::array();
    for (bounce const& b : r.result.bounces)
      bounces.push_back({{"requests", b.requests},
                         {"group_ms", b.group_ms},
                         {"shade_ms", b.shade_ms},
                         {"total_ms", b.total_ms},
                         {"efficiency", b.efficiency},
                         {"first_batch_by_shader", requests_by_shader(b)}});
    schedules.push_back({{"schedule", r.schedule},
                         {"seconds", r.result.seconds},
                         {"rays", r.result.rays},
                         {"discarded_samples", r.result.discarded_samples},
                         {"bounces", bounces}});
  }
  json const report = {{"deferred_shade_version", DEFERRED_SHADE_VERSION},
                       {"scene", o.scene},
                       {"triangles", triangle_count},
                       {"output", o.output},
                       {"settings",
                        {{"width", s.width},
                         {"height", s.height},
                         {"spp", s.samples},
                         {"max_depth", s.max_depth},
                         {"seed", s.seed},
                         {"backend", s.backend},
                         {"threads", s.threads},
                         {"estimator", estimator_names[static_cast<int>(s.accuracy.light)]},
                         {"roulette", s.accuracy.roulette_from},
                         {"sums", summation_names[static_cast<int>(s.accuracy.sums)]},
                         {"octaves", s.accuracy.octaves},
                         {"precision", precision_name},
                         {"storage", storage_name},
                         {"effects", o.effects},
                         {"code_for", join_names(effects_of_variant(s.variant))}}},
                       {"schedules", schedules}};
  // A name that is not UTF-8 is written with replacement characters.
  return report.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

}  // namespace path_tracer
