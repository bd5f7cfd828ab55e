// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

#include <deferred_shade/config.hpp>
#include <deferred_shade/detail/bits.hpp>

/// Functions that a compiler can vectorise together with the shader that calls them. Functions of
/// `<cmath>` are library calls, and a loop with a call stays scalar. These are made of arithmetic
/// on numbers and on their bits alone. They compare no floats: compilers turn a comparison into a
/// branch first, and may give a known argument, such as the 0 of `std::max(c, 0.0F)`, a path of its
/// own. In device code they call CUDA's functions.
///
/// Results match `<cmath>`, including infinities and NaN, except for signed zero and as noted.
/// errno and the floating-point flags are unspecified. Errors are in units in the last place (ulp)
/// and hold on the host; test/math.cpp compares with long double. CUDA documents its own. Do not
/// compile with -ffast-math, which drops NaN and infinity.
namespace deferred_shade::math {
namespace detail {

using deferred_shade::detail::bits_as;

inline constexpr std::uint32_t sign_bit = 0x80000000;
inline constexpr std::uint32_t bits_of_one = 0x3f800000;
inline constexpr std::uint32_t bits_of_infinity = 0x7f800000;

/// All bits if the highest bit of `word` is set, else none.
DEFERRED_SHADE_HOST_DEVICE inline std::uint32_t mask_of_sign(std::uint32_t word) {
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(word) >> 31);
}

/// All bits if `word` is 0, else none.
DEFERRED_SHADE_HOST_DEVICE inline std::uint32_t mask_of_zero(std::uint32_t word) {
  return detail::mask_of_sign(~word & (word - 1));
}

/// The bits of `a` where those of `mask` are set, and the bits of `b` elsewhere.
DEFERRED_SHADE_HOST_DEVICE inline std::uint32_t select(std::uint32_t mask, std::uint32_t a,
                                                       std::uint32_t b) {
  return (a & mask) | (b & ~mask);
}

/// x clamped to a magnitude of at most `limit`, which is positive. NaN becomes `limit` or -`limit`.
DEFERRED_SHADE_HOST_DEVICE inline float clamp(float x, float limit) {
  auto const bits = detail::bits_as<std::uint32_t>(x);
  auto const magnitude = static_cast<std::int32_t>(bits & ~sign_bit);
  auto const most = detail::bits_as<std::int32_t>(limit);
  auto const least = static_cast<std::uint32_t>(magnitude < most ? magnitude : most);
  return detail::bits_as<float>((bits & sign_bit) | least);
}

/// NaN if `x` is, else `result`.
DEFERRED_SHADE_HOST_DEVICE inline float nan_or(float x, float result) {
  std::uint32_t const magnitude = detail::bits_as<std::uint32_t>(x) & ~sign_bit;
  std::uint32_t const is_nan = detail::mask_of_sign(bits_of_infinity - magnitude);
  return detail::bits_as<float>(detail::bits_as<std::uint32_t>(result) | is_nan);
}

/// 2 to the power of n, which is -126 to 127.
DEFERRED_SHADE_HOST_DEVICE inline float power_of_two(std::int32_t n) {
  return detail::bits_as<float>((n + 127) << 23);
}

/// exp(r) * 2^n for |r| <= 0.35 and |n| <= 160: subnormal or 0 if that is too small, infinity if it
/// is too large. Uses the series of exp; the first term left out is under a tenth of an ulp.
/// Multiplies in two steps, because 2^n alone may be subnormal or infinite. Processors may be slow
/// at products that underflow, so those that become 0 are not computed.
DEFERRED_SHADE_HOST_DEVICE inline float scaled_exp(float r, std::int32_t n) {
  float sum = 1.0F / 5040;
  sum = sum * r + 1.0F / 720;
  sum = sum * r + 1.0F / 120;
  sum = sum * r + 1.0F / 24;
  sum = sum * r + 1.0F / 6;
  sum = sum * r + 0.5F;
  sum = sum * r * r + r + 1;
  std::uint32_t const is_0 = detail::mask_of_sign(static_cast<std::uint32_t>(n + 151));
  auto const some = static_cast<std::int32_t>(static_cast<std::uint32_t>(n) & ~is_0);
  std::int32_t const half = some >> 1;
  float const result = sum * power_of_two(half) * power_of_two(some - half);
  return detail::bits_as<float>(detail::bits_as<std::uint32_t>(result) & ~is_0);
}

/// The log2 of the finite, positive number with the bits `x`, to 1e-10. If the number is m 2^e and
/// s = (m - 1) / (m + 1), this is the series of ln(m) = 2 artanh(s).
DEFERRED_SHADE_HOST_DEVICE inline double log2_of(std::uint32_t x) {
  // Subnormal numbers are multiplied by 2^23.
  std::uint32_t const tiny = detail::mask_of_sign(x - 0x00800000);
  float const scale = detail::bits_as<float>(bits_of_one + (tiny & 23U << 23));
  auto const bits = detail::bits_as<std::int32_t>(detail::bits_as<float>(x) * scale);
  // m lies between the square roots of 1/2 and 2: 0x3f3504f3 are the bits of the first.
  std::int32_t const e = (bits - 0x3f3504f3) >> 23;
  double const m = detail::bits_as<float>(bits - e * 0x800000);
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
  return (e - static_cast<std::int32_t>(tiny & 23)) + two_by_ln2 * s * sum;
}

/// log2(x) for every x. If `finite` has all bits, the result is finite for every x.
DEFERRED_SHADE_HOST_DEVICE inline double log2_of_any(float x, std::uint32_t finite) {
  auto const bits = detail::bits_as<std::uint32_t>(x);
  // Finite and positive: bits from 1 to those before infinity's.
  std::uint32_t const ordinary =
      detail::mask_of_sign(~(bits | (bits - 1)) & (bits - bits_of_infinity));
  // Minus infinity for 0, NaN below it, and x above it.
  std::uint32_t const others =
      detail::select(detail::mask_of_zero(bits & ~sign_bit), sign_bit | bits_of_infinity,
                     bits | detail::mask_of_sign(bits));
  // One of the two terms is 0.
  return detail::log2_of(detail::select(ordinary, bits, bits_of_one)) +
         static_cast<double>(detail::bits_as<float>(others & ~(ordinary | finite)));
}

/// The sine of x + quarters * pi / 2.
DEFERRED_SHADE_HOST_DEVICE inline float shifted_sine(float x, std::int32_t quarters) {
  auto const bits = detail::bits_as<std::uint32_t>(x);
  std::uint32_t const is_finite = detail::mask_of_sign((bits & ~sign_bit) - bits_of_infinity);
  double const wide = detail::bits_as<float>(bits & is_finite);
  double const n = std::floor(wide * 0.63661977236758134308 + 0.5);
  // pi / 2 in two parts; the first has 33 bits, hence its product with n < 2^20 is exact.
  double const left = wide - n * 1.57079632673412561417 - n * 6.07710050650619224932e-11;
  float const r = detail::clamp(static_cast<float>(left), 0.7854F);
  double const turns = std::floor(0.25 * (n + quarters));
  auto const quadrant =
      static_cast<std::uint32_t>(static_cast<std::int32_t>(n + quarters - 4 * turns));
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
  std::uint32_t const value =
      detail::select(detail::mask_of_sign(quadrant << 31), detail::bits_as<std::uint32_t>(cosine),
                     detail::bits_as<std::uint32_t>(sine));
  // Two quadrants are negative. x - x is 0, or NaN for infinities and NaN.
  return detail::bits_as<float>(value ^ (quadrant << 30 & sign_bit)) + (x - x);
}

}  // namespace detail

