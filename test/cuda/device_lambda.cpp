// SPDX-License-Identifier: Apache-2.0
// Shaders that the host cannot call.
// Covers detail/device_lambda.hpp.
#include <deferred_shade/schedule.hpp>
#include <deferred_shade/shade.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "catch.hpp"
#include "support/backends.hpp"
#include "support/random_ids.hpp"

namespace ds = deferred_shade;

namespace {

struct on_device_alone {
  std::uint32_t* out;
  __device__ void operator()(ds::request_index i) const { out[i] = 100 + i + (threadIdx.x & 0); }
};

}  // namespace

// A function of its own: nvcc allows no lambda for the device inside a private one.
void check_device_lambda(std::uint32_t n) {
  std::uint32_t const seed = test::run_seed() + n;
  CAPTURE(n, seed);
  auto const exec = test::cuda::policy();
  ds::workspace scratch{exec};
  auto const data = test::make_ids<std::uint8_t>(test::layout::random, n, 2, seed);
  auto const ids = test::on<test::cuda>(data);
  std::vector<std::uint32_t> expected(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    if (data[i] < 2) expected[i] = (data[i] == 0 ? 100 : 200) + i;
  }
  auto out = test::on<test::cuda>(std::vector<std::uint32_t>(n));
  std::uint32_t* const to = out.data();
  auto const lambda = [to] __device__(ds::request_index i) { to[i] = 200 + i + (threadIdx.x & 0); };
  ds::shader_table const shaders{on_device_alone{to}, lambda};
  ds::for_each_schedule([&](char const* name, auto const& schedule) {
    CAPTURE(name);
    std::fill(out.begin(), out.end(), 0U);
    ds::shade(exec, schedule, n, ids.data(), shaders, scratch);
    test::cuda::wait();
    CHECK(std::vector<std::uint32_t>(out.begin(), out.end()) == expected);
  });
}

TEST_CASE("functors and lambdas for the device alone are shaders", "[cuda]") {
  for (std::uint32_t const n : test::some_sizes()) check_device_lambda(n);
}
