// SPDX-License-Identifier: Apache-2.0
#include "app/report.hpp"

#include <cstring>
#include <deferred_shade/version.hpp>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "effects/scene_effects.hpp"

namespace path_tracer {
namespace {

/// Requests by the names of the shaders that have any.
nlohmann::ordered_json requests_by_shader(bounce const& b) {
  auto const names = shader_names();
  auto result = nlohmann::ordered_json::object();
  for (std::size_t k = 0; k < b.shader_requests.size(); ++k)
    if (b.shader_requests[k] > 0) result[std::string(names.at(k))] = b.shader_requests[k];
  return result;
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
                         {"repetition", r.repetition},
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
                         {"exposure", o.exposure},
                         {"repeat", o.repeat},
                         {"effects", o.effects},
                         {"code_for", join_names(effects_of_variant(s.variant))}}},
                       {"schedules", schedules}};
  // A name that is not UTF-8 is written with replacement characters.
  return report.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

}  // namespace path_tracer
