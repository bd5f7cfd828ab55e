// SPDX-License-Identifier: Apache-2.0
// Covers detail/record_types.hpp.
#include <deferred_shade/record_shaders.hpp>

#include <algorithm>
#include <cstring>
#include <deferred_shade/deferred_shade.hpp>
#include <vector>

#include "catch.hpp"
#include "support/backends.hpp"
#include "support/compare.hpp"
#include "support/every_schedule.hpp"
#include "support/random_ids.hpp"

namespace ds = deferred_shade;

namespace {

struct hit {
  float distance;
  std::uint32_t material;
};

struct scale {
  float factor;
  DEFERRED_SHADE_HOST_DEVICE float operator()(hit const& h) const { return factor * h.distance; }
};

/// A request that is put together from two arrays.
struct load_hit {
  float const* distance;
  std::uint8_t const* material;
  DEFERRED_SHADE_HOST_DEVICE hit operator()(ds::request_index i) const {
    return {distance[i], material[i]};
  }
};

/// A result that is split over two arrays.
struct store_whole_and_half {
  float* whole;
  float* half;
  DEFERRED_SHADE_HOST_DEVICE void operator()(ds::request_index i, float result) const {
    whole[i] = result;
    half[i] = result / 2;
  }
};

float load_half(ds::request_index i) { return 0.5F * static_cast<float>(i); }

/// A request that becomes its own result.
struct next_in_place {
  std::uint32_t id;
  DEFERRED_SHADE_HOST_DEVICE std::uint32_t operator()(std::uint32_t x) const {
    return x * 1664525U + id;
  }
};

}  // namespace

TEST_CASE("a record shader is an index shader that knows its records", "[records]") {
  hit const hits[] = {{2, 0}, {3, 0}};
  float results[2] = {};
  ds::record_shader<hit const*, scale, float*> const shader{hits, {10}, results};
  STATIC_REQUIRE(ds::is_record_shader<std::remove_const_t<decltype(shader)>>);
  STATIC_REQUIRE(!ds::is_record_shader<scale>);
  STATIC_REQUIRE(std::is_same_v<decltype(shader)::request_type, hit>);
  STATIC_REQUIRE(std::is_same_v<decltype(shader)::result_type, float>);
  shader(1);
  CHECK(results[0] == 0);
  CHECK(results[1] == 30);
}

TEMPLATE_LIST_TEST_CASE("records load from and store to functions as well", "[records]",
                        test::backends) {
  std::uint32_t const n = 10007;
  std::uint32_t const seed = test::run_seed();
  CAPTURE(seed);
  auto const ids =
      test::on<TestType>(test::make_ids<std::uint8_t>(test::layout::random, n, 3, seed));
  auto distance = test::on<TestType>(std::vector<float>(n));
  for (std::uint32_t i = 0; i < n; ++i) distance[i] = static_cast<float>(i % 113);
  auto whole = test::on<TestType>(std::vector<float>(n, -1));
  auto half = test::on<TestType>(std::vector<float>(n, -1));
  auto const exec = TestType::policy();
  ds::workspace scratch{exec};
  ds::shade(exec, ds::bucket_then_dispatch<>{}, n, ids.data(),
            ds::record_shaders(load_hit{distance.data(), ids.data()},
                               store_whole_and_half{whole.data(), half.data()}, scale{1}, scale{2},
                               scale{3}),
            scratch);
  TestType::wait();
  for (std::uint32_t i = 0; i < n; ++i) {
    float const expected = ids[i] < 3 ? static_cast<float>(ids[i] + 1) * distance[i] : -1;
    REQUIRE(whole[i] == expected);
    REQUIRE(half[i] == (ids[i] < 3 ? expected / 2 : -1));
  }
}

TEST_CASE("functions are sources, and generic lambdas shaders, of packed records", "[records]") {
  std::uint32_t const n = 20011;
  CAPTURE(test::run_seed());
  auto const ids = test::make_ids<std::uint8_t>(test::layout::random, n, 2, test::run_seed());
  std::vector<float> results(n, -1);
  auto const twice = [](auto& x) { return 2 * x; };
  auto const plus_one = [](auto const& x) { return x + 1; };
  ds::workspace scratch{thrust::cpp::par};
  test::for_each_schedule([&](auto schedule) {
    std::fill(results.begin(), results.end(), -1.0F);
    ds::shade(thrust::cpp::par, schedule, n, ids.data(),
              ds::record_shaders(load_half, results.data(), twice, plus_one), scratch);
    std::size_t wrong = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
      float const x = load_half(i);
      float const expected = ids[i] == 0 ? 2 * x : ids[i] == 1 ? x + 1 : -1;
      wrong += std::memcmp(&results[i], &expected, sizeof expected) == 0 ? 0U : 1U;
    }
    CHECK(wrong == 0);
  });
}

TEST_CASE("packed requests become their own results", "[records]") {
  std::uint32_t const n = 30011;
  CAPTURE(test::run_seed());
  auto const ids = test::make_ids<std::uint8_t>(test::layout::random, n, 2, test::run_seed());
  std::vector<std::uint32_t> values(n);
  std::vector<std::uint32_t> expected(n);
  ds::workspace scratch{thrust::cpp::par};
  test::for_each_schedule([&](auto schedule) {
    for (std::uint32_t i = 0; i < n; ++i) {
      values[i] = i;
      expected[i] = ids[i] < 2 ? next_in_place{ids[i]}(i) : i;
    }
    ds::shade(thrust::cpp::par, schedule, n, ids.data(),
              ds::record_shaders(values.data(), values.data(), next_in_place{0}, next_in_place{1}),
              scratch);
    CHECK(test::first_difference(values, expected) == n);
  });
}
