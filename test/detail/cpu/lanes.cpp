// SPDX-License-Identifier: Apache-2.0
#include <deferred_shade/detail/cpu/lanes.hpp>

#include <cmath>
#include <cstring>
#include <deferred_shade/deferred_shade.hpp>
#include <limits>
#include <random>
#include <vector>

#include "catch.hpp"
#include "support/backends.hpp"
#include "support/random_ids.hpp"

namespace ds = deferred_shade;

namespace {

/// Members of several types, and some that are arrays.
struct surface {
  float normal[3];
  float roughness;
  std::uint32_t seed;
  std::int16_t layer[2];
};
struct light {
  float radiance[3];
  std::uint32_t seed;
};

template <int Id>
struct surface_shader {
  DEFERRED_SHADE_HOST_DEVICE light operator()(surface const& s) const {
    float const cosine = s.normal[0] * 0.48F + s.normal[1] * 0.6F + s.normal[2] * 0.64F;
    float lit = (1 + Id) * (cosine > 0 ? cosine : 0) / std::sqrt(s.roughness * s.roughness + 1);
    if (s.layer[0] > s.layer[1]) lit = 1 - lit;
    return {{lit, lit * s.normal[0], lit * static_cast<float>(s.layer[1])},
            (s.seed ^ s.seed >> 15) * (2654435761U + Id)};
  }
};

/// A record whose size is no multiple of a word.
struct odd {
  std::int16_t values[3];
};
struct odd_shader {
  std::int16_t id;
  DEFERRED_SHADE_HOST_DEVICE odd operator()(odd const& r) const {
    return {{r.values[1], r.values[2], static_cast<std::int16_t>(r.values[0] ^ id)}};
  }
};

/// A record with padding, and with a value that it starts with.
struct padded {
  double value = 1;
  bool flag = false;
};
struct padded_shader {
  double factor;
  DEFERRED_SHADE_HOST_DEVICE padded operator()(padded const& r) const {
    padded result;
    result.value = factor * r.value;
    result.flag = !r.flag;
    return result;
  }
};

/// The median of three by their ranks: an array that is written where the data say.
struct median {
  DEFERRED_SHADE_HOST_DEVICE float operator()(surface const& s) const {
    float const a = s.normal[0];
    float const b = s.normal[1];
    float const c = s.normal[2];
    float sorted[3];
    sorted[(a > b ? 1 : 0) + (a > c ? 1 : 0)] = a;
    sorted[(b >= a ? 1 : 0) + (b > c ? 1 : 0)] = b;
    sorted[(c >= a ? 1 : 0) + (c >= b ? 1 : 0)] = c;
    return sorted[1];
  }
};

std::vector<surface> random_surfaces(std::uint32_t n, std::uint32_t seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<float> uniform(-1, 1);
  std::vector<surface> surfaces(n);
  for (surface& s : surfaces) {
    for (float& x : s.normal) x = uniform(engine);
    s.roughness = uniform(engine);
    s.seed = static_cast<std::uint32_t>(engine());
    for (std::int16_t& l : s.layer) l = static_cast<std::int16_t>(engine() % 100);
  }
  return surfaces;
}

bool same_bits(light const& a, light const& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

}  // namespace

TEST_CASE("records come out of lanes as they went in", "[lanes]") {
  STATIC_REQUIRE(ds::detail::has_words<surface>);
  STATIC_REQUIRE(ds::detail::has_words<float>);
  STATIC_REQUIRE(!ds::detail::has_words<odd>);
  STATIC_REQUIRE(!ds::detail::has_words<std::vector<float>>);
  auto const surfaces = random_surfaces(64, test::run_seed());
  CAPTURE(test::run_seed());
  ds::detail::lanes<surface, 64> lanes;
  for (std::size_t j = 0; j < 64; ++j) lanes.set(j, surfaces[j]);
  for (std::size_t j = 0; j < 64; ++j) {
    surface const s = lanes.get(j);
    CHECK(std::memcmp(&s, &surfaces[j], sizeof s) == 0);
  }
  for (std::size_t j = 0; j < 64; ++j) lanes.copy(j, surfaces[63 - j]);
  for (std::size_t j = 0; j < 64; ++j) {
    surface const s = lanes.get(j);
    CHECK(std::memcmp(&s, &surfaces[63 - j], sizeof s) == 0);
  }
}

TEMPLATE_TEST_CASE_SIG("four records go into neighbouring lanes", "[lanes]",
                       ((std::size_t Words), Words), 1, 2, 3, 4, 5, 7, 8, 12, 64) {
  struct record {
    std::uint32_t word[Words];
  };
  std::mt19937 engine(test::run_seed());
  CAPTURE(test::run_seed());
  record records[4];
  for (record& r : records) {
    for (std::uint32_t& word : r.word) word = static_cast<std::uint32_t>(engine());
  }
  ds::detail::lanes<record, 8> lanes;
  for (std::size_t j = 0; j < 8; ++j) lanes.set(j, record{});
  lanes.copy(3, records[0], records[1], records[2], records[3]);
  for (std::size_t j = 0; j < 8; ++j) {
    record const expected = j < 3 || j == 7 ? record{} : records[j - 3];
    record const there = lanes.get(j);
    CHECK(std::memcmp(&there, &expected, sizeof there) == 0);
  }
}

TEST_CASE("lanes keep the bits of a number that is none", "[lanes]") {
  std::uint32_t const signalling = 0x7fa01234;
  float number;
  std::memcpy(&number, &signalling, sizeof number);
  ds::detail::lanes<float, 4> lanes;
  lanes.copy(2, number);
  float const back = lanes.get(2);
  CHECK(std::memcmp(&back, &signalling, sizeof back) == 0);
}

TEMPLATE_LIST_TEST_CASE("packed records give the bits of a plain loop", "[lanes]", test::backends) {
  auto const exec = TestType::policy();
  ds::workspace scratch{exec};
  for (std::uint32_t const n : {1U, 63U, 64U, 65U, 255U, 256U, 257U, 8191U, 8193U, 40009U}) {
    for (test::layout const how : test::layouts) {
      std::uint32_t const seed = test::run_seed() + n + static_cast<std::uint32_t>(how);
      CAPTURE(n, static_cast<int>(how), seed);
      auto const ids = test::on<TestType>(test::make_ids<std::uint8_t>(how, n, 3, seed));
      auto const requests = test::on<TestType>(random_surfaces(n, seed));
      light const untouched{{-1, -1, -1}, 7};
      std::vector<light> expected(n, untouched);
      for (std::uint32_t i = 0; i < n; ++i) {
        if (ids[i] == 0) expected[i] = surface_shader<0>{}(requests[i]);
        if (ids[i] == 1) expected[i] = surface_shader<1>{}(requests[i]);
        if (ids[i] == 2) expected[i] = surface_shader<2>{}(requests[i]);
      }
      auto const check = [&](auto schedule) {
        auto results = test::on<TestType>(std::vector<light>(n, untouched));
        surface const* const source = requests.data();
        ds::shade(exec, schedule, n, ids.data(),
                  ds::record_shaders(source, results.data(), surface_shader<0>{},
                                     surface_shader<1>{}, surface_shader<2>{}),
                  scratch);
        TestType::wait();
        std::size_t wrong = 0;
        for (std::uint32_t i = 0; i < n; ++i) wrong += same_bits(results[i], expected[i]) ? 0U : 1U;
        CHECK(wrong == 0);
      };
      check(ds::local_sort_then_dispatch<>{});
      check(ds::window_sort_then_dispatch{});
      check(ds::bucket_then_dispatch<>{});
    }
  }
}

TEMPLATE_LIST_TEST_CASE("records that cannot be packed run all the same", "[lanes]",
                        test::backends) {
  std::uint32_t const n = 20011;
  CAPTURE(test::run_seed());
  auto const ids = test::on<TestType>(
      test::make_ids<std::uint8_t>(test::layout::random, n, 2, test::run_seed()));
  auto requests = test::on<TestType>(std::vector<odd>(n));
  for (std::uint32_t i = 0; i < n; ++i) {
    requests[i] = {{static_cast<std::int16_t>(i % 1000), static_cast<std::int16_t>(i % 77), 3}};
  }
  auto results = test::on<TestType>(std::vector<odd>(n));
  ds::workspace scratch{TestType::policy()};
  ds::shade(TestType::policy(), ds::local_sort_then_dispatch<>{}, n, ids.data(),
            ds::record_shaders(requests.data(), results.data(), odd_shader{1}, odd_shader{2}),
            scratch);
  TestType::wait();
  std::size_t wrong = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    odd const expected =
        ids[i] < 2 ? odd_shader{static_cast<std::int16_t>(ids[i] + 1)}(requests[i]) : odd{};
    wrong += std::memcmp(&results[i], &expected, sizeof expected) == 0 ? 0U : 1U;
  }
  CHECK(wrong == 0);
}

