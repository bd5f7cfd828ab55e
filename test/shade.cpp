// SPDX-License-Identifier: Apache-2.0
// Also the tests of counts.hpp, whose checks `shade` makes; statistics.cpp has the others.
// Covers detail/checked_count.hpp.
#include <deferred_shade/shade.hpp>

#include <thrust/iterator/counting_iterator.h>
#include <limits>
#include <stdexcept>
#include <string>

#include "support/every_schedule.hpp"
#include "support/schedule_properties.hpp"

namespace ds = deferred_shade;

namespace {

/// The message of the exception of type `Exception` that `f` throws.
template <class Exception, class Function>
std::string message_of(Function const& f) {
  try {
    f();
  } catch (Exception const& error) {
    return error.what();
  }
  return "nothing was thrown";
}

struct counting_shader {
  int* calls;
  void operator()(ds::request_index) const { ++*calls; }
};

struct counting_runs {
  int* runs;
  DEFERRED_SHADE_HOST_DEVICE void operator()(ds::request_index i) const { ++runs[i]; }
};

}  // namespace

TEMPLATE_LIST_TEST_CASE("shade refuses a count that no batch has", "[shade]", test::backends) {
  auto const exec = TestType::policy();
  auto const ids = test::on<TestType>(std::vector<std::uint8_t>(1, 0));
  auto runs = test::on<TestType>(std::vector<int>(1, 0));
  ds::workspace scratch{exec};
  auto const shade = [&](auto n) {
    return [&, n] {
      ds::shade(exec, ds::sort_then_dispatch<>{}, n, ids.data(),
                ds::shader_table{counting_runs{runs.data()}}, scratch);
    };
  };
  CHECK(message_of<std::invalid_argument>(shade(-5)) ==
        "deferred_shade::shade: n is -5, and a number of requests is not negative");
  std::string const too_long =
      "deferred_shade::shade: n is 4294967296, and a batch holds at most 4294967295 requests: "
      "their "
      "indices have 32 bits";
  CHECK(message_of<std::length_error>(shade(std::size_t{1} << 32)) == too_long);
  CHECK(message_of<std::length_error>(shade(std::int64_t{1} << 32)) == too_long);
  CHECK_THROWS_AS(shade(std::numeric_limits<std::int64_t>::min())(), std::invalid_argument);

  CHECK(message_of<std::invalid_argument>(
            shade(ds::device_count{static_cast<int const*>(nullptr), 1})) ==
        "deferred_shade::shade: the pointer of device_count is null");
  CHECK(message_of<std::length_error>(shade(ds::device_count{runs.data(), std::size_t{1} << 32})) ==
        too_long);

  TestType::wait();
  CHECK(runs[0] == 0);
  CHECK(scratch.capacity() == 0);
  shade(1)();
  TestType::wait();
  CHECK(runs[0] == 1);
}

TEST_CASE("shade refuses a device_count that is wrong, where the host can see it", "[shade]") {
  int calls = 0;
  std::uint8_t const ids[1] = {0};
  ds::workspace scratch{thrust::cpp::par};
  auto const shade = [&](int const& count) {
    return [&] {
      ds::shade(thrust::cpp::par, ds::sort_then_dispatch<>{}, ds::device_count{&count, 2}, ids,
                ds::shader_table{counting_shader{&calls}}, scratch);
    };
  };
  int const three = 3;
  CHECK(message_of<std::length_error>(shade(three)) ==
        "deferred_shade::shade: device_count points at 3 requests, above its maximum of 2");
  int const negative = -1;
  CHECK_THROWS_AS(shade(negative)(), std::invalid_argument);
  CHECK(calls == 0);
  CHECK(scratch.capacity() == 0);
}

TEMPLATE_LIST_TEST_CASE("shade refuses null ids, unless there is no request", "[shade]",
                        test::backends) {
  auto const exec = TestType::policy();
  auto runs = test::on<TestType>(std::vector<int>(3, 0));
  std::uint8_t const* const ids = nullptr;
  ds::workspace scratch{exec};
  auto const check = [&](auto schedule) {
    auto const shade = [&](int n) {
      ds::shade(exec, schedule, n, ids, ds::shader_table{counting_runs{runs.data()}}, scratch);
    };
    shade(0);
    CHECK(message_of<std::invalid_argument>([&] { shade(3); }) ==
          "deferred_shade::shade: ids is null, and n is not 0");
  };
  // The schedule is not called.
  check(ds::implicit_serialization{});
  check(ds::bucket_then_dispatch<>{});
  TestType::wait();
  CHECK(runs == test::on<TestType>(std::vector<int>(3, 0)));
}

TEMPLATE_LIST_TEST_CASE("shade reads a device_count when it runs", "[shade]", test::backends) {
  auto const exec = TestType::policy();
  std::uint32_t const maximum = 1000;
  auto const ids = test::on<TestType>(std::vector<std::uint8_t>(maximum, 0));
  auto count = test::on<TestType>(std::vector<std::uint32_t>(1));
  test::for_each_schedule([&](auto schedule) {
    ds::workspace scratch{exec};
    for (std::uint32_t const n : {0U, 1U, 33U, 1000U}) {
      count[0] = n;
      auto runs = test::on<TestType>(std::vector<int>(maximum, 0));
      ds::shade(exec, schedule, ds::device_count{count.data(), maximum}, ids.data(),
                ds::shader_table{counting_runs{runs.data()}}, scratch);
      TestType::wait();
      for (std::uint32_t i = 0; i < maximum; ++i) REQUIRE(runs[i] == (i < n ? 1 : 0));
    }
  });
}

