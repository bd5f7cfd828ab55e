// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include <deferred_shade/config.hpp>
#include <deferred_shade/detail/bits.hpp>

/// Functions for shaders that run in vectors: those of `<cmath>` are calls, and a loop with a call
/// in it stays scalar. These are made of arithmetic and selections alone, so that a compiler that
/// vectorises a shader vectorises them as well. In CUDA's device code they are CUDA's own.
///
/// They take and give what `<cmath>` has, infinities and NaN included, but for the sign of a zero
/// and what is said of each; errno and the floating-point exceptions mean nothing after them. The
/// errors in units in the last place are those of the host, which test/math.cpp finds against long
/// double; CUDA states its own. Not for -ffast-math, which drops NaN and infinity.
namespace deferred_shade::math {
namespace detail {

inline constexpr float infinity = std::numeric_limits<float>::infinity();
inline constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
inline constexpr float least_normal = (std::numeric_limits<float>::min)();
inline constexpr float largest = (std::numeric_limits<float>::max)();

/// 2 to the power of n, which is -126 to 127.
DEFERRED_SHADE_HOST_DEVICE inline float power_of_two(std::int32_t n) {
  return deferred_shade::detail::bits_as<float>((n + 127) << 23);
}

/// exp(r) * 2^n for |r| <= 0.35, whatever is left of it where that is too small or too large. By
/// exp's series, whose first missing term is under a tenth of an ulp. In two steps, because 2^n
/// alone may be neither a normal number nor finite.
DEFERRED_SHADE_HOST_DEVICE inline float scaled_exp(float r, std::int32_t n) {
  float sum = 1.0F / 5040;
  sum = sum * r + 1.0F / 720;
  sum = sum * r + 1.0F / 120;
  sum = sum * r + 1.0F / 24;
  sum = sum * r + 1.0F / 6;
  sum = sum * r + 0.5F;
  sum = sum * r * r + r + 1;
  std::int32_t const half = n >> 1;
  return sum * power_of_two(half) * power_of_two(n - half);
}

/// log2(x) for finite x > 0, to 1e-10: with x = m 2^e and s = (m - 1) / (m + 1), by the series of
/// ln(m) = 2 artanh(s).
DEFERRED_SHADE_HOST_DEVICE inline double log2_of(float x) {
  bool const tiny = x < least_normal;
  float const normal = tiny ? x * 0x1p23F : x;
  auto const bits = deferred_shade::detail::bits_as<std::int32_t>(normal);
  // m lies between the square roots of 1/2 and 2: 0x3f3504f3 are the bits of the first.
  std::int32_t const e = (bits - 0x3f3504f3) >> 23;
  double const m = deferred_shade::detail::bits_as<float>(bits - e * 0x800000);
  double const s = (m - 1) / (m + 1);
  double const t = s * s;
  double sum = 1.0 / 13;
  sum = sum * t + 1.0 / 11;
  sum = sum * t + 1.0 / 9;
  sum = sum * t + 1.0 / 7;
  sum = sum * t + 1.0 / 5;
  sum = sum * t + 1.0 / 3;
  sum = sum * t + 1;
  double const two_by_ln2 = 2.88539008177792681472;
  return (tiny ? e - 23 : e) + two_by_ln2 * s * sum;
}

/// The sine of x + quarters * pi / 2.
DEFERRED_SHADE_HOST_DEVICE inline float shifted_sine(float x, int quarters) {
  double const wide = x;
  double const n = std::floor(wide * 0.63661977236758134308 + 0.5);
  // pi / 2 in two parts; the first has 33 bits, so that its product with n < 2^20 is exact.
  double const left = wide - n * 1.57079632673412561417 - n * 6.07710050650619224932e-11;
  auto const r = static_cast<float>(left < -0.7854 ? -0.7854 : left > 0.7854 ? 0.7854 : left);
  double const quadrant = n + quarters - 4 * std::floor(0.25 * (n + quarters));
  float const t = r * r;
  float sine = 1.0F / 362880;
  sine = sine * t - 1.0F / 5040;
  sine = sine * t + 1.0F / 120;
  sine = sine * t - 1.0F / 6;
  sine = sine * t * r + r;
  float cosine = -1.0F / 3628800;
  cosine = cosine * t + 1.0F / 40320;
  cosine = cosine * t - 1.0F / 720;
  cosine = cosine * t + 1.0F / 24;
  cosine = cosine * t - 0.5F;
  cosine = cosine * t + 1;
  float const value = quadrant == 1 || quadrant == 3 ? cosine : sine;
  float const result = quadrant >= 2 ? -value : value;
  return std::fabs(x) <= largest ? result : x - x;
}

}  // namespace detail

/// e to the power of x: within 1.1 ulp.
DEFERRED_SHADE_HOST_DEVICE inline float exp(float x) {
#ifdef __CUDA_ARCH__
  return ::expf(x);
#else
  float const some = x == x ? x : 0;
  float const bounded = some < -104 ? -104 : some > 89 ? 89 : some;
  float const n = std::floor(bounded * 1.44269504F + 0.5F);
  // ln 2 in two parts; the first has 9 bits, so that its product with n is exact.
  float const r = bounded - n * 0.693359375F + n * 2.12194440e-4F;
  float const result = detail::scaled_exp(r, static_cast<std::int32_t>(n));
  return x == x ? result : x;
#endif
}

/// The natural logarithm of x: within 0.51 ulp.
DEFERRED_SHADE_HOST_DEVICE inline float log(float x) {
#ifdef __CUDA_ARCH__
  return ::logf(x);
#else
  bool const ordinary = x > 0 && x < detail::infinity;
  auto const result =
      static_cast<float>(0.69314718055994530942 * detail::log2_of(ordinary ? x : 1));
  float const other = x == 0 ? -detail::infinity : x < 0 ? detail::not_a_number : x;
  return ordinary ? result : other;
#endif
}

/// x to the power of y for x >= 0, where -0 is 0, and NaN for x < 0 unless y is 0: within 1.1 ulp.
DEFERRED_SHADE_HOST_DEVICE inline float pow(float x, float y) {
#ifdef __CUDA_ARCH__
  return x < 0 && y != 0 ? ::nanf("") : ::powf(x == 0 ? 0.0F : x, y);
#else
  bool const ordinary = x > 0 && x < detail::infinity;
  double const of_others = x == 0 ? -detail::infinity : x < 0 ? detail::not_a_number : x;
  double const exponent = y * (ordinary ? detail::log2_of(x) : of_others);
  double const some = exponent == exponent ? exponent : 0;
  double const bounded = some < -160 ? -160 : some > 160 ? 160 : some;
  double const n = std::floor(bounded + 0.5);
  auto const r = static_cast<float>((bounded - n) * 0.69314718055994530942);
  float const result = detail::scaled_exp(r, static_cast<std::int32_t>(n));
  float const other = exponent == exponent ? result : detail::not_a_number;
  return y == 0 || x == 1 ? 1 : other;
#endif
}

/// The sine of x: within 1.5 ulp for |x| <= 2^20. Beyond, the error is about |x| * 2^-52, and the
/// result never outside -1 and 1.
DEFERRED_SHADE_HOST_DEVICE inline float sin(float x) {
#ifdef __CUDA_ARCH__
  return ::sinf(x);
#else
  return detail::shifted_sine(x, 0);
#endif
}

/// The cosine of x, as `sin`.
DEFERRED_SHADE_HOST_DEVICE inline float cos(float x) {
#ifdef __CUDA_ARCH__
  return ::cosf(x);
#else
  return detail::shifted_sine(x, 1);
#endif
}

}  // namespace deferred_shade::math
