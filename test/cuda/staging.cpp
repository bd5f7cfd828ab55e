// SPDX-License-Identifier: Apache-2.0
// Record shaders: their requests and results may pass through shared memory, whatever their sizes.
// Covers detail/cuda/staging.hpp and detail/cuda/staged_tiles.hpp.
#include <cstdint>
#include <vector>

#include "catch.hpp"
#include "support/backends.hpp"
#include "support/compare.hpp"
#include "support/every_schedule.hpp"
#include "support/records.hpp"

namespace ds = deferred_shade;

namespace {

using gpu = test::cuda;
using test::mixing;
using test::record;

/// Runs `schedule` over `n` requests that begin `shift` bytes behind a wide boundary.
template <class Request, class Result, class Schedule>
void check_records(Schedule const& schedule, std::uint32_t n, std::size_t shift = 0) {
  using function = mixing<Request, Result>;
  CAPTURE(test::run_seed(), n, shift, sizeof(Request), sizeof(Result));
  gpu::vector<unsigned char> memory(shift + (n + 1) * sizeof(Request));
  auto* const requests = reinterpret_cast<Request*>(memory.data() + shift);
  test::fill(requests, n, test::run_seed());
  auto const ids = test::random_ids(n, 3);
  auto results = test::random_records<Result>(n, 1);
  auto const expected = test::looped(results, ids, [&](std::uint32_t i) { return requests[i]; });
  auto const exec = gpu::policy();
  ds::workspace scratch{exec};
  ds::shade(exec, schedule, n, ids.data(),
            ds::record_shaders(static_cast<Request const*>(requests), results.data(), function{0},
                               function{1}, function{2}),
            scratch);
  gpu::wait();
  CHECK(test::first_difference(results, expected) == n);
}

template <class Request, class Result>
void check_tiles() {
  for (std::uint32_t const n : test::some_sizes()) {
    check_records<Request, Result>(ds::local_sort_then_dispatch<>{}, n);
  }
  check_records<Request, Result>(ds::local_sort_then_dispatch<>{}, 10007, alignof(Request));
}

}  // namespace

TEST_CASE("tiles take records of any size", "[cuda]") {
  check_tiles<record<3>, record<1>>();
  check_tiles<record<3>, record<10>>();
  check_tiles<record<5>, record<3>>();
  check_tiles<record<8>, record<4>>();
  check_tiles<record<8, 16>, record<4, 16>>();
  check_tiles<record<12>, record<10>>();
  check_tiles<record<12, 16>, record<3>>();
  check_tiles<record<4, 16>, record<10>>();
  check_tiles<record<25>, record<1>>();
  check_tiles<record<25>, record<10>>();
  check_tiles<record<64>, record<1>>();  // too large for shared memory
}

TEST_CASE("every schedule takes records", "[cuda]") {
  test::for_each_schedule([](auto schedule) {
    check_records<record<3>, record<10>>(schedule, 20011);
    check_records<record<8, 16>, record<4, 16>>(schedule, 20011);
    check_records<record<25>, record<3>>(schedule, 20011, 4);
  });
}
