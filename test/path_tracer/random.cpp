// SPDX-License-Identifier: Apache-2.0
#include "shading/random.hpp"

#include <array>
#include <cmath>
#include <cstdint>

#include "catch.hpp"

using namespace path_tracer;

namespace {

/// Pearson's statistic of `counts` against equal shares, in standard deviations of its mean.
template <std::size_t Bins>
double chi_squared_sigmas(std::array<std::uint32_t, Bins> const& counts) {
  double total = 0;
  for (auto const c : counts) total += c;
  double const expected = total / Bins;
  double sum = 0;
  for (auto const c : counts) sum += (c - expected) * (c - expected) / expected;
  return (sum - (Bins - 1)) / std::sqrt(2.0 * (Bins - 1));
}

}  // namespace

TEST_CASE("random numbers are a function of seed, pixel, sample and index alone", "[random]") {
  random_stream const a(7, 11, 13);
  vec2 const first = a.pair(5);
  (void)a.pair(6);
  CHECK(a.pair(5) == first);
  CHECK(random_stream(7, 11, 13).pair(5) == first);
  CHECK(random_stream(8, 11, 13).pair(5) != first);
  CHECK(random_stream(7, 12, 13).pair(5) != first);
  CHECK(random_stream(7, 11, 14).pair(5) != first);
  CHECK(random_stream(7, 13, 11).pair(5) != first);
}

TEST_CASE("random numbers fill the unit square evenly along every counter", "[random]") {
  int const along = GENERATE(0, 1, 2, 3);
  CAPTURE(along);
  std::array<std::uint32_t, 256> plane{};   // of both numbers of a pair
  std::array<std::uint32_t, 256> serial{};  // of neighbours along the counter
  float before = 0;
  bool in_range = true;
  for (std::uint32_t k = 0; k < 200000; ++k) {
    random_stream const stream(along == 0 ? k : 1, along == 1 ? k : 2, along == 2 ? k : 3);
    vec2 const u = stream.pair(along == 3 ? k : 4);
    in_range = in_range && u.x >= 0 && u.x < 1 && u.y >= 0 && u.y < 1;
    auto const bin = [](float x) { return static_cast<std::size_t>(x * 16); };
    ++plane[bin(u.x) * 16 + bin(u.y)];
    ++serial[bin(before) * 16 + bin(u.x)];
    before = u.x;
  }
  CHECK(in_range);
  CHECK(std::abs(chi_squared_sigmas(plane)) < 5);
  CHECK(std::abs(chi_squared_sigmas(serial)) < 5);
}

TEST_CASE("neighbouring pixels and samples are not correlated", "[random]") {
  double sum = 0;
  int constexpr count = 100000;
  for (std::uint32_t k = 0; k < count; ++k) {
    double const a = double{random_stream(1, k, 0).pair(0).x} - 0.5;
    double const b = double{random_stream(1, k, 1).pair(0).x} - 0.5;
    double const c = double{random_stream(1, k + 1, 0).pair(1).y} - 0.5;
    sum += a * b + a * c;
  }
  // Each product has variance 1 / 144.
  CHECK(std::abs(sum) < 5 * std::sqrt(2.0 * count / 144));
}
