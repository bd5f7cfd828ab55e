// SPDX-License-Identifier: Apache-2.0
// Sums of 10^7 samples on the device, see hard_accumulation.cpp and accuracy.cpp: each has the bits
// of the sum on the host, and the error that its type states.
#include <thrust/for_each.h>
#include <cstring>
#include <vector>

#include "../../catch.hpp"
#include "../hard_support.hpp"
#include "device_support.hpp"
#include "shading/stages.hpp"

using namespace path_tracer;

namespace {

constexpr std::uint32_t pixels = 4, samples_of_batch = 100000, batches = 100;

/// How far the mean of a sum is off, at worst over the channels.
template <class Sum>
double error_of(Sum const& sum, double exact) {
  double worst = 0;
  for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(double{sum.total[c]} / exact - 1));
  return worst;
}

/// The largest error of a pixel's sum; checks that the device has the bits of the host.
template <class Sum>
double worst_sum(std::vector<vec3> radiance, std::vector<std::uint64_t> const& exact) {
  basic_batch batch{};
  batch.pixels = pixels;
  auto const paths = static_cast<std::uint32_t>(radiance.size());
  std::vector<Sum> on_host(pixels);
  batch.radiance = radiance.data();
  for (std::uint32_t k = 0; k < batches; ++k)
    for (std::uint32_t p = 0; p < pixels; ++p)
      accumulate_samples<Sum>{batch, paths, on_host.data()}(p);

  thrust::device_vector<vec3> samples(radiance.begin(), radiance.end());
  thrust::device_vector<Sum> sums(pixels, Sum{});
  batch.radiance = thrust::raw_pointer_cast(samples.data());
  auto const first = thrust::counting_iterator<request_index>(0);
  for (std::uint32_t k = 0; k < batches; ++k)
    thrust::for_each(thrust::device, first, first + pixels,
                     accumulate_samples<Sum>{batch, paths, thrust::raw_pointer_cast(sums.data())});
  std::vector<Sum> on_device(pixels);
  thrust::copy(sums.begin(), sums.end(), on_device.begin());

  double worst = 0;
  for (std::uint32_t p = 0; p < pixels; ++p) {
    CHECK(std::memcmp(&on_device[p], &on_host[p], sizeof(Sum)) == 0);
    worst = std::max(worst, error_of(on_device[p], static_cast<double>(exact[p]) * 0x1p-23));
  }
  return worst;
}

}  // namespace

TEST_CASE("sums of ten million samples on the device are those of the host", "[hard]") {
  // Of mean about 1; multiples of 2^-23, so that their sum is exact in 64 bits of an integer.
  std::uint64_t const seed = 731;
  fine_numbers n(seed);
  std::vector<vec3> radiance(std::size_t{pixels} * samples_of_batch);
  std::vector<std::uint64_t> exact(pixels);
  for (std::size_t i = 0; i < radiance.size(); ++i) {
    auto const steps = static_cast<std::uint32_t>(n.uniform() * 0x1p24);
    exact[i % pixels] += batches * std::uint64_t{steps};
    radiance[i] = vec3{static_cast<float>(steps) * 0x1p-23f};
  }
  CAPTURE(seed);
  double const in_double = worst_sum<pixel_sum<summation::in_double>>(radiance, exact);
  double const compensated = worst_sum<pixel_sum<summation::compensated>>(radiance, exact);
  double const in_float = worst_sum<pixel_sum<summation::in_float>>(radiance, exact);
  CHECK(in_double < 1e-12);
  CHECK(compensated < 1.2e-7);  // the rounding of the sum itself
  CHECK(in_float > 10 * compensated);
  CHECK(in_float < 1e-3);
}
