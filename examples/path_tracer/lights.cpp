// SPDX-License-Identifier: Apache-2.0
#include "lights.hpp"

#include <algorithm>

namespace path_tracer {
namespace {

double area(triangle const& t) {
  glm::dvec3 const a(t.position[0]), b(t.position[1]), c(t.position[2]);
  return 0.5 * glm::length(glm::cross(b - a, c - a));
}

/// Vose's construction (1991) of the alias table of these powers; their sum is positive.
void build_alias_table(std::vector<light_entry>& entries, std::vector<double> power, double sum) {
  auto const count = static_cast<double>(power.size());
  std::vector<std::uint32_t> small, large;
  for (std::uint32_t i = 0; i < power.size(); ++i) {
    entries[i].probability = static_cast<float>(power[i] / sum);
    entries[i].keep = 1;
    entries[i].alias = i;
    power[i] *= count / sum;
    (power[i] < 1 ? small : large).push_back(i);
  }
  while (!small.empty() && !large.empty()) {
    std::uint32_t const s = small.back(), l = large.back();
    small.pop_back();
    entries[s].keep = static_cast<float>(power[s]);
    entries[s].alias = l;
    power[l] -= 1 - power[s];
    if (power[l] >= 1) continue;
    large.pop_back();
    small.push_back(l);
  }
}

}  // namespace

light_list::light_list(scene const& s) {
  vec3 lower{0}, upper{0};
  if (!s.triangles.empty()) lower = upper = s.triangles[0].position[0];
  std::vector<double> power;
  for (std::uint32_t i = 0; i < s.triangles.size(); ++i) {
    triangle const& t = s.triangles[i];
    for (vec3 const& p : t.position) {
      lower = glm::min(lower, p);
      upper = glm::max(upper, p);
    }
    material const& m = s.materials[t.material];
    double const w = m.kind == shader_of<effects::emitters> ? double{radiosity(m)} * area(t) : 0;
    if (!(w > 0)) continue;
    entries_.push_back({1, 0, 0, i});
    power.push_back(w);
  }
  triangle_count_ = static_cast<std::uint32_t>(entries_.size());
  double const radius = 0.5 * glm::length(glm::dvec3(upper) - glm::dvec3(lower));
  far_away_ = static_cast<float>(4 * radius + 1);
  for (std::uint32_t i = 0; i < s.lights.size(); ++i) {
    punctual_light const& light = s.lights[i];
    double const share = light.kind == punctual_light::type::point ? 4
                         : light.kind == punctual_light::type::spot
                             ? 2 * (1 - double{light.cos_outer})
                             : radius * radius;
    double const w = double{pi} * double{luminance(light.intensity)} * share;
    if (!(w > 0)) continue;
    entries_.push_back({1, 0, 0, i});
    power.push_back(w);
  }
  double sum = 0;
  for (double const w : power) sum += w;
  if (entries_.empty()) return;
  per_power_ = static_cast<float>(1 / sum);
  build_alias_table(entries_, power, sum);
}

light_view light_list::view(punctual_light const* punctual) const {
  return {entries_.data(), static_cast<std::uint32_t>(entries_.size()),
          triangle_count_, punctual,
          per_power_,      far_away_};
}

}  // namespace path_tracer
