// SPDX-License-Identifier: MIT
// Exponential, logarithm, power and cube root with nothing but + - * / and scaling by powers of
// two. Errors: exp log cbrt 1 ulp; pow 1 ulp + |y ln x| / 32 ulp; whole powers to 4 by
// multiplication. Results beyond the largest number are the largest number.
// Test: tests/math/elementary_test.cpp
#include <cmath>

#include "math/math.h"

namespace rigc::math {

namespace {

constexpr double kLargest = 0x1.fffffffffffffp+1023;
constexpr double kSmallest = 0x1p-1074;

// ln 2: 40 bits, and the rest. A whole number below 2^13 times the first is exact.
constexpr double kLn2High = 0x1.62e42fefa2p-1;
constexpr double kLn2Low = 0x1.9ef35793c7673p-41;

struct Pair {
  double high, low;
};

Pair exact_sum(double a, double b) {
  const double high = a + b;
  const double of_b = high - a;
  return {high, (a - (high - of_b)) + (b - of_b)};
}

// a * b without any error (Veltkamp and Dekker); both below 2^990.
Pair exact_product(double a, double b) {
  const double wide_a = a * 134217729.0, wide_b = b * 134217729.0;
  const double a1 = wide_a - (wide_a - a), b1 = wide_b - (wide_b - b);
  const double a2 = a - a1, b2 = b - b1;
  const double high = a * b;
  return {high, ((a1 * b1 - high) + a1 * b2 + a2 * b1) + a2 * b2};
}

// e^(high + low), by 2^k * e^r with |r| <= ln 2 / 2 and the series to r^14: truncation below 1e-18.
double exponential(Pair x) {
  if (x.high > 709.79) return kLargest;
  if (x.high < -745.2) return 0;
  const double k = std::floor(x.high * 1.4426950408889634 + 0.5);
  const Pair r = exact_sum(x.high - k * kLn2High, x.low - k * kLn2Low);
  double tail = 1.0 / 87178291200.0;
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
  const double rest = r.high * r.high * tail + r.low * (1 + r.high);
  const double value = 1 + (r.high + rest);
  const double scaled = std::ldexp(value, static_cast<int>(k));
  return scaled < kLargest ? scaled : kLargest;
}

// x = 2^exponent * (1 + fraction), 1 + fraction in sqrt(1/2)..sqrt(2); x is positive and finite.
struct Split {
  double fraction;
  double exponent;
};

Split split(double x) {
  int exponent = 0;
  double mantissa = std::frexp(x, &exponent);
  if (mantissa < 0.7071067811865476) {
    mantissa *= 2;
    --exponent;
  }
  return {mantissa - 1, static_cast<double>(exponent)};
}

// ln(1 + f) = 2 artanh(s), s = f / (2 + f), |s| <= 0.172: 2 s (1 + s^2 q), q to the term of s^22.
double logarithm_tail(double s_squared) {
  double q = 2.0 / 25;
  for (int n = 23; n >= 3; n -= 2) q = q * s_squared + 2.0 / n;
  return q;
}

// ln x as a pair, within 2^-60 of its larger part.
Pair logarithm(double x) {
  const Split parts = split(x);
  const double f = parts.fraction;
  const Pair below = exact_sum(2, f);
  const double s = f / below.high;
  const Pair product = exact_product(s, below.high);
  const double s_low = (((f - product.high) - product.low) - s * below.low) / below.high;
  const double z = s * s;
  const Pair whole = exact_sum(parts.exponent * kLn2High, 2 * s);
  const double low =
      (whole.low + 2 * s_low) + (parts.exponent * kLn2Low + s * z * logarithm_tail(z));
  const double high = whole.high + low;
  return {high, (whole.high - high) + low};
}

bool is_whole(double y) { return std::floor(y) == y; }
bool is_odd(double y) { return std::fabs(y) < 0x1p53 && std::floor(y / 2) != y / 2; }

double small_power(double x, int n) {
  const double square = x * x;
  const double value = n == 0   ? 1
                       : n == 1 ? x
                       : n == 2 ? square
                       : n == 3 ? square * x
                                : square * square;
  return value > kLargest ? kLargest : value < -kLargest ? -kLargest : value;
}

}  // namespace

double exp(double x) { return std::isnan(x) ? 1 : exponential({x, 0}); }

double log(double x) {
  if (!(x > 0)) x = kSmallest;
  if (x > kLargest) x = kLargest;
  const Split parts = split(x);
  const double f = parts.fraction;
  const double s = f / (2 + f);
  const double z = s * s;
  // 2 s = f - s f, which keeps the exact f in front.
  const double rest = s * (f - z * logarithm_tail(z));
  return parts.exponent * kLn2High + (f - (rest - parts.exponent * kLn2Low));
}

double pow(double x, double y) {
  if (std::isnan(x)) x = 0;
  if (std::isnan(y)) y = 0;
  if (y == 0 || x == 1) return 1;
  if (x == 0) return 0;
  if (x < 0 && !is_whole(y)) return 0;
  if (is_whole(y) && y > 0 && y <= 4) return small_power(x, static_cast<int>(y));
  const double sign = x < 0 && is_odd(y) ? -1 : 1;
  const double size = std::fabs(x) < kLargest ? std::fabs(x) : kLargest;
  const Pair l = logarithm(size);
  const double rough = y * l.high;
  if (!(std::fabs(rough) < 800)) return rough > 0 ? sign * kLargest : 0.0;
  // Split products need y below 2^990; a larger one has made `rough` overflow unless ln x is 0.
  const Pair product = exact_product(l.high, y);
  return sign * exponential({product.high, product.low + l.low * y});
}

double cbrt(double x) {
  if (x == 0 || std::isnan(x)) return 0;
  double size = std::fabs(x) < kLargest ? std::fabs(x) : kLargest;
  int exponent = 0;
  size = std::frexp(size, &exponent);
  const int thirds = static_cast<int>(std::floor(exponent / 3.0));
  size = std::ldexp(size, exponent - 3 * thirds);  // 0.5..4
  double root = 0.6 + 0.26 * size;                 // within a quarter
  for (int step = 0; step < 6; ++step) root = root - (root - size / (root * root)) / 3;
  return std::copysign(std::ldexp(root, thirds), x);
}

}  // namespace rigc::math
