// SPDX-License-Identifier: Apache-2.0
#pragma once

// Random numbers and worst cases on the device, for the hard cases that run there.

#include <thrust/device_vector.h>
#include <thrust/execution_policy.h>
#include <thrust/functional.h>
#include <thrust/iterator/counting_iterator.h>
#include <thrust/transform_reduce.h>
#include <cmath>
#include <cstdint>
#include <limits>

#include "scene/math.hpp"
#include "shading/random.hpp"

namespace path_tracer {

/// Inputs of each test.
inline constexpr std::uint64_t many = 10'000'000;

/// The numbers in double of input number `i`; see fine_numbers, which is for the host.
class device_numbers {
 public:
  PT_HD device_numbers(std::uint64_t seed, std::uint64_t i)
      : state_(mix_bits(mix_bits(seed) + i)) {}
  PT_HD double uniform() {
    state_ += 0x9e3779b97f4a7c15u;
    return static_cast<double>(mix_bits(state_) >> 11) * 0x1p-53;
  }
  /// From `low` to `high`, uniform in the logarithm.
  PT_HD double over_decades(double low, double high) {
    return low * std::pow(high / low, uniform());
  }
  PT_HD double angle() { return 6.283185307179586 * uniform(); }
  PT_HD glm::dvec3 on_sphere() {
    double const z = 2 * uniform() - 1, phi = angle();
    double const r = std::sqrt((1 - z) * (1 + z));
    return {r * std::cos(phi), r * std::sin(phi), z};
  }
  PT_HD std::uint32_t below(std::uint32_t count) {
    auto const k = static_cast<std::uint32_t>(uniform() * count);
    return k < count ? k : count - 1;
  }

 private:
  std::uint64_t state_;
};

/// What is wrong counts as infinite, and so does an error that is not a number.
inline constexpr double wrong = std::numeric_limits<double>::infinity();
template <class Function>
struct without_nan {
  Function f;
  PT_HD double operator()(std::uint64_t i) const {
    double const error = f(i);
    return error == error ? error : wrong;
  }
};

/// The largest of f(0), f(1), ..., f(count - 1), all computed on the device, or 0.
template <class Function>
double worst_on_device(Function const& f, std::uint64_t count = many) {
  auto const first = thrust::counting_iterator<std::uint64_t>(0);
  return thrust::transform_reduce(thrust::device, first, first + static_cast<std::int64_t>(count),
                                  without_nan<Function>{f}, 0.0, thrust::maximum<double>{});
}

/// Their sum, of whole numbers.
template <class Function>
std::uint64_t sum_on_device(Function const& f, std::uint64_t count = many) {
  auto const first = thrust::counting_iterator<std::uint64_t>(0);
  return thrust::transform_reduce(thrust::device, first, first + static_cast<std::int64_t>(count),
                                  f, std::uint64_t{0}, thrust::plus<std::uint64_t>{});
}

/// How much `found` is off, in multiples of `exact`, beyond what is `next_to_nothing`.
PT_HD inline double relative_error(double found, double exact, double next_to_nothing = 0) {
  double const off = std::abs(found - exact);
  return off <= next_to_nothing ? 0 : off / std::abs(exact);
}

}  // namespace path_tracer
