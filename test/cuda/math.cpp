// SPDX-License-Identifier: Apache-2.0
// The functions of math.hpp in device code, where they are CUDA's own: within the errors that the
// CUDA programming guide states, and with the special cases that math.hpp states.
#include <deferred_shade/math.hpp>

#include <thrust/transform.h>
#include <cmath>
#include <limits>
#include <vector>

#include "catch.hpp"
#include "support/backends.hpp"
#include "support/ulp.hpp"

namespace math = deferred_shade::math;

namespace {

using gpu = test::cuda;
constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

struct exp_of {
  DEFERRED_SHADE_HOST_DEVICE float operator()(float x) const { return math::exp(x); }
  static long double exact(long double x) { return std::exp(x); }
};
struct log_of {
  DEFERRED_SHADE_HOST_DEVICE float operator()(float x) const { return math::log(x); }
  static long double exact(long double x) { return std::log(x); }
};
struct sin_of {
  DEFERRED_SHADE_HOST_DEVICE float operator()(float x) const { return math::sin(x); }
  static long double exact(long double x) { return std::sin(x); }
};
struct cos_of {
  DEFERRED_SHADE_HOST_DEVICE float operator()(float x) const { return math::cos(x); }
  static long double exact(long double x) { return std::cos(x); }
};
struct power {
  float y;
  DEFERRED_SHADE_HOST_DEVICE float operator()(float x) const { return math::pow(x, y); }
  long double exact(long double x) const {
    if (x < 0 && y != 0) return not_a_number;
    return std::pow(x == 0 ? 0 : x, static_cast<long double>(y));
  }
};

/// `bound` is what CUDA states: in units in the last place, from the result rounded correctly,
/// which is half of one from the exact result at most.
template <class Function>
void check_error(char const* name, double bound, Function f, std::vector<float> const& numbers) {
  gpu::vector<float> const in(numbers.begin(), numbers.end());
  gpu::vector<float> out(in.size());
  thrust::transform(gpu::policy(), in.data(), in.data() + in.size(), out.data(), f);
  gpu::wait();
  double worst = 0;
  float at = 0;
  for (std::size_t i = 0; i < in.size(); ++i) {
    double const error = test::error_in_ulp(out[i], f.exact(in[i]));
    if (error > worst) {
      worst = error;
      at = in[i];
    }
  }
  CAPTURE(name, test::run_seed(), at);
  CHECK(worst <= bound + 0.5);
}

std::vector<float> numbers_to_test() {
  std::vector<float> numbers = test::floats_of_all_kinds();
  for (float const x : {0.0F, 1.0F, std::numeric_limits<float>::denorm_min(),
                        std::numeric_limits<float>::max(), infinity, not_a_number}) {
    numbers.push_back(x);
    numbers.push_back(-x);
  }
  return numbers;
}

}  // namespace

TEST_CASE("functions of one number are as exact on a GPU as CUDA says", "[cuda][math]") {
  std::vector<float> const numbers = numbers_to_test();
  check_error("exp", 2, exp_of{}, numbers);
  check_error("log", 1, log_of{}, numbers);
  check_error("sin", 2, sin_of{}, numbers);
  check_error("cos", 2, cos_of{}, numbers);
}

TEST_CASE("powers on a GPU are as exact as CUDA says, and those of negative numbers none",
          "[cuda][math]") {
  std::vector<float> const numbers = numbers_to_test();
  for (float const y : {0.5F, 2.0F, -1.0F, 5.0F, 1 / 2.4F, -17.3F, 1000.0F, 1e-6F, 1e30F, 0.0F,
                        infinity, -infinity, not_a_number}) {
    CAPTURE(y);
    check_error("pow", 4, power{y}, numbers);
  }
}
