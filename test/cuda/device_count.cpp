// SPDX-License-Identifier: Apache-2.0
// A count in device memory, which no host function reads: clamped to 0 and the maximum, and no
// request behind it is touched.
#include <thrust/count.h>
#include <thrust/device_vector.h>
#include <algorithm>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "support/device_batch.hpp"
#include "support/every_schedule.hpp"
#include "support/grouping_properties.hpp"

namespace ds = deferred_shade;

namespace {

constexpr std::uint32_t maximum = 20011;

/// Counts of type `Integer` and what each is worth.
template <class Integer>
std::vector<std::pair<Integer, std::uint32_t>> counts() {
  std::vector<std::pair<Integer, std::uint32_t>> list{
      {0, 0},
      {1, 1},
      {static_cast<Integer>(maximum / 2), maximum / 2},
      {static_cast<Integer>(maximum), maximum},
      {static_cast<Integer>(maximum + 1), maximum},
      {std::numeric_limits<Integer>::max(), maximum}};
  if (std::is_signed_v<Integer>) {
    list.emplace_back(static_cast<Integer>(-1), 0U);
    list.emplace_back(std::numeric_limits<Integer>::min(), 0U);
  }
  if (sizeof(Integer) == 8) {  // its lower half alone would be a count within bounds
    list.emplace_back(static_cast<Integer>((std::uint64_t{1} << 32) + 7), maximum);
  }
  return list;
}

}  // namespace

TEMPLATE_TEST_CASE("a device_count of any type is clamped on the GPU", "[cuda]", std::uint32_t,
                   std::int32_t, std::uint64_t, std::int64_t) {
  test::stream stream;
  auto const exec = thrust::cuda::par_nosync.on(stream);
  test::device_batch batch(maximum);
  thrust::device_vector<TestType> count(1);
  std::uint32_t const seed = test::run_seed();
  auto const ids = test::make_ids<std::uint8_t>(test::layout::random, maximum,
                                                test::device_batch::shaders, seed);
  ds::workspace scratch{exec};
  test::for_each_schedule([&](auto schedule) {
    for (auto const& [value, worth] : counts<TestType>()) {
      CAPTURE(value, worth, seed);
      count[0] = value;
      test::cuda::wait();
      batch.send(ids, stream);
      ds::shade(exec, schedule, ds::device_count{thrust::raw_pointer_cast(count.data()), maximum},
                batch.ids(), batch.table(), scratch);
      batch.fetch(stream);
      stream.wait();
      CHECK(batch.first_wrong(worth) == maximum);
    }
  });
}

TEST_CASE("a grouping of a device_count holds the requests before the count", "[cuda]") {
  constexpr ds::shader_id shaders = 11;
  auto const exec = test::cuda::policy();
  std::uint32_t const seed = test::run_seed();
  auto const ids = test::make_ids<std::uint8_t>(test::layout::random, maximum, shaders, seed);
  thrust::device_vector<std::uint8_t> const device_ids(ids.begin(), ids.end());
  thrust::device_vector<std::int32_t> count(1);
  ds::workspace scratch{exec};
  for (auto const& [value, worth] : counts<std::int32_t>()) {
    CAPTURE(value, worth, seed);
    count[0] = value;
    std::vector<std::uint8_t> const before(ids.begin(), ids.begin() + worth);
    test::stable_grouping const expected(before, shaders);
    ds::device_count const n{thrust::raw_pointer_cast(count.data()), maximum};
    auto const* const first = thrust::raw_pointer_cast(device_ids.data());
    auto const check = [&](ds::grouping const& group) {
      test::check_grouping<test::cuda>(group, expected);
    };
    check(ds::group_by_bucket<shaders>(exec, n, first, scratch));
    check(ds::group_by_radix_sort<shaders>(exec, n, first, scratch));
    check(ds::group_by_compaction<shaders>(exec, n, first, scratch));
  }
}

TEST_CASE("statistics read ids and a count in device memory", "[cuda]") {
  constexpr ds::shader_id shaders = 5;
  auto const exec = test::cuda::policy();
  std::uint32_t const seed = test::run_seed();
  auto const ids = test::make_ids<std::uint8_t>(test::layout::random, maximum, shaders, seed);
  thrust::device_vector<std::uint8_t> const device_ids(ids.begin(), ids.end());
  thrust::device_vector<std::int32_t> count(1);
  auto const count_shaders = [&] {
    ds::device_count const n{thrust::raw_pointer_cast(count.data()), maximum};
    return ds::count_occurrences(exec, n, thrust::raw_pointer_cast(device_ids.data()), shaders);
  };
  for (std::uint32_t const present : {0U, maximum / 2, maximum}) {
    CAPTURE(present, seed);
    count[0] = static_cast<std::int32_t>(present);
    std::vector<std::uint64_t> histogram(shaders + 1, 0);
    for (std::uint32_t i = 0; i < present; ++i)
      ++histogram[std::min<std::uint32_t>(ids[i], shaders)];
    CHECK(count_shaders().requests == histogram);
  }
  // The host sees the count here, and so refuses it as it does on a CPU.
  count[0] = -1;
  CHECK_THROWS_AS(count_shaders(), std::invalid_argument);
  count[0] = static_cast<std::int32_t>(maximum + 1);
  CHECK_THROWS_AS(count_shaders(), std::length_error);
}

TEST_CASE("a device_count of at most nothing runs nothing", "[cuda]") {
  auto const exec = test::cuda::policy();
  thrust::device_vector<std::uint32_t> const count(1, 5);
  thrust::device_vector<std::uint32_t> runs(5, 0);
  thrust::device_vector<float> value(5, 0);
  thrust::device_vector<std::uint8_t> const ids(5, 0);
  ds::workspace scratch{exec};
  test::for_each_schedule([&](auto schedule) {
    ds::shade(exec, schedule, ds::device_count{thrust::raw_pointer_cast(count.data()), 0},
              thrust::raw_pointer_cast(ids.data()),
              test::tracing_table<1>(thrust::raw_pointer_cast(value.data()),
                                     thrust::raw_pointer_cast(runs.data())),
              scratch);
  });
  test::cuda::wait();
  CHECK(thrust::count(runs.begin(), runs.end(), 0U) == 5);
}
