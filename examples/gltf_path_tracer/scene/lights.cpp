// SPDX-License-Identifier: Apache-2.0
#include "scene/lights.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace path_tracer {
namespace {

double area(triangle const& t) {
  glm::dvec3 const a(t.position[0]), b(t.position[1]), c(t.position[2]);
  return 0.5 * glm::length(glm::cross(b - a, c - a));
}

/// Vose's construction (1991) of the alias table of these powers; their sum is positive. Remainders
/// that differ from the mean only by rounding count as the mean. Otherwise float and double would
/// pick different lights for the same random numbers.
void build_alias_table(std::vector<light_entry>& entries, std::vector<double> power, double sum) {
  auto const count = static_cast<double>(power.size());
  double const mean = 1 - 1e-6;
  std::vector<std::uint32_t> small, large;
  for (std::uint32_t i = 0; i < power.size(); ++i) {
    entries[i].probability = static_cast<real>(power[i] / sum);
    entries[i].keep = 1;
    entries[i].alias = i;
    power[i] *= count / sum;
    (power[i] < mean ? small : large).push_back(i);
  }
  while (!small.empty() && !large.empty()) {
    std::uint32_t const s = small.back(), l = large.back();
    small.pop_back();
    entries[s].keep = static_cast<real>(power[s]);
    entries[s].alias = l;
    power[l] -= 1 - power[s];
    if (power[l] >= mean) continue;
    large.pop_back();
    small.push_back(l);
  }
}

}  // namespace

light_list::light_list(scene const& s, estimator how) : how_(how) {
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
    if (how == estimator::bsdf || !effects::emitters::in_material(m)) continue;
    double const w = double{radiosity(m)} * area(t);
    if (!(w > 0)) continue;
    entries_.push_back({1, 0, 0, i});
    power.push_back(w);
  }
  triangle_count_ = static_cast<std::uint32_t>(entries_.size());
  for (triangle_motion const& m : s.motion)
    for (vec3 const& p : m.position) {
      lower = glm::min(lower, p);
      upper = glm::max(upper, p);
    }
  double const radius = 0.5 * glm::length(glm::dvec3(upper) - glm::dvec3(lower));
  far_away_ = static_cast<real>(4 * radius + 1);
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
  sky_entry_ = static_cast<std::uint32_t>(entries_.size());
  double const sky = how == estimator::bsdf ? 0 : list_sky(s);
  if (double const w = pi * radius * radius * sky; w > 0) {
    entries_.push_back({1, 0, 0, 0});
    power.push_back(w);
  }
  double sum = 0;
  for (double const w : power) sum += w;
  if (entries_.empty()) return;
  root_per_power_ = static_cast<real>(std::sqrt(1 / sum));
  build_alias_table(entries_, power, sum);
}

double light_list::list_sky(scene const& s) {
  environment_map const& sky = s.sky;
  std::vector<double> power(sky.texels.size());
  // The mean of the picture over a texel, between the centres of which it is bilinear.
  auto const mean = [&](std::size_t k) {
    std::size_t const w = sky.width, h = sky.height, x = k % w, y = k / w;
    std::size_t const columns[] = {(x + w - 1) % w, x, (x + 1) % w};
    std::size_t const rows[] = {y > 0 ? y - 1 : 0, y, std::min(y + 1, h - 1)};
    double const weights[] = {0.125, 0.75, 0.125};
    double sum = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        sum += weights[i] * weights[j] * double{luminance(sky.texels[rows[i] * w + columns[j]])};
    return sum;
  };
  double sum = 0;
  for (std::size_t k = 0; k < power.size(); ++k) {
    double const row = static_cast<double>(k / sky.width) + 0.5;
    double const sine = std::sin(double{pi} * row / static_cast<double>(sky.height));
    power[k] = mean(k) * double{s.environment_intensity} * sine;
    sum += power[k];
  }
  if (!(sum > 0)) return 0;
  for (std::uint32_t k = 0; k < power.size(); ++k) sky_entries_.push_back({1, 0, 0, k});
  auto const texels = static_cast<double>(power.size());
  build_alias_table(sky_entries_, std::move(power), sum);
  return sum * 2 * double{pi} * double{pi} / texels;
}

light_view light_list::view(scene const& s) const {
  light_view result{};
  result.entries = entries_.data();
  result.count = static_cast<std::uint32_t>(entries_.size());
  result.triangle_count = triangle_count_;
  result.sky_entry = sky_entry_;
  result.triangles = s.triangles.data();
  result.materials = s.materials.data();
  result.motion = s.motion.empty() ? nullptr : s.motion.data();
  result.punctual = s.lights.data();
  result.sky = {s.sky.texels.data(), s.sky.width, s.sky.height, s.environment_intensity,
                s.environment_rotation};
  result.sky_entries = sky_entries_.data();
  result.root_per_power = root_per_power_;
  result.far_away = far_away_;
  result.how = how_;
  return result;
}

}  // namespace path_tracer
