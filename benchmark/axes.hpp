// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <benchmark/benchmark.h>
#ifdef _OPENMP
#include <omp.h>
#endif

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <exception>
#include <string>
#include <vector>

#include "machine.hpp"

/// What the benchmarks vary, how they measure, and their main function. The sets of shaders are in
/// schedules.cpp.
namespace bench {

/// The cell that runs, and whether it runs for a profiler (`--profile`): it calls what it measures
/// once, and its time means nothing.
struct current_cell {
  std::string name;
  bool is_profiled = false;
};
inline current_cell& current() {
  static current_cell cell;
  return cell;
}

/// Values of the axes; `--quick` takes a few of them.
struct axes {
  /// The number of requests: for a GPU, from what fits in its cache to what does not.
  std::vector<std::size_t> sizes;
  /// The mean length of a stretch of one id; 1 is fully random.
  std::vector<std::uint32_t> runs;
};

inline std::size_t operator""_mi(unsigned long long n) {
  return static_cast<std::size_t>(n) * 1024 * 1024;
}

inline axes schedule_axes(bool quick) {
  if (quick) return {on_cuda ? std::vector{1_mi, 8_mi} : std::vector{1_mi / 32}, {1, 32}};
  axes all{{1_mi / 8, 1_mi, 8_mi}, {1, 4, 32, 512}};
  if (on_cuda) all.sizes.push_back(32_mi);
  return all;
}

inline axes grouping_axes(bool quick) {
  if (quick) return {on_cuda ? std::vector{1_mi, 16_mi} : std::vector{1_mi / 8}, {1, 32}};
  return {{1_mi, 8_mi, 16_mi, 64_mi}, {1, 32}};
}

/// The end of a cell's name.
inline std::string name_of(std::size_t n, std::uint32_t run) {
  return "/n:" + std::to_string(n) + "/run:" + std::to_string(run);
}

/// Times `call`, which handles `requests` requests: the cell's time is the median of the timed
/// calls after a few that are not timed; the times a tenth from either end of them are counters.
///
/// Google Benchmark sees this as one iteration. Its own choice of a number of iterations would take
/// half a second for each of thousands of cells and report their mean, which one hiccup spoils.
template <class Function>
void measure(benchmark::State& state, std::size_t requests, Function const& call) {
  if (current().is_profiled) {
    for (auto _ : state) {
      profile(current().name, call);
      state.SetIterationTime(1);
    }
    return;
  }
  int const warm_ups = on_cuda ? 3 : 1;
  int const timed = on_cuda ? 15 : 5;
  for (auto _ : state) {
    for (int i = 0; i < warm_ups; ++i) call();
    std::vector<double> seconds = seconds_per_call(call, timed);
    std::sort(seconds.begin(), seconds.end());
    std::size_t const tenth = seconds.size() / 10;
    state.SetIterationTime(seconds[seconds.size() / 2]);
    state.counters["p10_us"] = 1e6 * seconds[tenth];
    state.counters["p90_us"] = 1e6 * seconds[seconds.size() - 1 - tenth];
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(requests));
}

/// The number of cells whose answer was wrong.
inline int& wrong_answers() {
  static int count = 0;
  return count;
}

/// Ends a cell as an error where `good` does not hold: a wrong answer has no time.
inline bool check(benchmark::State& state, bool good) {
  if (!good) {
    ++wrong_answers();
    state.SkipWithError("the answer is wrong");
  }
  return good;
}

/// Registers `cell(state)`. A cell that throws, for want of memory say, is skipped with an error.
template <class Cell>
void add_cell(std::string const& name, Cell cell) {
  benchmark::RegisterBenchmark(name.c_str(),
                               [name, cell](benchmark::State& state) {
                                 current().name = name;
                                 try {
                                   cell(state);
                                 } catch (std::exception const& error) {
                                   state.SkipWithError(error.what());
                                 }
                               })
      ->Iterations(1)
      ->UseManualTime()
      ->Unit(benchmark::kMicrosecond);
}

inline std::string version_of(int number, int major, int minor) {
  return std::to_string(number / major) + "." + std::to_string(number % major / minor);
}

/// Says in the report what was measured, and on what.
inline void add_context() {
  benchmark::AddCustomContext("machine", machine_name());
  benchmark::AddCustomContext("deferred_shade", version_of(DEFERRED_SHADE_VERSION, 10000, 100));
  benchmark::AddCustomContext("thrust", version_of(THRUST_VERSION, 100000, 100));
#ifdef __CUDACC__
  int driver = 0;
  int runtime = 0;
  check_cuda(cudaDriverGetVersion(&driver));
  check_cuda(cudaRuntimeGetVersion(&runtime));
  benchmark::AddCustomContext("cuda_driver", version_of(driver, 1000, 10));
  benchmark::AddCustomContext("cuda_runtime", version_of(runtime, 1000, 10));
  benchmark::AddCustomContext("nvcc", std::to_string(__CUDACC_VER_MAJOR__) + "." +
                                          std::to_string(__CUDACC_VER_MINOR__) + "." +
                                          std::to_string(__CUDACC_VER_BUILD__));
#endif
#ifdef __VERSION__
  benchmark::AddCustomContext("compiler", __VERSION__);
#endif
#if defined(__AVX512F__)
  benchmark::AddCustomContext("vectors", "AVX-512");
#elif defined(__AVX2__)
  benchmark::AddCustomContext("vectors", "AVX2");
#endif
#ifdef _OPENMP
  benchmark::AddCustomContext("threads", std::to_string(omp_get_max_threads()));
#endif
#ifdef DEFERRED_SHADE_COMMIT
  benchmark::AddCustomContext("commit", DEFERRED_SHADE_COMMIT);
#endif
}

/// The main function: `register_cells(quick)`, then Google Benchmark with the other arguments.
/// Returns 1 where a cell's answer was wrong, 2 where an argument is unknown.
template <class Function>
int run(int argc, char** argv, Function const& register_cells) {
  std::vector<char*> arguments(argv, argv + argc);
  auto const take = [&arguments](char const* flag) {
    auto const found = std::remove_if(arguments.begin() + 1, arguments.end(),
                                      [flag](char const* a) { return std::strcmp(a, flag) == 0; });
    bool const is_there = found != arguments.end();
    arguments.erase(found, arguments.end());
    return is_there;
  };
  bool const is_quick = take("--quick");
  current().is_profiled = take("--profile");
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
  add_context();
  register_cells(is_quick);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return wrong_answers() == 0 ? 0 : 1;
}

}  // namespace bench
