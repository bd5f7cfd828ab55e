// SPDX-License-Identifier: Apache-2.0
// Covers detail/bits.hpp.
#include <deferred_shade/math.hpp>

#include <cmath>
#include <cstdint>
#include <limits>

#include "catch.hpp"
#include "support/random_ids.hpp"
#include "support/ulp.hpp"

namespace math = deferred_shade::math;
using test::error_in_ulp;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

struct worst {
  double error;
  float at;
};

/// The largest error of `f` over floats of all kinds; those beyond `limit` are left out.
template <class Function, class Exact>
worst worst_error(Function f, Exact exact, float limit = not_a_number) {
  worst result{0, 0};
  for (float const x : test::floats_of_all_kinds()) {
    if (std::fabs(x) > limit) continue;
    double const error = error_in_ulp(f(x), exact(x));
    if (error > result.error) result = {error, x};
  }
  return result;
}

template <class Function, class Exact>
void check_error(double bound, Function f, Exact exact, float limit = not_a_number) {
  auto const [error, at] = worst_error(f, exact, limit);
  CAPTURE(test::run_seed(), at);
  CHECK(error <= bound);
}

/// Whether two results are the same number, or both are none.
bool same(float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); }

}  // namespace

TEST_CASE("an error is counted in units in the last place", "[math]") {
  CHECK(error_in_ulp(1, 1) == 0.5);
  CHECK(error_in_ulp(1 + 0x1p-23F, 1) == 1);
  CHECK(error_in_ulp(0x1p-149F, 0) == 1);
  CHECK(error_in_ulp(infinity, 1e50L) == 0.5);
  CHECK(error_in_ulp(not_a_number, 1) == infinity);
  CHECK(error_in_ulp(infinity, 1) == infinity);
}

TEST_CASE("functions of one number are as exact as they say", "[math]") {
  using extended = long double;
  check_error(1.1, math::exp, [](float x) { return std::exp(extended{x}); });
  check_error(0.51, math::log, [](float x) { return std::log(extended{x}); });
  check_error(
      1.5, math::sin, [](float x) { return std::sin(extended{x}); }, 0x1p20F);
  check_error(
      1.5, math::cos, [](float x) { return std::cos(extended{x}); }, 0x1p20F);
}

TEST_CASE("powers are as exact as they say", "[math]") {
  using extended = long double;
  for (float const y : {0.5F, 2.0F, -1.0F, 5.0F, 1 / 2.4F, -17.3F, 1000.0F, 1e-6F, 1e30F, 0.0F,
                        infinity, -infinity, not_a_number}) {
    CAPTURE(y);
    check_error(
        1.1, [y](float x) { return math::pow(std::fabs(x), y); },
        [y](float x) { return std::pow(extended{std::fabs(x)}, extended{y}); });
  }
  CHECK(std::isnan(math::pow(-2, 2)));
  CHECK(math::pow(-2, 0) == 1);
}

TEST_CASE("powers of and by the ends of numbers go where <cmath> has them", "[math]") {
  float const least = std::numeric_limits<float>::denorm_min();
  float const most = std::numeric_limits<float>::max();
  float const before_one = 1 - 0x1p-24F;
  for (float const x : {0.0F, least, before_one, 1.0F, 2.0F, most, infinity, not_a_number}) {
    for (float const y : {0.0F, -0.0F, least, 1.0F, -1.0F, 3.0F, 149.0F, -149.0F, 151.0F, -151.0F,
                          most, -most, infinity, -infinity, not_a_number}) {
      CAPTURE(x, y);
      CHECK(error_in_ulp(math::pow(x, y), std::pow(static_cast<long double>(x),
                                                   static_cast<long double>(y))) <= 1.1);
      CHECK(same(math::pow(-x, y), y == 0 ? 1 : x == 0 ? math::pow(x, y) : not_a_number));
    }
  }
}

TEST_CASE("numbers at the ends go where <cmath> has them", "[math]") {
  float const least = std::numeric_limits<float>::denorm_min();
  float const most = std::numeric_limits<float>::max();
  for (float const x :
       {0.0F, -0.0F, 1.0F, -1.0F, least, -least, most, -most, infinity, -infinity, not_a_number}) {
    CAPTURE(x);
    CHECK(same(math::exp(x), std::exp(x)));
    CHECK(error_in_ulp(math::log(x), std::log(static_cast<long double>(x))) <= 0.51);
    if (!std::isfinite(x)) {
      CHECK(std::isnan(math::sin(x)));
      CHECK(std::isnan(math::cos(x)));
    }
  }
  CHECK(math::sin(0) == 0);
  CHECK(math::cos(0) == 1);
}

TEST_CASE("sines of large numbers stay what sines can be", "[math]") {
  std::uint32_t const first = 0x49800000;  // 2^20
  std::uint32_t const end = 0x7f800000;    // infinity
  std::uint32_t const stride = 4001;
  CAPTURE(test::run_seed());
  for (std::uint32_t bits = first + test::run_seed() % stride; bits < end; bits += stride) {
    auto const x = test::float_of(bits);
    CAPTURE(x);
    double const allowed = 2e-7 + static_cast<double>(x) * 0x1p-51;
    REQUIRE(std::fabs(math::sin(x) - std::sin(static_cast<double>(x))) <= allowed);
    REQUIRE(std::fabs(math::cos(x) - std::cos(static_cast<double>(x))) <= allowed);
    REQUIRE(std::fabs(math::sin(x)) <= 1);
    REQUIRE(std::fabs(math::cos(-x)) <= 1);
  }
}
