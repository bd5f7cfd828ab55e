// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deferred_shade/config.hpp>
#include <deferred_shade/types.hpp>
#include <random>
#include <vector>

#include "backends.hpp"
#include "random_ids.hpp"

namespace test {

/// A request or a result of `Words` 32-bit words.
template <std::size_t Words, std::size_t Alignment = 4>
struct alignas(Alignment) record {
  static constexpr std::size_t size = Words;
  std::uint32_t words[Words];
};

/// A pure function whose result depends on every word of the request and on the shader.
template <class Request, class Result>
struct mixing {
  std::uint32_t id;
  DEFERRED_SHADE_HOST_DEVICE Result operator()(Request const& request) const {
    std::uint32_t state = 2654435761U * (id + 1);
    for (std::size_t w = 0; w < Request::size; ++w) state = (state ^ request.words[w]) * 16777619U;
    Result result{};
    for (std::size_t w = 0; w < Result::size; ++w) {
      result.words[w] = state = state * 1664525U + 1013904223U;
    }
    return result;
  }
};

/// `n` random records at `first`.
template <class Record>
void fill(Record* first, std::uint32_t n, std::uint32_t seed) {
  std::mt19937 engine(seed);
  Record next{};
  for (std::uint32_t i = 0; i < n; ++i) {
    for (auto& word : next.words) word = static_cast<std::uint32_t>(engine());
    std::memcpy(static_cast<void*>(first + i), &next, sizeof next);
  }
}

template <class Record>
cuda::vector<Record> random_records(std::uint32_t n, std::uint32_t seed) {
  cuda::vector<Record> records(n);
  fill(records.data(), n, seed);
  return records;
}

/// Ids of a table of `shaders` shaders, and of none.
inline cuda::vector<std::uint8_t> random_ids(std::uint32_t n, std::uint32_t shaders) {
  return on<cuda>(make_ids<std::uint8_t>(layout::random, n, shaders, run_seed()));
}

/// What a plain loop over a table of three shaders makes of `results`: `load(i)` is request i.
template <class Result, class Ids, class Load>
std::vector<Result> looped(cuda::vector<Result> const& results, Ids const& ids, Load const& load) {
  using request = std::decay_t<decltype(load(std::uint32_t{}))>;
  std::vector<Result> expected(results.begin(), results.end());
  for (std::uint32_t i = 0; i < expected.size(); ++i) {
    if (ids[i] < 3) expected[i] = mixing<request, Result>{ids[i]}(load(i));
  }
  return expected;
}

}  // namespace test
