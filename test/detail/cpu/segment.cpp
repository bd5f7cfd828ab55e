// SPDX-License-Identifier: Apache-2.0
#include <deferred_shade/detail/cpu/segment.hpp>

#include <algorithm>
#include <cstdint>
#include <random>
#include <type_traits>
#include <vector>

#include "catch.hpp"
#include "support/random_ids.hpp"

namespace ds = deferred_shade;

namespace {

struct vertex {
  float x, y, z;
};
struct length {
  float operator()(vertex const& v) const { return v.x * v.x + v.y * v.y + v.z * v.z; }
};

/// The same, one by one.
struct scalar_length : length {
  static constexpr bool runs_in_vectors = false;
};

/// Makes requests instead of holding them.
struct made {
  vertex operator()(ds::request_index i) const {
    auto const x = static_cast<float>(i);
    return {x, 2 - x, 0.5F * x};
  }
};

/// Makes them in one place.
struct made_in_place {
  vertex* place;
  vertex const& operator()(ds::request_index i) const { return *place = made{}(i); }
};

/// Runs `shader` on the requests `indices`, and checks that `ahead` is called for each once.
template <class Shader>
void run(Shader const& shader, std::vector<std::uint32_t> const& indices) {
  std::vector<std::size_t> ahead;
  ds::detail::run_segment(
      shader, indices.size(), [&indices](std::size_t j) { return indices[j]; },
      [&ahead](std::size_t j) { ahead.push_back(j); });
  REQUIRE(ahead.size() == indices.size());
  std::sort(ahead.begin(), ahead.end());
  for (std::size_t j = 0; j < ahead.size(); ++j) REQUIRE(ahead[j] == j);
}

}  // namespace

TEST_CASE("a segment runs the requests that it is given, and no other", "[segment]") {
  std::mt19937 engine(test::run_seed());
  CAPTURE(test::run_seed());
  for (std::uint32_t const n : {0U, 1U, 3U, 4U, 5U, 255U, 256U, 257U, 1023U}) {
    CAPTURE(n);
    std::uint32_t const total = 3 * n + 1;
    std::vector<std::uint32_t> all(total);
    for (std::uint32_t i = 0; i < total; ++i) all[i] = i;
    std::shuffle(all.begin(), all.end(), engine);
    std::vector<std::uint32_t> const indices(all.begin(), all.begin() + n);

    std::vector<vertex> requests(total);
    for (std::uint32_t i = 0; i < total; ++i) requests[i] = made{}(i);
    std::vector<float> expected(total, -1);
    for (std::uint32_t const i : indices) expected[i] = length{}(requests[i]);

    std::vector<float> loaded(total, -1);
    auto const from_memory = ds::record_shaders(requests.data(), loaded.data(), length{});
    run(from_memory.get<0>(), indices);
    CHECK(loaded == expected);

    std::vector<float> scalar(total, -1);
    auto const one_by_one = ds::record_shaders(requests.data(), scalar.data(), scalar_length{});
    run(one_by_one.get<0>(), indices);
    CHECK(scalar == expected);
    STATIC_REQUIRE(ds::detail::is_packable<std::decay_t<decltype(from_memory.get<0>())>>);
    STATIC_REQUIRE(!ds::detail::is_packable<std::decay_t<decltype(one_by_one.get<0>())>>);

    std::vector<float> computed(total, -1);
    auto const from_function = ds::record_shaders(made{}, computed.data(), length{});
    run(from_function.get<0>(), indices);
    CHECK(computed == expected);

    std::vector<float> reused(total, -1);
    vertex place{};
    auto const from_one_place = ds::record_shaders(made_in_place{&place}, reused.data(), length{});
    run(from_one_place.get<0>(), indices);
    CHECK(reused == expected);

    std::vector<float> indexed(total, -1);
    float* const out = indexed.data();
    vertex const* const in = requests.data();
    run([in, out](ds::request_index i) { out[i] = length{}(in[i]); }, indices);
    CHECK(indexed == expected);
  }
}
