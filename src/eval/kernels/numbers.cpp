// SPDX-License-Identifier: MIT
// Kernels of formulas, one line each: a loop over lanes around an expression.
// Test: tests/eval/numbers_test.cpp
#include "eval/kernels/numbers.h"

#include <cmath>

namespace rigc::eval::numbers {

namespace {

constexpr double kLargest = 0x1.fffffffffffffp+1023;

// Overflow becomes the largest number, no number at all becomes 0.
double finite(double x) {
  const double bounded = x > kLargest ? kLargest : x < -kLargest ? -kLargest : x;
  return bounded == bounded ? bounded : 0;
}

double truth(bool condition) { return condition ? 1.0 : 0.0; }

template <class F>
void unary(const Call& call, F f) {
  const double* a = call.in(0);
  double* out = call.result();
  for (int lane = 0; lane < kLanes; ++lane) out[lane] = finite(f(a[lane]));
}

template <class F>
void binary(const Call& call, F f) {
  const double* a = call.in(0);
  const double* b = call.in(1);
  double* out = call.result();
  for (int lane = 0; lane < kLanes; ++lane) out[lane] = finite(f(a[lane], b[lane]));
}

template <class F>
void ternary(const Call& call, F f) {
  const double* a = call.in(0);
  const double* b = call.in(1);
  const double* c = call.in(2);
  double* out = call.result();
  for (int lane = 0; lane < kLanes; ++lane) out[lane] = finite(f(a[lane], b[lane], c[lane]));
}

// The remainder is exact; it takes the divisor's sign.
double floored_remainder(double a, double b) {
  if (b == 0) return 0;
  const double rest = std::fmod(a, b);
  return rest != 0 && (rest < 0) != (b < 0) ? rest + b : rest;
}

double smooth(double low, double high, double x) {
  if (!(low < high || low > high)) return truth(x >= low);
  const double t = finite((x - low) / (high - low));
  const double held = t < 0 ? 0 : t > 1 ? 1 : t;
  return held * held * (3 - 2 * held);
}

}  // namespace

void negate(const Call& call) {
  unary(call, [](double a) { return -a; });
}
void logical_not(const Call& call) {
  unary(call, [](double a) { return truth(a == 0); });
}
void add(const Call& call) {
  binary(call, [](double a, double b) { return a + b; });
}
void subtract(const Call& call) {
  binary(call, [](double a, double b) { return a - b; });
}
void multiply(const Call& call) {
  binary(call, [](double a, double b) { return a * b; });
}
void divide(const Call& call) {
  binary(call, [](double a, double b) { return b == 0 ? 0 : a / b; });
}
void modulo(const Call& call) { binary(call, floored_remainder); }
void power(const Call& call) { binary(call, math::pow); }
void less(const Call& call) {
  binary(call, [](double a, double b) { return truth(a < b); });
}
void less_equal(const Call& call) {
  binary(call, [](double a, double b) { return truth(a <= b); });
}
void greater(const Call& call) {
  binary(call, [](double a, double b) { return truth(a > b); });
}
void greater_equal(const Call& call) {
  binary(call, [](double a, double b) { return truth(a >= b); });
}
void equal(const Call& call) {
  binary(call, [](double a, double b) { return truth(a == b); });
}
void not_equal(const Call& call) {
  binary(call, [](double a, double b) { return truth(a != b); });
}
void logical_and(const Call& call) {
  binary(call, [](double a, double b) { return truth(a != 0 && b != 0); });
}
void logical_or(const Call& call) {
  binary(call, [](double a, double b) { return truth(a != 0 || b != 0); });
}
void select(const Call& call) {
  ternary(call, [](double a, double b, double c) { return a != 0 ? b : c; });
}
void sin(const Call& call) { unary(call, math::sin_degrees); }
void cos(const Call& call) { unary(call, math::cos_degrees); }
void tan(const Call& call) { unary(call, math::tan_degrees); }
void asin(const Call& call) {
  unary(call, [](double a) { return math::degrees(math::asin(a)); });
}
void acos(const Call& call) {
  unary(call, [](double a) { return math::degrees(math::acos(a)); });
}
void atan(const Call& call) {
  unary(call, [](double a) { return math::degrees(math::atan(a)); });
}
void atan2(const Call& call) {
  binary(call, [](double a, double b) { return math::degrees(math::atan2(a, b)); });
}
void sqrt(const Call& call) { unary(call, math::sqrt); }
void abs(const Call& call) {
  unary(call, [](double a) { return std::fabs(a); });
}
void sign(const Call& call) {
  unary(call, [](double a) { return truth(a > 0) - truth(a < 0); });
}
void floor(const Call& call) {
  unary(call, [](double a) { return std::floor(a); });
}
void ceil(const Call& call) {
  unary(call, [](double a) { return std::ceil(a); });
}
void round(const Call& call) {
  unary(call, [](double a) { return std::round(a); });
}
void exp(const Call& call) { unary(call, math::exp); }
void log(const Call& call) {
  unary(call, [](double a) { return a > 0 ? math::log(a) : 0; });
}
void min(const Call& call) {
  binary(call, [](double a, double b) { return b < a ? b : a; });
}
void max(const Call& call) {
  binary(call, [](double a, double b) { return b > a ? b : a; });
}
void clamp(const Call& call) {
  ternary(call, [](double a, double low, double high) {
    const double above = a < low ? low : a;
    return above > high ? high : above;
  });
}
void lerp(const Call& call) {
  ternary(call, [](double a, double b, double t) { return a + (b - a) * t; });
}
void smoothstep(const Call& call) { ternary(call, smooth); }
void hypot(const Call& call) {
  binary(call, [](double a, double b) { return math::length({a, b, 0}); });
}

}  // namespace rigc::eval::numbers
