// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thrust/system/cpp/execution_policy.h>

#include <algorithm>
#include <deferred_shade/deferred_shade.hpp>
#include <limits>
#include <numeric>
#include <type_traits>
#include <vector>

#include "app/render.hpp"
#include "shading/path.hpp"

namespace path_tracer {

/// A shader that does nothing: what a schedule takes with it, it takes to group. The compiler has
/// to bring it its requests all the same; it would leave out a sort that nobody looks at.
struct empty_shader {
  PT_HD void operator()(deferred_shade::request_index i) const { asm volatile("" : : "r"(i)); }
};

/// A shader that writes down which requests ran, in order. For one thread.
struct recording_shader {
  std::vector<deferred_shade::request_index>* order;
  void operator()(deferred_shade::request_index i) const { order->push_back(i); }
};

/// A table of the path tracer's size of the same shader.
template <class Shader, std::size_t... Ids>
auto uniform_table(Shader const& s, std::index_sequence<Ids...>) {
  return deferred_shade::shader_table{((void)Ids, s)...};
}
template <class Shader>
auto uniform_table(Shader const& s) {
  return uniform_table(s, std::make_index_sequence<shader_count>());
}

/// Whether lanes stay with their requests, idle ones among them: the schedules without a grouping.
template <class Schedule>
inline constexpr bool keeps_order =
    std::is_same_v<Schedule, deferred_shade::implicit_serialization> ||
    std::is_same_v<Schedule, deferred_shade::explicit_serialization>;

/// A schedule whose order on one thread of a CPU is the order of the grouping. A switch over a
/// grouping has each thread take shares of every shader.
template <class Schedule>
Schedule in_grouped_order(Schedule const& schedule) {
  return schedule;
}
template <template <class> class Schedule>
Schedule<deferred_shade::explicit_serialization> in_grouped_order(
    Schedule<deferred_shade::implicit_serialization> const&) {
  return {};
}

/// The requests of a batch in the order in which lanes take them: that of one thread of a CPU,
/// which is also that of a GPU but for the end of a shader's requests, where a GPU starts a fresh
/// warp.
template <class Schedule>
std::vector<deferred_shade::request_index> execution_order(Schedule const& schedule,
                                                           std::uint32_t paths,
                                                           std::uint8_t const* ids) {
  std::vector<deferred_shade::request_index> order;
  order.reserve(paths);
  if constexpr (keeps_order<Schedule>) {
    order.resize(paths);
    std::iota(order.begin(), order.end(), 0u);
  } else {
    deferred_shade::workspace scratch{thrust::cpp::par};
    deferred_shade::shade(thrust::cpp::par, in_grouped_order(schedule), paths, ids,
                          uniform_table(recording_shader{&order}), scratch);
  }
  return order;
}

/// Fills the efficiencies and the requests by shader of `b` from one batch, whose ids are given in
/// host memory: groups of 32 lanes, all shaders at one cost. A pixel with several samples in the
/// batch shows the group of the first.
template <class Schedule>
void measure_efficiency(Schedule const& schedule, std::vector<std::uint8_t> const& batch_ids,
                        basic_batch const& batch, bounce& b) {
  auto const order =
      execution_order(schedule, static_cast<std::uint32_t>(batch_ids.size()), batch_ids.data());
  std::vector<std::uint8_t> ids(order.size());
  std::transform(order.begin(), order.end(), ids.begin(), [&](auto i) { return batch_ids[i]; });
  b.shader_requests =
      deferred_shade::count_occurrences(thrust::cpp::par, order.size(), ids.data(), shader_count)
          .requests;
  b.shader_requests.resize(shader_count);  // without the paths that have ended
  std::vector<double> const costs(shader_count, 1.0);
  deferred_shade::efficiency_model const model{costs.data(), shader_count};
  auto const count = static_cast<deferred_shade::request_index>(order.size());
  b.efficiency =
      deferred_shade::heterogeneous_efficiency(thrust::cpp::par, count, ids.data(), model);
  std::vector<float> groups((order.size() + model.width - 1) / model.width);
  deferred_shade::group_efficiency(thrust::cpp::par, count, ids.data(), model, groups.data());
  b.pixel_efficiency.assign(batch.pixels, std::numeric_limits<float>::quiet_NaN());
  for (std::size_t k = 0; k < order.size(); ++k)
    if (order[k] < batch.pixels && ids[k] < shader_count)
      b.pixel_efficiency[batch.pixel(order[k])] = groups[k / model.width];
}

}  // namespace path_tracer
