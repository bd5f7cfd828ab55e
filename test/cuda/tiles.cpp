// SPDX-License-Identifier: Apache-2.0
// The tiles of local_sort_then_dispatch and the windows of window_sort_then_dispatch on a GPU, on
// both sides of each size of a table at which they are sorted, or their records moved, in another
// way.
// Covers detail/cuda/begin_tile.hpp, detail/cuda/dense_tiles.hpp, detail/cuda/tile.hpp,
// detail/cuda/tile_rows.hpp, detail/cuda/tile_sort.hpp, detail/cuda/window.hpp and
// detail/cuda/window_grouping.hpp.
#include <cstdint>
#include <deferred_shade/schedule.hpp>
#include <vector>

#include "catch.hpp"
#include "support/backends.hpp"
#include "support/compare.hpp"
#include "support/records.hpp"
#include "support/schedule_properties.hpp"

namespace ds = deferred_shade;

namespace {

using gpu = test::cuda;
using test::record;
using function = test::mixing<record<4, 16>, record<2>>;

template <std::uint32_t Shaders, class Schedule>
void check_table(Schedule const& schedule) {
  ds::workspace scratch{gpu::policy()};
  test::check_id_type<gpu, std::uint16_t, Shaders>(schedule, scratch, {1, 33, 4095, 8193, 20011});
}

template <std::uint32_t... Ids>
void check_records(std::integer_sequence<std::uint32_t, Ids...>) {
  std::uint32_t const n = 20011;
  CAPTURE(test::run_seed(), sizeof...(Ids));
  auto const requests = test::random_records<record<4, 16>>(n, test::run_seed());
  auto const ids = test::random_ids(n, sizeof...(Ids));
  gpu::vector<record<2>> results(n);
  std::vector<record<2>> expected(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    if (ids[i] < sizeof...(Ids)) expected[i] = function{ids[i]}(requests[i]);
  }
  ds::workspace scratch{gpu::policy()};
  ds::shade(gpu::policy(), ds::local_sort_then_dispatch<>{}, n, ids.data(),
            ds::record_shaders(requests.data(), results.data(), function{Ids}...), scratch);
  gpu::wait();
  CHECK(test::first_difference(results, expected) == n);
}

}  // namespace

TEST_CASE("tiles take tables of any size", "[cuda]") {
  ds::local_sort_then_dispatch<> const schedule;
  check_table<8>(schedule);
  check_table<9>(schedule);
  check_table<32>(schedule);
  check_table<33>(schedule);
  check_table<255>(schedule);
  check_table<256>(schedule);
}

TEST_CASE("tiles of few shaders take batches of any size", "[cuda]") {
  // Of the size that threads have several requests each for, and larger.
  cudaDeviceProp properties{};
  REQUIRE(cudaGetDeviceProperties(&properties, 0) == cudaSuccess);
  auto const threads = static_cast<std::uint32_t>(properties.multiProcessorCount *
                                                  properties.maxThreadsPerMultiProcessor);
  ds::workspace scratch{gpu::policy()};
  test::check_id_type<gpu, std::uint8_t, 6>(ds::local_sort_then_dispatch<>{}, scratch,
                                            {threads, threads + 33, 2 * threads + 1, 5 * threads});
}

TEST_CASE("windows take tables of any size", "[cuda]") {
  ds::window_sort_then_dispatch const schedule;
  check_table<7>(schedule);
  check_table<8>(schedule);
  check_table<15>(schedule);
  check_table<16>(schedule);
  check_table<32>(schedule);
  check_table<33>(schedule);
}

TEST_CASE("tiles take records of tables of any size", "[cuda]") {
  check_records(std::make_integer_sequence<std::uint32_t, 16>());
  check_records(std::make_integer_sequence<std::uint32_t, 17>());
}

TEST_CASE("tiles take records that extended lambdas load and store", "[cuda]") {
  std::uint32_t const n = 20011;
  CAPTURE(test::run_seed());
  auto const requests = test::random_records<record<4, 16>>(n, test::run_seed());
  auto const ids = test::random_ids(n, 2);
  gpu::vector<record<2>> results(n);
  std::vector<record<2>> expected(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    if (ids[i] < 2) expected[i] = function{ids[i]}(requests[i]);
  }
  auto const* const in = requests.data();
  auto* const out = results.data();
  auto const load = [in] __host__ __device__(ds::request_index i) { return in[i]; };
  auto const store = [out] __host__ __device__(ds::request_index i, record<2> const& r) {
    out[i] = r;
  };
  ds::workspace scratch{gpu::policy()};
  ds::shade(gpu::policy(), ds::local_sort_then_dispatch<>{}, n, ids.data(),
            ds::record_shaders(load, store, function{0}, function{1}), scratch);
  gpu::wait();
  CHECK(test::first_difference(results, expected) == n);
}
