// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thrust/iterator/transform_iterator.h>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <deferred_shade/shade.hpp>
#include <deferred_shade/shader_table.hpp>
#include <utility>
#include <vector>

#include "../catch.hpp"
#include "backends.hpp"
#include "random_ids.hpp"

namespace test {

namespace ds = deferred_shade;

/// What every schedule must leave in memory: one entry per request.
struct trace {
  explicit trace(std::size_t n) : value(n, -1.0F), runs(n, 0) {}
  std::vector<float> value;         ///< the shader's arithmetic on the request
  std::vector<std::uint32_t> runs;  ///< how often the request ran
};

/// The arithmetic of shader `id`: no two shaders or requests agree, and rounding shows.
inline float arithmetic(std::uint32_t id, ds::request_index i) {
  float x = 1.0F + 0.37F * static_cast<float>(id) + 1e-6F * static_cast<float>(i);
  for (int step = 0; step < 3; ++step) x = x * 1.0001F + 1.0F / x;
  return std::sqrt(x);
}

struct tracing_shader {
  std::uint32_t id;
  float* value;
  std::uint32_t* runs;
  void operator()(ds::request_index i) const {
    value[i] = arithmetic(id, i);
    ++runs[i];
  }
};

template <std::uint32_t... Ids>
auto tracing_table(trace& t, std::integer_sequence<std::uint32_t, Ids...>) {
  return ds::shader_table{tracing_shader{Ids, t.value.data(), t.runs.data()}...};
}

/// Runs `schedule` over `n` requests and compares with a plain loop, bit by bit.
template <std::uint32_t Shaders, class Policy, class Schedule, class Ids, class Workspace>
void check_against_loop(Policy const& exec, Schedule const& schedule, std::uint32_t n, Ids ids,
                        Workspace& scratch) {
  trace expected(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    auto const id = static_cast<std::uint32_t>(ids[static_cast<std::ptrdiff_t>(i)]);
    if (id >= Shaders) continue;
    expected.value[i] = arithmetic(id, i);
    ++expected.runs[i];
  }
  trace actual(n);
  ds::shade(exec, schedule, n, ids,
            tracing_table(actual, std::make_integer_sequence<std::uint32_t, Shaders>()), scratch);
  CHECK(actual.runs == expected.runs);
  bool const same_bits =
      n == 0 || std::memcmp(actual.value.data(), expected.value.data(), n * sizeof(float)) == 0;
  CHECK(same_bits);
}

/// All layouts for one type of id.
template <class Id, std::uint32_t Shaders, class Policy, class Schedule, class Workspace>
void check_id_type(Policy const& exec, Schedule const& schedule, Workspace& scratch,
                   std::vector<std::uint32_t> const& sizes) {
  for (std::uint32_t const n : sizes) {
    for (layout const how : layouts) {
      std::uint32_t const seed = run_seed() + n + static_cast<std::uint32_t>(how);
      CAPTURE(n, static_cast<int>(how), seed, Shaders, sizeof(Id));
      std::vector<Id> const ids = make_ids<Id>(how, n, Shaders, seed);
      check_against_loop<Shaders>(exec, schedule, n, ids.data(), scratch);
    }
  }
}

/// What `shade` promises of any schedule: every request exactly once, through its own shader, with
/// the same bits as a plain loop, for every type of id, table and size.
template <class Backend, class Schedule>
void check_schedule(Schedule const& schedule = {}) {
  auto const exec = Backend::policy();
  ds::workspace scratch{exec};
  check_id_type<std::uint8_t, 5>(exec, schedule, scratch, edge_sizes());
  check_id_type<std::int8_t, 5>(exec, schedule, scratch, some_sizes());
  check_id_type<std::uint16_t, 5>(exec, schedule, scratch, some_sizes());
  check_id_type<std::int32_t, 9>(exec, schedule, scratch, edge_sizes());
  check_id_type<std::uint32_t, 5>(exec, schedule, scratch, some_sizes());
  check_id_type<std::uint8_t, 1>(exec, schedule, scratch, some_sizes());

  std::uint32_t const seed = run_seed();
  CAPTURE(seed);
  std::uint32_t const n = 20011;
  auto const words = make_ids<std::uint16_t>(layout::random, n, 7, seed);

  // The renderer's own hit records, through an iterator.
  struct hit {
    float distance;
    std::int16_t material;
  };
  std::vector<hit> hits(n);
  for (std::uint32_t i = 0; i < n; ++i) hits[i] = {0.5F, static_cast<std::int16_t>(words[i] % 7)};
  auto const materials = thrust::make_transform_iterator(
      hits.data(), [](hit const& h) { return static_cast<std::int16_t>(h.material - 1); });
  check_against_loop<5>(exec, schedule, n, materials, scratch);
}

/// On one worker: the requests of a shader run in the order of their indices.
template <class Schedule>
void check_stable(Schedule const& schedule = {}) {
  std::uint32_t const seed = run_seed();
  CAPTURE(seed);
  std::uint32_t const n = 50021;
  auto const ids = make_ids<std::uint8_t>(layout::random, n, 3, seed);
  std::vector<std::uint32_t> order[3];
  auto const append = [&order](std::uint32_t id) {
    return [list = &order[id]](ds::request_index i) { list->push_back(i); };
  };
  ds::workspace scratch{thrust::cpp::par};
  ds::shade(thrust::cpp::par, schedule, n, ids.data(),
            ds::shader_table{append(0), append(1), append(2)}, scratch);
  std::vector<std::uint32_t> expected[3];
  for (std::uint32_t i = 0; i < n; ++i) {
    if (ids[i] < 3) expected[ids[i]].push_back(i);
  }
  for (std::uint32_t id = 0; id < 3; ++id) CHECK(order[id] == expected[id]);
}

/// A dispatch runs a grouping: every request of a segment through the segment's shader, nothing for
/// an empty segment, and nothing that stands behind the last one.
template <class Backend, class Dispatch>
void check_dispatch(Dispatch const& dispatch = {}) {
  ds::request_index const permutation[] = {4, 0, 3, 1, 2};
  ds::request_index const offsets[] = {0, 0, 2, 2, 4, 4};
  int seen[5] = {-1, -1, -1, -1, -1};
  auto const note = [&seen](int id) { return [&seen, id](ds::request_index i) { seen[i] = id; }; };
  dispatch(Backend::policy(), ds::grouping{permutation, offsets},
           ds::shader_table{note(0), note(1), note(2), note(3), note(4)});
  int const expected[] = {1, 3, -1, 3, 1};
  for (int i = 0; i < 5; ++i) CHECK(seen[i] == expected[i]);
}

}  // namespace test
