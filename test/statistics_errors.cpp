// SPDX-License-Identifier: Apache-2.0
// Covers what statistics.hpp refuses.
#include <cstdint>
#include <deferred_shade/statistics.hpp>
#include <stdexcept>
#include <vector>

#include "catch.hpp"
#include "support/backends.hpp"

namespace ds = deferred_shade;

TEMPLATE_LIST_TEST_CASE("statistics refuse arrays that are not there", "[statistics]",
                        test::backends) {
  auto const exec = TestType::policy();
  std::uint8_t const* const none = nullptr;
  auto const ids = test::on<TestType>(std::vector<std::uint8_t>{0, 0});
  double const costs[] = {1};
  float group = 0;
  auto const names = [](char const* argument) { return ContainsText(argument); };
  ds::efficiency_model const model{costs, 1};
  CHECK_THROWS_WITH(ds::count_occurrences(exec, 2, none, 1), names("ids is null"));
  CHECK_THROWS_WITH(ds::heterogeneous_efficiency(exec, 2, none, model), names("ids is null"));
  CHECK_THROWS_WITH(ds::group_efficiency(exec, 2, none, model, &group), names("ids is null"));
  ds::efficiency_model const free{nullptr, 1};
  CHECK_THROWS_WITH(ds::heterogeneous_efficiency(exec, 2, ids.data(), free),
                    names("costs is null"));
  CHECK_THROWS_WITH(ds::group_efficiency(exec, 2, ids.data(), free, &group),
                    names("costs is null"));
  CHECK_THROWS_WITH(ds::group_efficiency(exec, 2, ids.data(), model, nullptr),
                    names("efficiency is null"));
  CHECK(ds::count_occurrences(exec, 0, none, 1).requests[0] == 0);
  CHECK(ds::heterogeneous_efficiency(exec, 0, none, free) == 1);
}

TEST_CASE("statistics refuse counts that no batch has", "[statistics]") {
  std::uint8_t const ids[1] = {0};
  CHECK_THROWS_AS(ds::count_occurrences(thrust::cpp::par, -1, &ids[0], 1), std::invalid_argument);
  CHECK_THROWS_AS(ds::count_occurrences(thrust::cpp::par, std::size_t{1} << 32, &ids[0], 1),
                  std::length_error);
}

TEST_CASE("a group has at least one lane", "[statistics]") {
  std::uint8_t const ids[1] = {0};
  double const costs[1] = {1};
  ds::efficiency_model const model{costs, 1, 0};
  float efficiency = 0;
  CHECK_THROWS_AS(ds::heterogeneous_efficiency(thrust::cpp::par, 1U, ids, model),
                  std::invalid_argument);
  CHECK_THROWS_AS(ds::group_efficiency(thrust::cpp::par, 1U, ids, model, &efficiency),
                  std::invalid_argument);
}
