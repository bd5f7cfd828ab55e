// SPDX-License-Identifier: Apache-2.0
// Covers detail/work.hpp and detail/cuda/host_copy.hpp.
#include <deferred_shade/statistics.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "catch.hpp"
#include "support/backends.hpp"
#include "support/random_ids.hpp"

namespace ds = deferred_shade;

namespace {

/// The efficiency of the definition, group by group, in plain loops.
double efficiency_by_definition(std::vector<std::uint8_t> const& ids,
                                std::vector<double> const& costs, std::size_t width) {
  double useful = 0;
  double held = 0;
  for (std::size_t first = 0; first < ids.size(); first += width) {
    std::vector<double> n(costs.size(), 0);
    for (std::size_t i = first; i < std::min(ids.size(), first + width); ++i) {
      if (ids[i] < costs.size()) ++n[ids[i]];
    }
    for (std::size_t k = 0; k < costs.size(); ++k) {
      useful += n[k] * costs[k];
      held += std::min(n[k], 1.0) * costs[k];
    }
  }
  return held > 0 ? useful / (static_cast<double>(width) * held) : 1;
}

/// Whether group_efficiency is the definition, group by group. `data` and `ids` are the same.
template <class Backend>
bool groups_agree(std::vector<std::uint8_t> const& data, std::uint8_t const* ids,
                  ds::efficiency_model const& model) {
  std::vector<double> const costs(model.costs, model.costs + model.shaders);
  std::vector<float> groups((data.size() + model.width - 1) / model.width, -1.0F);
  ds::group_efficiency(Backend::policy(), data.size(), ids, model, groups.data());
  for (std::size_t g = 0; g < groups.size(); ++g) {
    auto const begin = data.begin() + static_cast<std::ptrdiff_t>(g * model.width);
    auto const end = data.begin() + static_cast<std::ptrdiff_t>(
                                        std::min(data.size(), (g + 1) * std::size_t{model.width}));
    bool const empty = std::all_of(begin, end, [&](auto id) { return id >= model.shaders; });
    double const expected = efficiency_by_definition({begin, end}, costs, model.width);
    double const actual = static_cast<double>(groups[g]);
    if (empty ? !std::isnan(actual) : !(std::abs(actual - expected) <= 1e-6 * expected)) {
      return false;
    }
  }
  return true;
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("efficiency of two shaders is the paper's", "[statistics]",
                        test::backends) {
  // One group of 32: n lanes of shader A and 32 - n of shader B use (n A + (32 - n) B) of the
  // 32 (A + B) that the lanes are held for.
  double const costs[2] = {3, 7};
  ds::efficiency_model const model{costs, 2};
  for (std::uint32_t n = 0; n <= 32; ++n) {
    CAPTURE(n);
    auto ids = test::on<TestType>(std::vector<std::uint8_t>(32, 1));
    for (std::uint32_t i = 0; i < n; ++i) ids[i * 5 % 32] = 0;
    double const useful = n * 3 + (32 - n) * 7;
    double const held = 32 * ((n > 0 ? 3 : 0) + (n < 32 ? 7 : 0));
    CHECK_THAT(ds::heterogeneous_efficiency(TestType::policy(), 32U, ids.data(), model),
               WithinRel(useful / held, 1e-15));
  }
}

TEST_CASE("efficiency by hand", "[statistics]") {
  double const costs[3] = {1, 1, 4};
  auto const of = [&](std::vector<std::uint8_t> const& ids, std::uint32_t width) {
    return ds::heterogeneous_efficiency(thrust::cpp::par,
                                        static_cast<ds::request_index>(ids.size()), ids.data(),
                                        ds::efficiency_model{costs, 3, width});
  };
  CHECK(of({0, 0, 0, 0}, 4) == 1);
  CHECK(of({0, 1, 0, 1}, 4) == 0.5);
  CHECK(of({0, 1, 0, 1}, 2) == 0.5);
  CHECK(of({0, 0, 1, 1}, 2) == 1);
  CHECK(of({0, 1, 0, 1}, 1) == 1);
  CHECK(of({2, 0, 0, 0}, 4) == 7.0 / 20);
  // A lane whose id names no shader, and a lane beyond the end, are idle.
  CHECK(of({0, 255, 255, 0}, 4) == 0.5);
  CHECK(of({0, 0, 0, 0, 0, 0}, 4) == 0.75);
  // No request at all.
  CHECK(of({}, 4) == 1);
  CHECK(of({255, 255}, 4) == 1);
}

TEMPLATE_LIST_TEST_CASE("efficiency and occurrences agree with the definition", "[statistics]",
                        test::backends) {
  auto const exec = TestType::policy();
  std::vector<double> const costs{1, 2.5, 0.125, 17, 3};
  for (std::uint32_t const n : test::edge_sizes<TestType>()) {
    for (test::layout const how : test::layouts) {
      for (std::uint32_t const width : {1U, 7U, 32U}) {
        std::uint32_t const seed = test::run_seed() + n;
        CAPTURE(n, static_cast<int>(how), width, seed);
        auto const data = test::make_ids<std::uint8_t>(how, n, 5, seed);
        auto const ids = test::on<TestType>(data);
        ds::efficiency_model const model{costs.data(), 5, width};
        CHECK_THAT(ds::heterogeneous_efficiency(exec, n, ids.data(), model),
                   WithinRel(efficiency_by_definition(data, costs, width), 1e-12));

        std::vector<std::uint64_t> histogram(6, 0);
        for (auto const id : data) ++histogram[id < 5 ? id : 5];
        CHECK(ds::count_occurrences(exec, n, ids.data(), 5, width).requests == histogram);

        CHECK(groups_agree<TestType>(data, ids.data(), model));
      }
    }
  }
}

TEMPLATE_LIST_TEST_CASE("counts over many blocks are exact", "[statistics]", test::backends) {
  std::uint32_t const n = 200003;
  std::uint32_t const seed = test::run_seed();
  CAPTURE(seed);
  auto const data = test::make_ids<std::uint8_t>(test::layout::coherent, n, 5, seed);
  auto const ids = test::on<TestType>(data);
  std::vector<double> const costs{1, 2, 4, 8, 16};
  for (std::uint32_t const width : {32U, 1000U, 300000U}) {
    ds::efficiency_model const model{costs.data(), 5, width};
    CHECK_THAT(ds::heterogeneous_efficiency(TestType::policy(), n, ids.data(), model),
               WithinRel(efficiency_by_definition(data, costs, width), 1e-12));
    CHECK(groups_agree<TestType>(data, ids.data(), model));
  }
}

TEMPLATE_LIST_TEST_CASE("a shader that does not occur has any cost", "[statistics]",
                        test::backends) {
  double const infinity = std::numeric_limits<double>::infinity();
  double const nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::uint8_t> data(64);
  for (std::size_t i = 0; i < data.size(); ++i) data[i] = static_cast<std::uint8_t>(i % 2 * 2);
  auto const ids = test::on<TestType>(data);
  for (double const other : {infinity, -infinity, nan, -1.0, 0.0, 1e308}) {
    CAPTURE(other);
    double const costs[] = {1, other, 3, other};
    ds::efficiency_model const model{costs, 4};
    CHECK(ds::heterogeneous_efficiency(TestType::policy(), 64, ids.data(), model) == 0.5);
    float groups[2] = {};
    ds::group_efficiency(TestType::policy(), 64, ids.data(), model, groups);
    CHECK((groups[0] == 0.5F && groups[1] == 0.5F));
  }
}

TEST_CASE("the cost of a shader that occurs is finite and not negative", "[statistics]") {
  std::uint8_t const ids[] = {0, 1, 1, 0};
  double const infinity = std::numeric_limits<double>::infinity();
  for (double const wrong : {infinity, -infinity, std::nan(""), -1.0, -1e-300}) {
    CAPTURE(wrong);
    double const costs[] = {1, wrong};
    ds::efficiency_model const model{costs, 2, 4};
    float group = -7;
    auto const message = ContainsText("costs[1] is");
    CHECK_THROWS_WITH(ds::heterogeneous_efficiency(thrust::cpp::par, 4, ids, model), message);
    CHECK_THROWS_WITH(ds::group_efficiency(thrust::cpp::par, 4, ids, model, &group), message);
    CHECK_THROWS_AS(ds::group_efficiency(thrust::cpp::par, 4, ids, model, &group),
                    std::invalid_argument);
    CHECK(group == -7);
  }
}

TEST_CASE("costs may be any finite numbers", "[statistics]") {
  std::mt19937 engine(test::run_seed());
  std::uniform_real_distribution<double> exponent(-300, 300);
  for (int round = 0; round < 50; ++round) {
    CAPTURE(test::run_seed(), round);
    std::vector<double> costs(5);
    for (double& cost : costs) cost = engine() % 4 == 0 ? 0 : std::pow(10, exponent(engine));
    auto const data = test::make_ids<std::uint8_t>(test::layout::random, 1001, 5,
                                                   static_cast<std::uint32_t>(engine()));
    ds::efficiency_model const model{costs.data(), 5, 32};
    CHECK_THAT(ds::heterogeneous_efficiency(thrust::cpp::par, 1001, data.data(), model),
               WithinRel(efficiency_by_definition(data, costs, 32), 1e-12));
    std::vector<float> groups(32);
    ds::group_efficiency(thrust::cpp::par, 1001, data.data(), model, groups.data());
    for (std::size_t g = 0; g < groups.size(); ++g) {
      auto const first = data.begin() + static_cast<std::ptrdiff_t>(32 * g);
      std::vector<std::uint8_t> const group(first, g == 31 ? data.end() : first + 32);
      bool const free = std::all_of(group.begin(), group.end(),
                                    [&](auto id) { return id >= 5 || costs[id] == 0; });
      double const expected = efficiency_by_definition(group, costs, 32);
      double const actual = static_cast<double>(groups[g]);
      CHECK((free ? std::isnan(actual) : std::abs(actual - expected) <= 1e-6 * expected));
    }
  }
  // Sums that no double holds.
  std::uint8_t const ids[] = {0, 1, 0, 1};
  double const costs[] = {1.5e308, 1.5e308};
  ds::efficiency_model const model{costs, 2, 4};
  float group = 0;
  CHECK(ds::heterogeneous_efficiency(thrust::cpp::par, 4, ids, model) == 0.5);
  ds::group_efficiency(thrust::cpp::par, 4, ids, model, &group);
  CHECK(group == 0.5F);
}

TEST_CASE("the shaders that occur are those of the table that was counted", "[statistics]") {
  std::uint8_t const ids[] = {0, 255, 2};
  auto const counts = ds::count_occurrences(thrust::cpp::par, 3U, &ids[0], 3);
  CHECK(counts.occurring<3>().to_ulong() == 5);
  // One that is larger by one would take the requests that name no shader for the last one's.
  CHECK_THROWS_AS(counts.occurring<4>(), std::invalid_argument);
  CHECK_THROWS_AS(counts.occurring<2>(), std::invalid_argument);
}