TEST_CASE("records with padding, and arrays that the data index, are packed", "[lanes]") {
  std::uint32_t const n = 20011;
  CAPTURE(test::run_seed());
  auto const ids = test::make_ids<std::uint8_t>(test::layout::random, n, 2, test::run_seed());
  ds::workspace scratch{thrust::cpp::par};

  std::vector<padded> requests(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    requests[i].value = i / 7.0;
    requests[i].flag = i % 3 == 0;
  }
  std::vector<padded> results(n);
  ds::shade(thrust::cpp::par, ds::local_sort_then_dispatch<>{}, n, ids.data(),
            ds::record_shaders(requests.data(), results.data(), padded_shader{2}, padded_shader{3}),
            scratch);
  auto const surfaces = random_surfaces(n, test::run_seed());
  std::vector<float> medians(n, -2);
  ds::shade(thrust::cpp::par, ds::local_sort_then_dispatch<>{}, n, ids.data(),
            ds::record_shaders(surfaces.data(), medians.data(), median{}, median{}), scratch);
  for (std::uint32_t i = 0; i < n; ++i) {
    if (ids[i] >= 2) continue;
    padded const expected = padded_shader{ids[i] + 2.0}(requests[i]);
    REQUIRE(std::memcmp(&results[i].value, &expected.value, sizeof expected.value) == 0);
    REQUIRE(results[i].flag == expected.flag);
    float const middle = median{}(surfaces[i]);
    REQUIRE(std::memcmp(&medians[i], &middle, sizeof middle) == 0);
  }
}
