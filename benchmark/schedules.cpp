// SPDX-License-Identifier: Apache-2.0
// Every schedule over sets of shaders and coherences of ids; compare with implicit_serialization of
// the same run. The rows "sorted" are implicit_serialization over ids that already lie sorted.
#include <algorithm>

#include "axes.hpp"

namespace {

template <template <int> class Shader, int Shaders, class Schedule>
void schedule(benchmark::State& state, bool sorted) {
  auto const n = static_cast<std::size_t>(state.range(0));
  auto ids = axes::make_ids(n, Shaders, state.range(1));
  if (sorted) std::sort(ids.begin(), ids.end());
  std::mt19937 engine(3);
  std::uniform_real_distribution<float> uniform(-1, 1);
  std::vector<axes::request> requests(n);
  for (auto& r : requests) {
    r = {{uniform(engine), uniform(engine), uniform(engine)},
         {uniform(engine), uniform(engine), uniform(engine)},
         uniform(engine),
         uniform(engine)};
  }
  std::vector<axes::result> results(n);
  std::vector<axes::result> expected(n);
  using indices = std::make_integer_sequence<int, Shaders>;
  auto const reference = axes::table<Shader>(requests.data(), expected.data(), indices());
  for (std::size_t i = 0; i < n; ++i)
    reference.run(ids[i], static_cast<axes::ds::request_index>(i));

  auto const shaders = axes::table<Shader>(requests.data(), results.data(), indices());
  axes::ds::workspace scratch{axes::policy()};
  auto const run = [&] {
    axes::ds::shade(axes::policy(), Schedule{}, n, ids.data(), shaders, scratch);
    benchmark::ClobberMemory();
  };
  run();
  if (!axes::check(state,
                   std::memcmp(results.data(), expected.data(), n * sizeof(axes::result)) == 0)) {
    return;
  }
  for (auto _ : state) run();
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

template <template <int> class Shader, int Shaders, class Schedule>
void add(std::string const& set, std::string const& name, bool sorted = false) {
  benchmark::RegisterBenchmark((set + "/" + name).c_str(), schedule<Shader, Shaders, Schedule>,
                               sorted)
      ->ArgsProduct({axes::sizes(), axes::run_lengths()})
      ->ArgNames({"n", "run"})
      ->UseRealTime();
}

template <template <int> class Shader, int Shaders>
void add_all(std::string const& set) {
  using namespace axes::ds;
  add<Shader, Shaders, implicit_serialization>(set, "implicit");
  add<Shader, Shaders, implicit_serialization>(set, "sorted", true);
  add<Shader, Shaders, explicit_serialization>(set, "explicit");
  add<Shader, Shaders, compact_then_dispatch<>>(set, "compact+explicit");
  add<Shader, Shaders, sort_then_dispatch<>>(set, "sort+explicit");
  add<Shader, Shaders, bucket_then_dispatch<>>(set, "bucket+explicit");
  add<Shader, Shaders, bucket_then_dispatch<implicit_serialization>>(set, "bucket+implicit");
  add<Shader, Shaders, local_sort_then_dispatch<bitonic>>(set, "local-bitonic");
  add<Shader, Shaders, local_sort_then_dispatch<>>(set, "local");
}

void register_all() {
  add_all<axes::simple, 3>("3 simple");
  add_all<axes::moderate, 11>("11 moderate");
}

}  // namespace

int main(int argc, char** argv) { return axes::run(argc, argv, register_all); }
