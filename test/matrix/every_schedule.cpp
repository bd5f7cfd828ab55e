// SPDX-License-Identifier: Apache-2.0
// What scripts/matrix compiles, and runs where no GPU is needed: every schedule over index shaders
// and over record shaders. Exits with 0 if all results are right.
#include <thrust/device_vector.h>
#include <thrust/execution_policy.h>
#include <thrust/fill.h>
#include <thrust/host_vector.h>
#include <cstdint>
#include <cstdio>
#include <deferred_shade/deferred_shade.hpp>
#include <deferred_shade/math.hpp>

#include "support/every_schedule.hpp"

namespace ds = deferred_shade;

namespace {

struct request {
  float x;
  float y;
};

struct sum {
  DEFERRED_SHADE_HOST_DEVICE float operator()(request const& r) const { return r.x + r.y; }
};
struct product {
  float factor;
  DEFERRED_SHADE_HOST_DEVICE float operator()(request const& r) const { return factor * r.x * r.y; }
};
struct power {
  DEFERRED_SHADE_HOST_DEVICE float operator()(request const& r) const {
    return ds::math::pow(r.x > 0 ? r.x : 0, 0) * r.y;
  }
};

/// The same as an index shader.
template <class Function>
struct indexed {
  request const* requests;
  float* results;
  Function function;
  DEFERRED_SHADE_HOST_DEVICE void operator()(ds::request_index i) const {
    results[i] = function(requests[i]);
  }
};

constexpr std::uint32_t count = 1000;

/// What a request of this number has to give.
float expected(std::uint32_t i) {
  auto const x = static_cast<float>(i % 7);
  float const y = 2;
  return i % 4 == 0 ? x + y : i % 4 == 1 ? 3 * x * y : i % 4 == 2 ? y : -1;
}

template <class Schedule, class Shaders>
bool right(Schedule const& schedule, Shaders const& shaders,
           thrust::device_vector<std::uint8_t> const& ids, thrust::device_vector<float>& results) {
  thrust::fill(thrust::device, results.begin(), results.end(), -1.0F);
  ds::workspace scratch{thrust::device};
  ds::shade(thrust::device, schedule, ids.size(), thrust::raw_pointer_cast(ids.data()), shaders,
            scratch);
  thrust::host_vector<float> const host = results;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (host[i] != expected(i)) {
      std::printf("request %u: %g instead of %g\n", i, static_cast<double>(host[i]),
                  static_cast<double>(expected(i)));
      return false;
    }
  }
  return true;
}

}  // namespace

int main() {
  thrust::host_vector<std::uint8_t> host_ids(count);
  thrust::host_vector<request> host_requests(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    host_ids[i] = static_cast<std::uint8_t>(i % 4);  // 3 has no shader
    host_requests[i] = request{static_cast<float>(i % 7), 2};
  }
  thrust::device_vector<std::uint8_t> const ids = host_ids;
  thrust::device_vector<request> const requests = host_requests;
  thrust::device_vector<float> results(count);
  request const* const in = thrust::raw_pointer_cast(requests.data());
  float* const out = thrust::raw_pointer_cast(results.data());

  bool all_right = true;
  test::for_each_schedule([&](auto const& schedule) {
    ds::shader_table const table{indexed<sum>{in, out, {}}, indexed<product>{in, out, {3}},
                                 indexed<power>{in, out, {}}};
    all_right = right(schedule, table, ids, results) && all_right;
    auto const records = ds::record_shaders(in, out, sum{}, product{3}, power{});
    all_right = right(schedule, records, ids, results) && all_right;
  });
  std::printf("%s\n", all_right ? "all right" : "wrong");
  return all_right ? 0 : 1;
}
