// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thrust/iterator/transform_iterator.h>
#include <cmath>
#include <cstdint>
#include <deferred_shade/config.hpp>
#include <deferred_shade/shade.hpp>
#include <deferred_shade/shader_table.hpp>
#include <utility>
#include <vector>

#include "backends.hpp"
#include "catch.hpp"
#include "compare.hpp"
#include "random_ids.hpp"

namespace test {

namespace ds = deferred_shade;

/// What every schedule must leave in memory: one entry per request.
template <class Backend>
struct trace {
  explicit trace(std::size_t n) : value(n, -1.0F), runs(n, 0) {}
  typename Backend::template vector<float> value;         ///< the shader's arithmetic
  typename Backend::template vector<std::uint32_t> runs;  ///< how often the request ran
};

/// The arithmetic of shader `id`: no two shaders or requests agree, and rounding shows.
DEFERRED_SHADE_HOST_DEVICE inline float arithmetic(std::uint32_t id, ds::request_index i) {
  float x = 1.0F + 0.37F * static_cast<float>(id) + 1e-6F * static_cast<float>(i);
  for (int step = 0; step < 3; ++step) x = x * 1.0001F + 1.0F / x;
  return std::sqrt(x);
}

struct tracing_shader {
  std::uint32_t id;
  float* value;
  std::uint32_t* runs;
  DEFERRED_SHADE_HOST_DEVICE void operator()(ds::request_index i) const {
    value[i] = arithmetic(id, i);
    ++runs[i];
  }
};

/// Whether a table has code for `id`: for all of its shaders if `Kept` is empty, else for those.
template <std::uint32_t... Kept>
constexpr bool is_kept(std::uint32_t id) {
  return sizeof...(Kept) == 0 || ((id == Kept) || ...);
}

/// The table of `Shaders` shaders that `make` makes of their ids, or of no_shader where `Kept` has
/// none. A large one that has code for few takes a compiler seconds, where all take a minute.
template <std::uint32_t... Kept, class Make, std::uint32_t... Ids>
auto table_of(Make const& make, std::integer_sequence<std::uint32_t, Ids...>) {
  auto const slot = [&make](auto id) {
    if constexpr (is_kept<Kept...>(id)) {
      return make(id);
    } else {
      return ds::no_shader{};
    }
  };
  return ds::shader_table{slot(std::integral_constant<std::uint32_t, Ids>{})...};
}

/// The table of `Shaders` shaders that write to a trace; see table_of for `Kept`.
template <std::uint32_t Shaders, std::uint32_t... Kept>
auto tracing_table(float* value, std::uint32_t* runs) {
  return table_of<Kept...>(
      [=](std::uint32_t id) {
        return tracing_shader{id, value, runs};
      },
      std::make_integer_sequence<std::uint32_t, Shaders>());
}

/// What a plain loop over the first `count` of `n` requests leaves; see table_of for `Kept`.
template <std::uint32_t Shaders, std::uint32_t... Kept, class Ids>
trace<cpp> traced_by_loop(std::uint32_t n, Ids ids, std::uint32_t count) {
  trace<cpp> expected(n);
  for (std::uint32_t i = 0; i < count; ++i) {
    auto const id = static_cast<std::uint32_t>(ids[static_cast<std::ptrdiff_t>(i)]);
    if (id >= Shaders || !is_kept<Kept...>(id)) continue;
    expected.value[i] = arithmetic(id, i);
    ++expected.runs[i];
  }
  return expected;
}

/// Whether two traces agree in every bit.
template <class A, class B>
void check_same(A const& actual, B const& expected) {
  std::size_t const n = expected.runs.size();
  CHECK(first_difference(actual.runs, expected.runs) == n);
  CHECK(first_difference(actual.value, expected.value) == n);
}

/// Runs `schedule` over `n` requests and compares with a plain loop, bit by bit; see table_of for
/// `Kept`.
template <class Backend, std::uint32_t Shaders, std::uint32_t... Kept, class Schedule, class Ids,
          class Workspace>
void check_against_loop(Schedule const& schedule, std::uint32_t n, Ids ids, Workspace& scratch) {
  trace<Backend> actual(n);
  ds::shade(Backend::policy(), schedule, n, ids,
            tracing_table<Shaders, Kept...>(actual.value.data(), actual.runs.data()), scratch);
  Backend::wait();
  check_same(actual, traced_by_loop<Shaders, Kept...>(n, ids, n));
}

/// All layouts for one type of id.
template <class Backend, class Id, std::uint32_t Shaders, class Schedule, class Workspace>
void check_id_type(Schedule const& schedule, Workspace& scratch,
                   std::vector<std::uint32_t> const& sizes) {
  for (std::uint32_t const n : sizes) {
    for (layout const how : layouts) {
      std::uint32_t const seed = run_seed() + n + static_cast<std::uint32_t>(how);
      CAPTURE(n, static_cast<int>(how), seed, Shaders, sizeof(Id));
      auto const ids = on<Backend>(make_ids<Id>(how, n, Shaders, seed));
      check_against_loop<Backend, Shaders>(schedule, n, ids.data(), scratch);
    }
  }
}

/// A renderer's own hit record, and the shader id that an iterator makes of it.
struct hit_record {
  float distance;
  std::int16_t material;
};
struct material_before {
  DEFERRED_SHADE_HOST_DEVICE std::int16_t operator()(hit_record const& h) const {
    return static_cast<std::int16_t>(h.material - 1);
  }
};

/// What `shade` promises of any schedule: every request exactly once, through its own shader, with
/// the same bits as a plain loop, for every type of id, table and size.
template <class Backend, class Schedule>
void check_schedule(Schedule const& schedule = {}) {
  ds::workspace scratch{Backend::policy()};
  check_id_type<Backend, std::uint8_t, 5>(schedule, scratch, edge_sizes<Backend>());
  check_id_type<Backend, std::int8_t, 5>(schedule, scratch, some_sizes());
  check_id_type<Backend, std::uint16_t, 5>(schedule, scratch, some_sizes());
  check_id_type<Backend, std::int32_t, 9>(schedule, scratch, edge_sizes<Backend>());
  check_id_type<Backend, std::uint32_t, 5>(schedule, scratch, some_sizes());
  check_id_type<Backend, std::uint8_t, 1>(schedule, scratch, some_sizes());

  std::uint32_t const seed = run_seed();
  CAPTURE(seed);
  std::uint32_t const n = 20011;

  // Ids that begin anywhere in memory, not where a wide load would want them.
  auto const bytes = on<Backend>(make_ids<std::uint8_t>(layout::random, n + 15, 5, seed));
  for (std::ptrdiff_t const first : {1, 2, 7, 15}) {
    CAPTURE(first);
    check_against_loop<Backend, 5>(schedule, n, bytes.data() + first, scratch);
  }

  // The renderer's own hit records, through an iterator.
  auto const words = make_ids<std::uint16_t>(layout::random, n, 7, seed);
  typename Backend::template vector<hit_record> hits(n);
  for (std::uint32_t i = 0; i < n; ++i) hits[i] = {0.5F, static_cast<std::int16_t>(words[i] % 7)};
  auto const materials = thrust::make_transform_iterator(
      static_cast<hit_record const*>(hits.data()), material_before{});
  check_against_loop<Backend, 5>(schedule, n, materials, scratch);
}

/// On one worker: the requests of a shader run in the order of their indices.
template <class Schedule>
void check_stable(Schedule const& schedule = {}) {
  std::uint32_t const seed = run_seed();
  CAPTURE(seed);
  std::uint32_t const n = 200021;  // more than a dozen blocks of a CPU
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

struct noting_shader {
  int id;
  int* seen;
  DEFERRED_SHADE_HOST_DEVICE void operator()(ds::request_index i) const { seen[i] = id; }
};

/// A dispatch runs a grouping: every request of a segment through the segment's shader, nothing for
/// an empty segment, and nothing that stands behind the last one.
template <class Backend, class Dispatch>
void check_dispatch(Dispatch const& dispatch = {}) {
  auto const permutation = on<Backend>(std::vector<ds::request_index>{4, 0, 3, 1, 2});
  auto const offsets = on<Backend>(std::vector<ds::request_index>{0, 0, 2, 2, 4, 4});
  auto seen = on<Backend>(std::vector<int>(5, -1));
  auto const note = [&seen](int id) { return noting_shader{id, seen.data()}; };
  dispatch(Backend::policy(), ds::grouping{permutation.data(), offsets.data(), 5},
           ds::shader_table{note(0), note(1), note(2), note(3), note(4)});
  Backend::wait();
  int const expected[] = {1, 3, -1, 3, 1};
  for (std::size_t i = 0; i < 5; ++i) CHECK(seen[i] == expected[i]);
}

}  // namespace test
