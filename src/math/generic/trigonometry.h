// SPDX-License-Identifier: MIT
// Sine, cosine, arc tangent and what follows from them, with nothing but + - * / and sqrt, so that
// the bits are the same everywhere. Coefficients are those of the Taylor series: intervals are
// small enough. Errors: sin cos 1 ulp, tan 2.5, atan 1, atan2 2, asin acos 3 ulp.
// Test: tests/math/elementary_test.cpp
#pragma once

#include "math/math.h"

namespace rigc::math::generic {

inline constexpr double kLargest = 0x1.fffffffffffffp+1023;

// pi / 2 in four pieces; the first three have 33 bits, so that their product with a whole number
// below 2^20 is exact (Cody and Waite).
inline constexpr double kHalfPi1 = 0x1.921fb544p+0;
inline constexpr double kHalfPi2 = 0x1.0b4611a6p-34;
inline constexpr double kHalfPi3 = 0x1.3198a2e0p-69;
inline constexpr double kHalfPi4 = 0x1.b839a252049c1p-104;

// pi / 2 as a sum of two doubles.
inline constexpr double kHalfPiHigh = 0x1.921fb54442d18p+0;
inline constexpr double kHalfPiLow = 0x1.1a62633145c07p-54;

/// NaN is 0, infinities the largest number.
template <class R>
RIGC_INLINE R finite(R x) {
  const R below = select(x > kLargest, R(kLargest), x);
  const R bounded = select(below < -kLargest, R(-kLargest), below);
  return select(x == x, bounded, R(0.0));
}

template <class R>
RIGC_INLINE R clamped(R x, Scalar<R> low, Scalar<R> high) {
  const R above = select(x < low, low, x);
  return select(above > high, high, above);
}

/// high + low, |low| below half a unit in the last place of high.
template <class R>
struct Pair {
  R high, low;
};

/// a - b without any error (Knuth).
template <class R>
RIGC_INLINE Pair<R> exact_difference(R a, R b) {
  const R high = a - b;
  const R of_b = a - high;
  const R of_a = high + of_b;
  return {high, (a - of_a) + (of_b - b)};
}

/// An angle in -45..45 degrees and the number of quarter turns (0..3) that were taken off.
template <class R>
struct Reduced {
  Pair<R> angle;
  R quarter;
};

template <class R>
RIGC_INLINE Reduced<R> reduce(R x) {
  const auto far = !(magnitude(x) <= 1e6);
  if (any(far)) x = select(far, remainder(finite(x), R(4 * kHalfPiHigh)), x);
  const R n = floored(x * (2 / kPi) + 0.5);
  const Pair<R> first = exact_difference(x - n * kHalfPi1, n * kHalfPi2);
  const Pair<R> second = exact_difference(first.high, n * kHalfPi3);
  const R low = (first.low + second.low) - n * kHalfPi4;
  const R high = second.high + low;
  return {{high, (second.high - high) + low}, n - 4.0 * floored(n * 0.25)};
}

template <class R>
RIGC_INLINE Reduced<R> reduce_degrees(R x) {
  x = finite(x);
  const auto far = magnitude(x) > 1e6;
  if (any(far)) x = select(far, remainder(x, R(360.0)), x);
  const R n = floored(x / 90.0 + 0.5);
  return {{(x - n * 90.0) * (kPi / 180), R(0.0)}, n - 4.0 * floored(n * 0.25)};
}

/// Sine of high + low in -pi/4..pi/4, to the term of x^17: truncation below 2e-19 relative.
template <class R>
RIGC_INLINE R sine_near_zero(Pair<R> x) {
  const R z = x.high * x.high;
  R tail = R(1.0 / 355687428096000.0);
  tail = tail * z - 1.0 / 1307674368000.0;
  tail = tail * z + 1.0 / 6227020800.0;
  tail = tail * z - 1.0 / 39916800.0;
  tail = tail * z + 1.0 / 362880.0;
  tail = tail * z - 1.0 / 5040.0;
  tail = tail * z + 1.0 / 120.0;
  tail = tail * z - 1.0 / 6.0;
  return x.high + (x.high * z * tail + x.low * (1.0 - 0.5 * z));
}

/// Cosine of the same, to the term of x^18: truncation below 1e-20.
template <class R>
RIGC_INLINE R cosine_near_zero(Pair<R> x) {
  const R z = x.high * x.high;
  R tail = R(-1.0 / 6402373705728000.0);
  tail = tail * z + 1.0 / 20922789888000.0;
  tail = tail * z - 1.0 / 87178291200.0;
  tail = tail * z + 1.0 / 479001600.0;
  tail = tail * z - 1.0 / 3628800.0;
  tail = tail * z + 1.0 / 40320.0;
  tail = tail * z - 1.0 / 720.0;
  tail = tail * z + 1.0 / 24.0;
  const R half = 0.5 * z;
  const R high = 1.0 - half;
  return high + (((1.0 - high) - half) + (z * z * tail - x.high * x.low));
}

template <class R>
struct SineCosine {
  R sine, cosine;
};

template <class R>
RIGC_INLINE SineCosine<R> sine_cosine(const Reduced<R>& r) {
  const R s = sine_near_zero(r.angle), c = cosine_near_zero(r.angle);
  const R q = r.quarter;
  const auto odd = (q == 1.0) | (q == 3.0);
  const R sine = select(odd, c, s), cosine = select(odd, s, c);
  return {select(q >= 2.0, -sine, sine), select((q == 1.0) | (q == 2.0), -cosine, cosine)};
}

template <class R>
RIGC_INLINE SineCosine<R> sine_cosine(R radians) {
  return sine_cosine(reduce(radians));
}
template <class R>
RIGC_INLINE SineCosine<R> sine_cosine_degrees(R degrees) {
  const SineCosine<R> both = sine_cosine(reduce_degrees(degrees));
  return {both.sine + 0.0, both.cosine + 0.0};  // no -0
}

template <class R>
RIGC_INLINE R tan_degrees(R degrees) {
  const SineCosine<R> both = sine_cosine_degrees(degrees);
  const auto steep = both.cosine == 0.0;
  return select(steep, R(0.0), both.sine / select(steep, R(1.0), both.cosine));
}

/// Arc tangent of k / 8 as high + low.
constexpr double kArcTangentsHigh[] = {
    0,
    0x1.fd5ba9aac2f6ep-4,
    0x1.f5b75f92c80ddp-3,
    0x1.6f61941e4def1p-2,
    0x1.dac670561bb4fp-2,
    0x1.1e00babdefeb4p-1,
    0x1.4978fa3269ee1p-1,
    0x1.700a7c5784634p-1,
    0x1.921fb54442d18p-1,
};
constexpr double kArcTangentsLow[] = {
    0,
    -0x1.cd37686760c17p-59,
    0x1.8ab6e3cf7afbdp-57,
    -0x1.c63aae6f6e918p-56,
    0x1.a2b7f222f65e2p-56,
    -0x1.928df287a668fp-58,
    0x1.2419a87f2a458p-56,
    -0x1.8c34d25aadef6p-56,
    0x1.1a62633145c07p-55,
};

/// Arc tangent of x in 0..1: that of the nearest k/8 is in a table, the rest is at most 1/16, where
/// the series to the term of z^15 is within 2^-66.
template <class R>
RIGC_INLINE Pair<R> arc_tangent(R x) {
  const R k = floored(x * 8.0 + 0.5);
  const R centre = k * 0.125;
  const R z = (x - centre) / (1.0 + x * centre);
  const R s = z * z;
  R tail = R(-1.0 / 15);
  tail = tail * s + 1.0 / 13;
  tail = tail * s - 1.0 / 11;
  tail = tail * s + 1.0 / 9;
  tail = tail * s - 1.0 / 7;
  tail = tail * s + 1.0 / 5;
  tail = tail * s - 1.0 / 3;
  const R table = lookup(kArcTangentsHigh, k);
  const R low = z * s * tail + lookup(kArcTangentsLow, k);
  const R high = table + z;
  return {high, ((table - high) + z) + low};
}

template <class R>
RIGC_INLINE R atan2(R y, R x) {
  y = finite(y);
  x = finite(x);
  const R up = magnitude(y), along = magnitude(x);
  const auto steep = up > along;
  const R larger = select(steep, up, along), smaller = select(steep, along, up);
  const auto somewhere = larger > 0.0;
  const Pair<R> a =
      arc_tangent(select(somewhere, smaller, R(0.0)) / select(somewhere, larger, R(1.0)));
  // The rest of as many quarter turns; steep behind: pi/2 + a, which is pi/2 - (-a).
  const auto behind = with_sign(R(1.0), x) < 0.0;
  const R quarters = select(steep, R(1.0), R(2.0));
  const R turned = select(steep & behind, R(-1.0), R(1.0));
  const Pair<R> rest = exact_difference(quarters * kHalfPiHigh, turned * a.high);
  const R from_quarters = rest.high + (rest.low + (quarters * kHalfPiLow - turned * a.low));
  return with_sign(select(steep | behind, from_quarters, a.high + a.low), y);
}

template <class R>
RIGC_INLINE R asin(R x) {
  x = clamped(finite(x), -1.0, 1.0);
  return atan2(x, root((1.0 - x) * (1.0 + x)));
}
template <class R>
RIGC_INLINE R acos(R x) {
  x = clamped(finite(x), -1.0, 1.0);
  return atan2(root((1.0 - x) * (1.0 + x)), x);
}

template <class R>
RIGC_INLINE R radians(R degrees) {
  return degrees * (kPi / 180);
}
template <class R>
RIGC_INLINE R degrees(R radians) {
  return radians * (180 / kPi);
}

/// Of negative numbers 0.
template <class R>
RIGC_INLINE R sqrt(R x) {
  const auto positive = x > 0.0;
  return root(select(positive, finite(x), R(0.0)));
}

}  // namespace rigc::math::generic