/// e to the power of x, within 1.1 ulp.
DEFERRED_SHADE_HOST_DEVICE inline float exp(float x) {
#ifdef __CUDA_ARCH__
  return ::expf(x);
#else
  float const bounded = detail::clamp(x, 110);
  float const n = std::floor(bounded * 1.44269504F + 0.5F);
  // ln 2 in two parts; the first has 9 bits, hence its product with n is exact.
  float const r = bounded - n * 0.693359375F + n * 2.12194440e-4F;
  return detail::nan_or(x, detail::scaled_exp(r, static_cast<std::int32_t>(n)));
#endif
}

/// The natural logarithm of x, within 0.51 ulp.
DEFERRED_SHADE_HOST_DEVICE inline float log(float x) {
#ifdef __CUDA_ARCH__
  return ::logf(x);
#else
  return static_cast<float>(0.69314718055994530942 * detail::log2_of_any(x, 0));
#endif
}

/// x to the power of y, within 1.1 ulp, for x >= 0; -0 counts as 0. NaN for x < 0, except if y is
/// 0.
DEFERRED_SHADE_HOST_DEVICE inline float pow(float x, float y) {
#ifdef __CUDA_ARCH__
  return x < 0 && y != 0 ? ::nanf("") : ::powf(x == 0 ? 0.0F : x, y);
#else
  // The exponent is 0 if y is 0 or x is 1, whatever the other one is.
  auto const bits = detail::bits_as<std::uint32_t>(y);
  std::uint32_t const y_is_0 = detail::mask_of_zero(bits & ~detail::sign_bit);
  std::uint32_t const x_is_1 =
      detail::mask_of_zero(detail::bits_as<std::uint32_t>(x) ^ detail::bits_of_one);
  double const exponent =
      static_cast<double>(detail::bits_as<float>(bits & ~x_is_1)) * detail::log2_of_any(x, y_is_0);
  auto const narrow = static_cast<float>(exponent);
  float const n = std::floor(detail::clamp(narrow, 160) + 0.5F);
  // Above 160, r is some positive number, and the result is infinity; below -160, the result is 0.
  auto const r = static_cast<float>((exponent - static_cast<double>(n)) * 0.69314718055994530942);
  float const result = detail::scaled_exp(r, static_cast<std::int32_t>(n));
  return detail::nan_or(narrow, result);
#endif
}

/// The sine of x, within 1.5 ulp for |x| <= 2^20. Beyond that, the error is about |x| * 2^-52, and
/// the result stays between -1 and 1.
DEFERRED_SHADE_HOST_DEVICE inline float sin(float x) {
#ifdef __CUDA_ARCH__
  return ::sinf(x);
#else
  return detail::shifted_sine(x, 0);
#endif
}

/// The cosine of x, with the errors of `sin`.
DEFERRED_SHADE_HOST_DEVICE inline float cos(float x) {
#ifdef __CUDA_ARCH__
  return ::cosf(x);
#else
  return detail::shifted_sine(x, 1);
#endif
}

}  // namespace deferred_shade::math
