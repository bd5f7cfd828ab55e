// SPDX-License-Identifier: Apache-2.0
// Every schedule over sets of shaders, kinds of shaders, coherences of ids and sizes of batches,
// and as controls:
//   oracle-launches   requests that already lie sorted in memory, nothing to schedule: a launch per
//   oracle-switch     shader, or one launch with a switch
//   switch            requests as they come, one launch in which each shader loads and stores for
//                     itself (GPU only: on a CPU, that is the schedule implicit)
//   known-counts      bucket+explicit with counts that the host knows (GPU only)
// The names of cells: set of shaders / kind of shaders / row / n: requests / run: mean length of a
// stretch of one id. benchmark/ratios.py makes tables of them. On a few CPU cores, all of them take
// hours: name some with --benchmark_filter, or give --quick.
#include <memory>
#include <utility>

#include "axes.hpp"
#include "rows.hpp"

namespace {

struct shader_set {
  std::string name;
  bench::row_list list;
};

std::vector<shader_set> shader_sets() {
  return {
#ifndef BENCHMARK_ONE_TABLE
      {"3 simple", bench::rows_of<bench::shader_set<3, 0, 0>>()},
      {"6 simple", bench::rows_of<bench::shader_set<6, 0, 0>>()},
      {"2 simple + 2 procedural", bench::rows_of<bench::shader_set<2, 0, 2>>()},
      {"3 simple + 2 procedural", bench::rows_of<bench::shader_set<3, 0, 2>>()},
      {"11 moderate", bench::rows_of<bench::shader_set<0, 11, 0>>()},
      {"12 mixed", bench::rows_of<bench::shader_set<2, 6, 4>>()},
#endif
      {"32 mixed", bench::rows_of<bench::shader_set<8, 16, 8>>()}};
}

/// The batch of the cells that are running: consecutive cells share one.
struct current_batch {
  std::string name;
  std::unique_ptr<bench::batch> batch;

  /// The batch `name_`, its reference checked; null where that is wrong.
  template <class Make>
  bench::batch* get(std::string const& name_, Make const& make) {
    if (name != name_) {
      name.clear();
      batch.reset();  // before the next one takes memory
      batch = make();
      name = name_;
    }
    return batch.get();
  }
};

/// `current` and `set` are used as long as cells run.
void add_cells(current_batch& current, shader_set const& set, std::size_t n, std::uint32_t run) {
  std::string const end = bench::name_of(n, run);
  for (bench::row const& row : set.list.rows) {
    auto const cell = [&current, &set, &row, n, run, end](benchmark::State& state) {
      auto* const batch = current.get(set.name + end, [&] {
        auto made = std::make_unique<bench::batch>(n, set.list.shaders, run);
        auto const& implicit = *std::find_if(
            set.list.rows.begin(), set.list.rows.end(),
            [](bench::row const& candidate) { return candidate.schedule == "implicit"; });
        bool const right = made->take_reference(implicit.shade, set.list.plain_loop);
        return right ? std::move(made) : nullptr;
      });
      if (!bench::check(state, batch != nullptr && batch->agrees(row.shade, row.sorted))) return;
      bench::view const requests = batch->requests(row.sorted);
      bench::measure(state, n, [&] { row.shade(requests); });
    };
    bench::add_cell(set.name + "/" + row.shaders + "/" + row.schedule + end, cell);
  }
}

}  // namespace

int main(int argc, char** argv) {
  current_batch current;
  std::vector<shader_set> const sets = shader_sets();
  return bench::run(argc, argv, [&](bool quick) {
    auto const [sizes, runs] = bench::schedule_axes(quick);
    for (std::size_t const n : sizes) {
      for (auto const& set : sets) {
        for (std::uint32_t const run : runs) add_cells(current, set, n, run);
      }
    }
  });
}
