// SPDX-License-Identifier: MIT
// Settles values. Test: tests/update/remap_test.cpp
#include "update/settle.h"

#include <algorithm>
#include <cmath>

namespace rigc::update {
namespace {

using math::Quat;
using math::Vec3;

/// Digits of the grid, of the largest number of a value. Rounding of conversions is below 1e-15.
constexpr int kBits = 45;
/// How near to a float counts as that float, in sizes of the value.
constexpr double kNear = 1e-14;

double single(double x) { return static_cast<double>(static_cast<float>(x)); }

double on_grid(double x, double size) {
  int exponent = 0;
  std::frexp(size, &exponent);
  return std::ldexp(std::nearbyint(std::ldexp(x, kBits - exponent)), exponent - kBits);
}

double size_of(double x) { return std::abs(x); }
double size_of(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

template <class Function>
double each(double x, Function&& f) {
  return f(x);
}
template <class Function>
Vec3 each(const Vec3& v, Function&& f) {
  return {f(v.x), f(v.y), f(v.z)};
}

template <class Value>
Value few_digits(const Value& value) {
  const double size = size_of(value);
  bool is_near = true;
  const Value floats = each(value, [&](double x) {
    is_near = is_near && std::abs(x - single(x)) <= kNear * size;
    return single(x);
  });
  return is_near ? floats : each(value, [&](double x) { return on_grid(x, size); });
}

/// Of length 1, so that players and readers leave it as it is: the largest number follows from the
/// others.
Quat few_digits(const Quat& q) {
  double n[4] = {q.x, q.y, q.z, q.w};
  std::size_t largest = 3;
  for (std::size_t i = 0; i < 3; ++i)
    if (std::abs(n[i]) > std::abs(n[largest])) largest = i;
  double rest = 1;
  for (std::size_t i = 0; i < 4; ++i) {
    if (i == largest) continue;
    n[i] = on_grid(n[i], 1);
    rest -= n[i] * n[i];
  }
  n[largest] = std::copysign(std::sqrt(rest), n[largest]);
  return {n[0], n[1], n[2], n[3]};
}

template <class Value>
Value settle(const Value& value, const Value& converted) {
  return few_digits(value) == value ? converted : few_digits(converted);
}

}  // namespace

double settled(double value, double converted) { return settle(value, converted); }
Vec3 settled(const Vec3& value, const Vec3& converted) { return settle(value, converted); }
Quat settled(const Quat& value, const Quat& converted) { return settle(value, converted); }

}  // namespace rigc::update
