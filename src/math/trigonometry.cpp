// SPDX-License-Identifier: MIT
// Sine, cosine, arc tangent and what follows from them, with nothing but + - * / and sqrt, so that
// the bits are the same everywhere. Coefficients are those of the Taylor series: intervals are
// small enough. Errors: sin cos 1 ulp, tan 2.5, atan 1, atan2 2, asin acos 3 ulp.
// Test: tests/math/elementary_test.cpp
#include <cmath>

#include "math/math.h"

namespace rigc::math {

namespace {

// pi / 2 in four pieces; the first three have 33 bits, so that their product with a whole number
// below 2^20 is exact (Cody and Waite).
constexpr double kHalfPi1 = 0x1.921fb544p+0;
constexpr double kHalfPi2 = 0x1.0b4611a6p-34;
constexpr double kHalfPi3 = 0x1.3198a2e0p-69;
constexpr double kHalfPi4 = 0x1.b839a252049c1p-104;

// pi / 2 as a sum of two doubles.
constexpr double kHalfPiHigh = 0x1.921fb54442d18p+0;
constexpr double kHalfPiLow = 0x1.1a62633145c07p-54;

double finite(double x) {
  if (std::isnan(x)) return 0;
  return x > 0x1.fffffffffffffp+1023    ? 0x1.fffffffffffffp+1023
         : x < -0x1.fffffffffffffp+1023 ? -0x1.fffffffffffffp+1023
                                        : x;
}

// high + low, |low| below half a unit in the last place of high.
struct Pair {
  double high, low;
};

// a - b without any error (Knuth).
Pair exact_difference(double a, double b) {
  const double high = a - b;
  const double of_b = a - high;
  const double of_a = high + of_b;
  return {high, (a - of_a) + (of_b - b)};
}

// An angle in -45..45 degrees and the number of quarter turns (0..3) that were taken off.
struct Reduced {
  Pair angle;
  int quarter;
};

Reduced reduce(double x) {
  if (!(std::fabs(x) <= 1e6)) x = std::fmod(finite(x), 4 * kHalfPiHigh);
  if (std::fabs(x) <= 0.78) return {{x, 0}, 0};
  const double n = std::floor(x * (2 / kPi) + 0.5);
  const Pair first = exact_difference(x - n * kHalfPi1, n * kHalfPi2);
  const Pair second = exact_difference(first.high, n * kHalfPi3);
  const double low = (first.low + second.low) - n * kHalfPi4;
  const double high = second.high + low;
  return {{high, (second.high - high) + low}, static_cast<int>(n - 4 * std::floor(n / 4))};
}

Reduced reduce_degrees(double x) {
  x = finite(x);
  if (std::fabs(x) > 1e6) x = std::fmod(x, 360.0);
  const double n = std::floor(x / 90 + 0.5);
  const double r = (x - n * 90) * (kPi / 180);
  return {{r, 0}, static_cast<int>(n - 4 * std::floor(n / 4))};
}

// Sine of high + low in -pi/4..pi/4, to the term of x^17: truncation below 2e-19 relative.
double sine_near_zero(Pair x) {
  const double z = x.high * x.high;
  double tail = 1.0 / 355687428096000.0;
  tail = tail * z - 1.0 / 1307674368000.0;
  tail = tail * z + 1.0 / 6227020800.0;
  tail = tail * z - 1.0 / 39916800.0;
  tail = tail * z + 1.0 / 362880.0;
  tail = tail * z - 1.0 / 5040.0;
  tail = tail * z + 1.0 / 120.0;
  tail = tail * z - 1.0 / 6.0;
  return x.high + (x.high * z * tail + x.low * (1 - 0.5 * z));
}

// Cosine of the same, to the term of x^18: truncation below 1e-20.
double cosine_near_zero(Pair x) {
  const double z = x.high * x.high;
  double tail = -1.0 / 6402373705728000.0;
  tail = tail * z + 1.0 / 20922789888000.0;
  tail = tail * z - 1.0 / 87178291200.0;
  tail = tail * z + 1.0 / 479001600.0;
  tail = tail * z - 1.0 / 3628800.0;
  tail = tail * z + 1.0 / 40320.0;
  tail = tail * z - 1.0 / 720.0;
  tail = tail * z + 1.0 / 24.0;
  const double half = 0.5 * z;
  const double high = 1 - half;
  return high + (((1 - high) - half) + (z * z * tail - x.high * x.low));
}

double sine(const Reduced& r, int quarter) {
  const double value = quarter & 1 ? cosine_near_zero(r.angle) : sine_near_zero(r.angle);
  return quarter & 2 ? -value : value;
}

// Arc tangent of k / 8 as high + low.
constexpr Pair kArcTangents[] = {
    {0, 0},
    {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
    {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
    {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
    {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
    {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
    {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
    {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
    {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55},
};

// Arc tangent of x in 0..1: that of the nearest k/8 is in a table, the rest is at most 1/16, where
// the series to the term of z^15 is within 2^-66.
Pair arc_tangent(double x) {
  const int k = static_cast<int>(x * 8 + 0.5);
  const double centre = k / 8.0;
  const double z = (x - centre) / (1 + x * centre);
  const double s = z * z;
  double tail = -1.0 / 15;
  tail = tail * s + 1.0 / 13;
  tail = tail * s - 1.0 / 11;
  tail = tail * s + 1.0 / 9;
  tail = tail * s - 1.0 / 7;
  tail = tail * s + 1.0 / 5;
  tail = tail * s - 1.0 / 3;
  const double low = z * s * tail + kArcTangents[k].low;
  const double high = kArcTangents[k].high + z;
  return {high, ((kArcTangents[k].high - high) + z) + low};
}

// times * pi / 2 - a.
double from_quarters(int times, Pair a) {
  const Pair difference = exact_difference(times * kHalfPiHigh, a.high);
  return difference.high + (difference.low + (times * kHalfPiLow - a.low));
}

}  // namespace

double sqrt(double x) { return x > 0 ? std::sqrt(finite(x)) : 0; }

double sin(double radians) {
  const Reduced r = reduce(radians);
  return sine(r, r.quarter);
}

double cos(double radians) {
  const Reduced r = reduce(radians);
  return sine(r, r.quarter + 1);
}

double tan(double radians) {
  const Reduced r = reduce(radians);
  const double c = sine(r, r.quarter + 1);
  return sine(r, r.quarter) / c;
}

double sin_degrees(double degrees) {
  const Reduced r = reduce_degrees(degrees);
  return sine(r, r.quarter) + 0.0;
}

double cos_degrees(double degrees) {
  const Reduced r = reduce_degrees(degrees);
  return sine(r, r.quarter + 1) + 0.0;
}

double tan_degrees(double degrees) {
  const Reduced r = reduce_degrees(degrees);
  const double c = sine(r, r.quarter + 1);
  return c == 0 ? 0 : sine(r, r.quarter) / c;
}

double atan2(double y, double x) {
  y = finite(y);
  x = finite(x);
  const double up = std::fabs(y), along = std::fabs(x);
  const bool steep = up > along;
  const double larger = steep ? up : along, smaller = steep ? along : up;
  const Pair a = arc_tangent(larger > 0 ? smaller / larger : 0);
  double angle;
  if (std::signbit(x)) {
    // steep: pi/2 + a, which is pi/2 - (-a).
    angle = steep ? from_quarters(1, {-a.high, -a.low}) : from_quarters(2, a);
  } else {
    angle = steep ? from_quarters(1, a) : a.high + a.low;
  }
  return std::copysign(angle, y);
}

double atan(double x) { return atan2(x, 1); }

double asin(double x) {
  x = x > 1 ? 1 : x < -1 ? -1 : finite(x);
  return atan2(x, sqrt((1 - x) * (1 + x)));
}

double acos(double x) {
  x = x > 1 ? 1 : x < -1 ? -1 : finite(x);
  return atan2(sqrt((1 - x) * (1 + x)), x);
}

}  // namespace rigc::math
