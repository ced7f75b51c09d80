// SPDX-License-Identifier: MIT
// Seeded random numbers, vectors, rotations and transforms for property tests: the same on every
// machine.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "math/math.h"

namespace rigc::test {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  std::uint64_t bits() { return engine_(); }
  /// 0 to n - 1.
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(engine_() % n); }
  bool chance(int percent) { return below(100) < static_cast<std::size_t>(percent); }
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  math::Vec3 vector(double size = 1) {
    const double x = between(-size, size), y = between(-size, size), z = between(-size, size);
    return {x, y, z};
  }
  math::Vec3 direction() {
    for (;;) {
      const math::Vec3 v = vector();
      if (math::length(v) > 0.1 && math::length(v) < 1) return math::normalised(v);
    }
  }
  /// A vector of any direction and a length in a range.
  math::Vec3 arrow(double shortest, double longest) {
    const math::Vec3 v = direction();
    return v * between(shortest, longest);
  }
  /// A number of any size from 2^-spread to 2^spread, of the sign of `sign` or, where that is 0, of
  /// either.
  double any_size(int spread, double sign) {
    const double mantissa = between(1, 2);
    const int exponent = static_cast<int>(below(static_cast<std::size_t>(2 * spread))) - spread;
    const double value = std::ldexp(mantissa, exponent);
    return sign > 0 || (sign == 0 && chance(50)) ? value : -value;
  }
  math::Quat rotation() {
    for (;;) {
      const double x = between(-1, 1), y = between(-1, 1), z = between(-1, 1), w = between(-1, 1);
      const double squares = x * x + y * y + z * z + w * w;
      if (squares > 0.01 && squares < 1) return math::normalised(math::Quat{x, y, z, w});
    }
  }
  /// No shear; scales between 0.3 and 3, the same on all axes where `uniform`.
  math::Trs trs(bool uniform = true) {
    math::Trs t;
    t.translation = vector(2);
    t.rotation = rotation();
    const double x = between(0.3, 3), y = between(0.3, 3), z = between(0.3, 3);
    t.scale = uniform ? math::Vec3{x, x, x} : math::Vec3{x, y, z};
    return t;
  }

 private:
  std::mt19937_64 engine_;
};

inline double distance(math::Vec3 a, math::Vec3 b) { return math::length(a - b); }

/// 0 where two quaternions are the same rotation; about half the angle between them, in radians.
inline double distance(math::Quat a, math::Quat b) {
  if (math::dot(a, b) < 0) b = -b;
  const math::Quat d{a.x - b.x, a.y - b.y, a.z - b.z, a.w - b.w};
  return math::sqrt(math::dot(d, d));
}

inline double distance(const math::Mat3& a, const math::Mat3& b) {
  return distance(a.x, b.x) + distance(a.y, b.y) + distance(a.z, b.z);
}

inline double distance(const math::Affine& a, const math::Affine& b) {
  return distance(a.linear, b.linear) + distance(a.origin, b.origin);
}

}  // namespace rigc::test
