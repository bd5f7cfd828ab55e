// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include <deferred_shade/items.hpp>
#include <deferred_shade/shader_table.hpp>
#include <deferred_shade/types.hpp>

namespace test {

namespace ds = deferred_shade;

/// Numbers that look random, for a path through stages.
inline std::uint32_t mixed(std::uint32_t x) {
  x = (x ^ (x >> 16)) * 0x7feb352dU;
  x = (x ^ (x >> 15)) * 0x846ca68bU;
  return x ^ (x >> 16);
}

/// Which stage follows which: `row[k * 8 + r]` is the stage after stage k for a random r,
/// and `first[r]` the first one. Ids at or above `stages` end an item.
struct transitions {
  std::uint32_t stages;
  std::vector<std::uint32_t> row, first;

  /// `ending`: about how many of 8 transitions end an item. If none does, the number of steps does.
  transitions(std::uint32_t count, std::uint32_t ending, std::uint32_t seed)
      : stages(count), row(count * 8), first(8) {
    std::mt19937 engine(seed);
    auto const random = [&engine](std::uint32_t below) {
      return static_cast<std::uint32_t>(engine() % below);
    };
    auto const draw = [&](std::uint32_t ends) {
      if (random(8) >= ends) return random(stages);
      std::uint32_t const outside[] = {stages, stages + random(1000), 0xffffffffU};
      return outside[random(3)];
    };
    for (auto& to : row) to = draw(ending);
    for (auto& to : first) to = draw(ending / 4);
  }
};

/// What one request computes: it depends on the item alone.
struct request_state {
  ds::item_index item = 0;
  std::uint32_t random = 0, steps = 0;
  float value = 0;

  void start(ds::item_index k) {
    *this = {};
    item = k;
    random = mixed(static_cast<std::uint32_t>(k) + 77 * static_cast<std::uint32_t>(k >> 32));
    value = static_cast<float>(random % 1000);
  }
  /// What stage `k` does; returns the number of the transition.
  std::uint32_t step(std::uint32_t k) {
    random = mixed(random + 0x9e3779b9U);
    ++steps;
    value = value * 0.75F + static_cast<float>(k + 1) / static_cast<float>(steps + 2);
    return random % 8;
  }
};

/// The arrays of a renderer: states by slot, results by item.
struct machine_run {
  transitions const* table;
  std::vector<request_state> slots;
  std::vector<float> results;                            ///< by item
  std::vector<std::atomic<std::uint32_t>> begun, ended;  ///< by item
  std::atomic<bool> overlaps{false};                     ///< two requests in one slot at a time
  std::vector<std::atomic<std::uint32_t>> busy;          ///< by slot
  ds::item_index first;
  std::uint32_t most_steps;

  machine_run(transitions const& t, std::size_t items, std::size_t slot_count,
              ds::item_index first_item = 0, std::uint32_t steps = 100)
      : table(&t),
        slots(slot_count),
        results(items),
        begun(items),
        ended(items),
        busy(slot_count),
        first(first_item),
        most_steps(steps) {}

  std::size_t place(ds::item_index k) const { return static_cast<std::size_t>(k - first); }

  ds::shader_id start(ds::request_index slot, ds::item_index k) {
    if (busy[slot].exchange(1) != 0) overlaps = true;
    ++begun.at(place(k));
    request_state& s = slots.at(slot);
    s.start(k);
    return to(slot, table->first[s.random % 8]);
  }
  ds::shader_id step(ds::shader_id stage, ds::request_index slot) {
    request_state& s = slots.at(slot);
    return to(slot, table->row[stage * 8 + s.step(stage)]);
  }

 private:
  ds::shader_id to(ds::request_index slot, ds::shader_id next) {
    request_state const& s = slots[slot];
    if (s.steps >= most_steps) next = table->stages;
    if (next >= table->stages) {
      results.at(place(s.item)) = s.value;
      ++ended.at(place(s.item));
      busy[slot] = 0;
    }
    return next;
  }
};

/// The results by a plain loop over items.
inline std::vector<float> expected_results(transitions const& t, std::size_t items,
                                           ds::item_index first = 0, std::uint32_t steps = 100) {
  std::vector<float> results;
  for (std::size_t k = 0; k < items; ++k) {
    request_state s;
    s.start(first + k);
    std::uint32_t stage = t.first[s.random % 8];
    while (stage < t.stages && s.steps < steps) stage = t.row[stage * 8 + s.step(stage)];
    results.push_back(s.value);
  }
  return results;
}

struct begin_machine {
  machine_run* run;
  ds::shader_id operator()(ds::request_index slot, ds::item_index k) const {
    return run->start(slot, k);
  }
};

template <ds::shader_id Id>
struct machine_stage {
  machine_run* run;
  ds::shader_id operator()(ds::request_index slot) const { return run->step(Id, slot); }
};

template <ds::shader_id... Ids>
auto machine_stages(machine_run& run, std::integer_sequence<ds::shader_id, Ids...>) {
  return ds::shader_table{machine_stage<Ids>{&run}...};
}
/// A table of `Count` stages, each of a type of its own.
template <ds::shader_id Count>
auto machine_stages(machine_run& run) {
  return machine_stages(run, std::make_integer_sequence<ds::shader_id, Count>());
}

}  // namespace test
