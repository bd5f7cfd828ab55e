// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <benchmark/benchmark.h>

#include <thrust/execution_policy.h>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <deferred_shade/deferred_shade.hpp>
#include <iostream>
#include <random>
#include <string>
#include <vector>

/// What the benchmarks vary: the shaders, the coherence of the ids, the size of the wave.
namespace axes {

namespace ds = deferred_shade;

/// The policy of the machine that the build chose (DEFERRED_SHADE_DEVICE_SYSTEM).
inline auto const& policy() { return thrust::device; }

/// The mean length of a stretch of one id; 1 is fully random.
inline std::vector<std::int64_t> run_lengths() { return {1, 4, 32, 512}; }

/// The number of requests; `--quick` takes the smallest alone.
inline std::vector<std::int64_t>& sizes() {
  static std::vector<std::int64_t> list{1 << 17, 1 << 20, 1 << 23};
  return list;
}

/// `n` ids over `shaders` shaders, in stretches of `run_length` on average.
inline std::vector<std::uint8_t> make_ids(std::size_t n, std::uint32_t shaders,
                                          std::int64_t run_length) {
  std::mt19937 engine(7);
  std::vector<std::uint8_t> ids(n);
  std::uint8_t current = 0;
  for (std::size_t i = 0; i < n; ++i) {
    bool const next = i == 0 || engine() % static_cast<std::uint64_t>(run_length) == 0;
    if (next) current = static_cast<std::uint8_t>(engine() % shaders);
    ids[i] = current;
  }
  return ids;
}

/// 32 bytes in, 16 bytes out.
struct request {
  float position[3];
  float normal[3];
  float u, v;
};
struct result {
  float radiance[3];
  float throughput;
};

/// A few operations: the simple shaders of the paper's first scenes.
template <int Id>
struct simple {
  result operator()(request const& r) const {
    float const cosine = r.normal[0] * 0.48F + r.normal[1] * 0.6F + r.normal[2] * 0.64F;
    float const shade = (0.2F + 0.05F * Id) * (cosine > 0 ? cosine : 0);
    return {{shade, shade * (0.9F - 0.01F * Id), shade * 0.5F}, cosine};
  }
};

/// About a hundred operations: a microfacet lobe whose roughness follows a stripe pattern.
template <int Id>
struct moderate {
  result operator()(request const& r) const {
    float stripe = 0;
    for (int octave = 0; octave < 4; ++octave) {
      float const x = (r.u + 0.37F * Id) * static_cast<float>(1 << octave) + r.v;
      float const f = x - std::floor(x);
      stripe += f * f * (3 - 2 * f) / static_cast<float>(1 << octave);
    }
    float const alpha = 0.05F + 0.02F * Id + 0.1F * stripe;
    float const cosine = std::abs(r.normal[2]);
    float const d = cosine * cosine * (alpha * alpha - 1) + 1;
    float const lobe = alpha * alpha / (3.14159265F * d * d);
    float const masking = 2 * cosine / (cosine + std::sqrt(alpha + (1 - alpha) * cosine * cosine));
    return {{lobe * masking, lobe * stripe, masking * stripe}, d};
  }
};

template <template <int> class Shader, class Requests, class Results, int... Ids>
auto table(Requests requests, Results results, std::integer_sequence<int, Ids...>) {
  return ds::record_shaders(requests, results, Shader<Ids>{}...);
}

/// Ends a benchmark as an error where `good` does not hold: a wrong answer has no time.
inline bool check(benchmark::State& state, bool good) {
  if (!good) state.SkipWithError("the answer is wrong");
  return good;
}

/// Runs the registered benchmarks; `--quick` keeps to small waves and short times.
inline int run(int argc, char** argv, void (*register_all)()) {
  std::vector<char*> arguments(argv, argv + argc);
  std::string min_time = "--benchmark_min_time=0.01";
  for (auto argument = arguments.begin() + 1; argument != arguments.end(); ++argument) {
    if (std::strcmp(*argument, "--quick") != 0) continue;
    *argument = min_time.data();
    sizes() = {1 << 17};
    break;
  }
  register_all();
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

}  // namespace axes