TEST_CASE("a table may have 256 shaders, all of which a byte names", "[shade]") {
  std::uint32_t const seed = test::run_seed();
  CAPTURE(seed);
  std::uint32_t const n = 30011;
  auto const bytes = test::make_ids<std::uint8_t>(test::layout::descending, n, 256, seed);
  auto const words = test::make_ids<std::uint16_t>(test::layout::random, n, 300, seed);
  ds::workspace scratch{thrust::cpp::par};
  // One schedule for each way to group and to dispatch. Code for all shaders takes a compiler
  // seconds each time, so most have code for a few.
  test::check_against_loop<test::cpp, 256>(ds::bucket_then_dispatch<>{}, n, bytes.data(), scratch);
  test::check_against_loop<test::cpp, 300>(ds::local_sort_then_dispatch<>{}, n, words.data(),
                                           scratch);
  auto const with_256 = [&](auto schedule) {
    test::check_against_loop<test::cpp, 256, 0, 128, 255>(schedule, n, bytes.data(), scratch);
  };
  auto const with_300 = [&](auto schedule) {
    test::check_against_loop<test::cpp, 300, 0, 255, 299>(schedule, n, words.data(), scratch);
  };
  with_256(ds::sort_then_dispatch<ds::implicit_serialization>{});
  with_256(ds::local_sort_then_dispatch<>{});
  with_256(ds::local_sort_then_dispatch<ds::bitonic>{});
  with_300(ds::sort_then_dispatch<ds::implicit_serialization>{});
  with_300(ds::bucket_then_dispatch<>{});
  with_300(ds::window_sort_then_dispatch{});
}

TEMPLATE_LIST_TEST_CASE("batches of any size share a workspace, also after an error", "[shade]",
                        test::backends) {
  auto const exec = TestType::policy();
  ds::workspace scratch{exec};
  auto runs = test::on<TestType>(std::vector<int>(1, 0));
  test::for_each_schedule([&](auto schedule) {
    for (std::uint32_t const n : {70000U, 3U, 0U, 20000U}) {
      auto const ids =
          test::on<TestType>(test::make_ids<std::uint8_t>(test::layout::random, n, 5, n));
      test::check_against_loop<TestType, 5>(schedule, n, ids.data(), scratch);
      CHECK_THROWS(ds::shade(exec, ds::sort_then_dispatch<>{}, -1, ids.data(),
                             ds::shader_table{counting_runs{runs.data()}}, scratch));
    }
  });
  TestType::wait();
  CHECK(runs[0] == 0);
}

// Hidden, and run by name: they take their time, and a sanitizer many times as long.
TEST_CASE("a batch of more than 1024 small blocks", "[.][large]") {
  // Beyond 16777216 requests blocks grow. A sum for each shader stands for the order within it.
  ds::request_index const n = 16777216 + 12345;
  auto const ids = thrust::make_transform_iterator(
      thrust::counting_iterator<ds::request_index>(0),
      [](ds::request_index i) { return static_cast<std::uint8_t>(i * 2654435761U >> 30); });
  std::uint64_t expected[3] = {};
  for (ds::request_index i = 0; i < n; ++i) {
    if (ids[i] < 3) expected[ids[i]] = expected[ids[i]] * 3 + i;
  }
  std::uint64_t sums[3];
  auto const add = [&sums](int id) {
    return [sum = &sums[id]](ds::request_index i) { *sum = *sum * 3 + i; };
  };
  ds::workspace scratch{thrust::cpp::par};
  auto const check = [&](auto schedule) {
    std::fill(std::begin(sums), std::end(sums), std::uint64_t{0});
    ds::shade(thrust::cpp::par, schedule, n, ids, ds::shader_table{add(0), add(1), add(2)},
              scratch);
    CHECK(std::equal(std::begin(sums), std::end(sums), std::begin(expected)));
  };
  check(ds::implicit_serialization{});
  check(ds::compact_then_dispatch<>{});
  check(ds::sort_then_dispatch<ds::implicit_serialization>{});
  check(ds::bucket_then_dispatch<>{});
  check(ds::local_sort_then_dispatch<>{});
}

TEST_CASE("the largest batch", "[.][large]") {
  std::size_t const n = ds::max_requests;
  auto const ids = thrust::make_transform_iterator(
      thrust::counting_iterator<ds::request_index>(0),
      [](ds::request_index i) { return static_cast<std::uint8_t>(i % 3); });
  std::uint64_t runs = 0;
  std::uint64_t sum = 0;
  auto const add = [&](ds::request_index i) {
    ++runs;
    sum += i;
  };
  ds::workspace scratch{thrust::cpp::par};
  ds::shade(thrust::cpp::par, ds::local_sort_then_dispatch<>{}, n, ids,
            ds::shader_table{add, add, add}, scratch);
  CHECK(runs == n);
  CHECK(sum == (n - 1) * (n / 2) + (n % 2) * (n - 1) / 2);
}
