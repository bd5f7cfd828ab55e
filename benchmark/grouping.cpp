// SPDX-License-Identifier: Apache-2.0
// Grouping alone: ids to a stable permutation, next to Thrust's own stable sort and to a copy of
// the ids and of as many indices, which no grouping can be faster than.
#include <thrust/sequence.h>
#include <thrust/sort.h>

#include <algorithm>

#include "axes.hpp"

namespace {

using axes::ds::request_index;
constexpr axes::ds::shader_id shaders = 11;

bool is_stable_permutation(std::vector<std::uint8_t> const& ids, request_index const* permutation) {
  for (std::size_t p = 1; p < ids.size(); ++p) {
    auto const a = permutation[p - 1];
    auto const b = permutation[p];
    if (ids[a] > ids[b] || (ids[a] == ids[b] && a >= b)) return false;
  }
  return true;
}

template <class Group>
void grouping(benchmark::State& state, Group const& group) {
  auto const n = static_cast<std::size_t>(state.range(0));
  auto const ids = axes::make_ids(n, shaders, state.range(1));
  axes::ds::workspace scratch{axes::policy()};
  auto const run = [&] { return group(static_cast<request_index>(n), ids.data(), scratch); };
  if (!axes::check(state, is_stable_permutation(ids, run().permutation))) return;
  for (auto _ : state) benchmark::DoNotOptimize(run());
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void bucket(benchmark::State& state) {
  grouping(state, [](auto n, auto ids, auto& scratch) {
    return axes::ds::group_by_bucket<shaders>(axes::policy(), n, ids, scratch);
  });
}

void radix_sort(benchmark::State& state) {
  grouping(state, [](auto n, auto ids, auto& scratch) {
    return axes::ds::group_by_radix_sort<shaders>(axes::policy(), n, ids, scratch);
  });
}

void compaction(benchmark::State& state) {
  grouping(state, [](auto n, auto ids, auto& scratch) {
    return axes::ds::group_by_compaction<shaders>(axes::policy(), n, ids, scratch);
  });
}

template <class Key>
void thrust_stable_sort_by_key(benchmark::State& state) {
  std::vector<Key> keys(static_cast<std::size_t>(state.range(0)));
  std::vector<request_index> permutation(keys.size());
  grouping(state, [&](auto n, auto ids, auto&) {
    thrust::copy_n(axes::policy(), ids, n, keys.begin());
    thrust::sequence(axes::policy(), permutation.begin(), permutation.end());
    thrust::stable_sort_by_key(axes::policy(), keys.begin(), keys.end(), permutation.begin());
    return axes::ds::grouping{permutation.data(), nullptr};
  });
}

void copy_ids_and_indices(benchmark::State& state) {
  auto const n = static_cast<std::size_t>(state.range(0));
  std::vector<std::uint8_t> const ids = axes::make_ids(n, shaders, state.range(1));
  std::vector<std::uint8_t> id_copy(n);
  std::vector<request_index> const indices(n, 1);
  std::vector<request_index> index_copy(n);
  for (auto _ : state) {
    thrust::copy_n(axes::policy(), ids.begin(), n, id_copy.begin());
    thrust::copy_n(axes::policy(), indices.begin(), n, index_copy.begin());
    benchmark::ClobberMemory();
  }
  if (!axes::check(state, id_copy == ids && index_copy == indices)) return;
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void register_all() {
  auto const add = [](char const* name, void (*function)(benchmark::State&)) {
    benchmark::RegisterBenchmark(name, function)
        ->ArgsProduct({axes::sizes(), axes::run_lengths()})
        ->ArgNames({"n", "run"})
        ->UseRealTime();
  };
  add("copy_ids_and_indices", copy_ids_and_indices);
  add("bucket", bucket);
  add("radix_sort", radix_sort);
  add("compaction", compaction);
  add("thrust_stable_sort_by_key<u8>", thrust_stable_sort_by_key<std::uint8_t>);
  add("thrust_stable_sort_by_key<u32>", thrust_stable_sort_by_key<std::uint32_t>);
}

}  // namespace

int main(int argc, char** argv) { return axes::run(argc, argv, register_all); }
