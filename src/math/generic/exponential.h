// SPDX-License-Identifier: MIT
// Exponential, logarithm, power and cube root with nothing but + - * / and scaling by powers of
// two. Errors: exp log cbrt 1 ulp; pow 1 ulp + |y ln x| / 32 ulp; whole powers to 4 by
// multiplication. Results beyond the largest number are the largest number.
// Test: tests/math/elementary_test.cpp
#pragma once

#include "math/generic/trigonometry.h"

namespace rigc::math::generic {

inline constexpr double kSmallest = 0x1p-1074;

// ln 2: 40 bits, and the rest. A whole number below 2^13 times the first is exact.
inline constexpr double kLn2High = 0x1.62e42fefa2p-1;
inline constexpr double kLn2Low = 0x1.9ef35793c7673p-41;

template <class R>
RIGC_INLINE Pair<R> exact_sum(R a, R b) {
  const R high = a + b;
  const R of_b = high - a;
  return {high, (a - (high - of_b)) + (b - of_b)};
}

/// a * b without any error (Veltkamp and Dekker); both below 2^990.
template <class R>
RIGC_INLINE Pair<R> exact_product(R a, R b) {
  const R wide_a = a * 134217729.0, wide_b = b * 134217729.0;
  const R a1 = wide_a - (wide_a - a), b1 = wide_b - (wide_b - b);
  const R a2 = a - a1, b2 = b - b1;
  const R high = a * b;
  return {high, ((a1 * b1 - high) + a1 * b2 + a2 * b1) + a2 * b2};
}

/// e^(high + low), by 2^k * e^r with |r| <= ln 2 / 2 and the series to r^14: truncation below
/// 1e-18.
template <class R>
RIGC_INLINE R exponential(Pair<R> x) {
  const auto above = x.high > 709.79, below = x.high < -745.2;
  const R high = clamped(x.high, -745.2, 709.79);
  const R k = floored(high * 1.4426950408889634 + 0.5);
  const Pair<R> r = exact_sum(high - k * kLn2High, x.low - k * kLn2Low);
  R tail = R(1.0 / 87178291200.0);
  tail = tail * r.high + 1.0 / 6227020800.0;
  tail = tail * r.high + 1.0 / 479001600.0;
  tail = tail * r.high + 1.0 / 39916800.0;
  tail = tail * r.high + 1.0 / 3628800.0;
  tail = tail * r.high + 1.0 / 362880.0;
  tail = tail * r.high + 1.0 / 40320.0;
  tail = tail * r.high + 1.0 / 5040.0;
  tail = tail * r.high + 1.0 / 720.0;
  tail = tail * r.high + 1.0 / 120.0;
  tail = tail * r.high + 1.0 / 24.0;
  tail = tail * r.high + 1.0 / 6.0;
  tail = tail * r.high + 0.5;
  const R rest = r.high * r.high * tail + r.low * (1.0 + r.high);
  const R value = scaled_by_power(1.0 + (r.high + rest), k);
  const R bounded = select(value < kLargest, value, R(kLargest));
  return select(above, R(kLargest), select(below, R(0.0), bounded));
}

template <class R>
RIGC_INLINE R exp(R x) {
  const auto number = x == x;
  return exponential(Pair<R>{select(number, x, R(0.0)), R(0.0)});
}

/// x = 2^exponent * (1 + fraction), 1 + fraction in sqrt(1/2)..sqrt(2); x is positive and finite.
template <class R>
struct Split {
  R fraction, exponent;
};

template <class R>
RIGC_INLINE Split<R> split(R x) {
  const Parts<R> parts = parts_of(x);
  const auto low = parts.mantissa < 0.7071067811865476;
  const R mantissa = select(low, parts.mantissa * 2.0, parts.mantissa);
  return {mantissa - 1.0, parts.exponent - select(low, R(1.0), R(0.0))};
}

/// ln(1 + f) = 2 artanh(s), s = f / (2 + f), |s| <= 0.172: 2 s (1 + s^2 q), q to the term of s^22.
template <class R>
RIGC_INLINE R logarithm_tail(R s_squared) {
  R q = R(2.0 / 25);
  for (int n = 23; n >= 3; n -= 2) q = q * s_squared + 2.0 / n;
  return q;
}

/// ln x as a pair, within 2^-60 of its larger part.
template <class R>
RIGC_INLINE Pair<R> logarithm(R x) {
  const Split<R> parts = split(x);
  const R f = parts.fraction;
  const Pair<R> below = exact_sum(R(2.0), f);
  const R s = f / below.high;
  const Pair<R> product = exact_product(s, below.high);
  const R s_low = (((f - product.high) - product.low) - s * below.low) / below.high;
  const R z = s * s;
  const Pair<R> whole = exact_sum(parts.exponent * kLn2High, 2.0 * s);
  const R low = (whole.low + 2.0 * s_low) + (parts.exponent * kLn2Low + s * z * logarithm_tail(z));
  const R high = whole.high + low;
  return {high, (whole.high - high) + low};
}

/// Of the smallest positive number where x <= 0.
template <class R>
RIGC_INLINE R log(R x) {
  const auto positive = x > 0.0;
  x = clamped(select(positive, x, R(kSmallest)), kSmallest, kLargest);
  const Split<R> parts = split(x);
  const R f = parts.fraction;
  const R s = f / (2.0 + f);
  const R z = s * s;
  // 2 s = f - s f, which keeps the exact f in front.
  const R rest = s * (f - z * logarithm_tail(z));
  return parts.exponent * kLn2High + (f - (rest - parts.exponent * kLn2Low));
}

/// x^y for x > 0 of any size.
template <class R>
RIGC_INLINE R positive_power(R x, R y) {
  const Pair<R> l = logarithm(clamped(x, kSmallest, kLargest));
  const R rough = y * l.high;
  const auto moderate = magnitude(rough) < 800.0;
  // Split products need y below 2^990; a larger one has made `rough` overflow unless ln x is 0.
  const R exponent = select(moderate, y, R(0.0));
  const Pair<R> product = exact_product(l.high, exponent);
  const R value = exponential(Pair<R>{product.high, product.low + l.low * exponent});
  return select(moderate, value, select(rough > 0.0, R(kLargest), R(0.0)));
}

/// For x < 0 only whole y, else 0; 0 to a negative power is 0.
template <class R>
RIGC_INLINE R pow(R x, R y) {
  x = select(x == x, x, R(0.0));
  y = select(y == y, y, R(0.0));
  const R half = y * 0.5, floor = floored(y), half_floor = floored(half), y_size = magnitude(y);
  const auto whole = floor == y;
  const auto odd = whole & (y_size < 0x1p53) & (half_floor != half);
  const R size = magnitude(x);
  const R power = positive_power(select(size > 0.0, size, R(1.0)), y);
  R value = select((x < 0.0) & odd, -power, power);
  value = select((x == 0.0) | ((x < 0.0) & !whole), R(0.0), value);
  const R square = x * x;
  R small = select(y == 2.0, square, x);
  small = select(y == 3.0, square * x, small);
  small = select(y == 4.0, square * square, small);
  small = clamped(small, -kLargest, kLargest);
  value = select(whole & (y > 0.0) & (y <= 4.0), small, value);
  return select((y == 0.0) | (x == 1.0), R(1.0), value);
}

/// Of either sign.
template <class R>
RIGC_INLINE R cbrt(R x) {
  const auto known = (x < 0.0) | (x > 0.0);
  const R size = clamped(select(known, magnitude(x), R(1.0)), kSmallest, kLargest);
  const Parts<R> parts = parts_of(size);
  const R thirds = floored(parts.exponent / 3.0);
  const R near = parts.mantissa * power_of_two(parts.exponent - 3.0 * thirds);  // 0.5..4
  R cube_root = 0.6 + 0.26 * near;                                              // within a quarter
  for (int step = 0; step < 6; ++step)
    cube_root = cube_root - (cube_root - near / (cube_root * cube_root)) / 3.0;
  return select(known, with_sign(scaled_by_power(cube_root, thirds), x), R(0.0));
}

}  // namespace rigc::math::generic
