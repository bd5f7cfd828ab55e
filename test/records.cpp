// SPDX-License-Identifier: Apache-2.0
#include <deferred_shade/records.hpp>

#include <deferred_shade/deferred_shade.hpp>
#include <vector>

#include "catch.hpp"
#include "support/backends.hpp"
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
