// SPDX-License-Identifier: MIT
// Matrices, frames, and transforms taken apart and put together. Degenerate input has a defined
// result. Test: tests/math/transform_test.cpp
#include <cmath>

#include "math/math.h"

namespace rigc::math {

Mat3 transposed(const Mat3& a) {
  return {{a.x.x, a.y.x, a.z.x}, {a.x.y, a.y.y, a.z.y}, {a.x.z, a.y.z, a.z.z}};
}

double determinant(const Mat3& a) { return dot(a.x, cross(a.y, a.z)); }

namespace {

// Columns divided by powers of two, so that no product below overflows or vanishes.
struct Balanced {
  Mat3 matrix;
  Vec3 by;
};

double power_of_two_below(double length) {
  int exponent = 0;
  std::frexp(length, &exponent);
  return std::ldexp(1.0, exponent < -1000 ? -1000 : exponent > 1000 ? 1000 : exponent);
}

Balanced balance(const Mat3& a) {
  const Vec3 by{power_of_two_below(length(a.x)), power_of_two_below(length(a.y)),
                power_of_two_below(length(a.z))};
  return {{a.x * (1 / by.x), a.y * (1 / by.y), a.z * (1 / by.z)}, by};
}

bool is_zero(Vec3 a) { return a == Vec3{}; }

// Unit length, or zero.
Vec3 unit(Vec3 a) { return normalised(a, {}); }

// The direction of `a` without its part along unit vector `along`; zero where only rounding noise
// is left.
Vec3 reject(Vec3 a, Vec3 along) {
  a = unit(a);
  const Vec3 rest = a - along * dot(a, along);
  if (length(rest) < 1e-12) return {};
  // What is left of a small difference still leans: twice is enough.
  const Vec3 side = unit(rest);
  return unit(side - along * dot(side, along));
}

// At right angles to unit vector `a`: Y for X, X for Y and Z.
Vec3 across(Vec3 a) { return cross(perpendicular(a), a); }

// The first column of a frame whose other two columns, unit or zero, are `y` and `z`.
Vec3 lost_x(Vec3 y, Vec3 z) {
  if (is_zero(y) && is_zero(z)) return {1, 0, 0};
  if (is_zero(y)) return across(z);
  const Vec3 side = reject(z, y);
  return is_zero(side) ? across(y) : cross(y, side);
}

}  // namespace

Mat3 inverse(const Mat3& a) {
  const Balanced balanced = balance(a);
  const Mat3& m = balanced.matrix;
  const double det = determinant(m);
  const double box = length(m.x) * length(m.y) * length(m.z);
  if (!(std::fabs(det) > 1e-14 * box)) return {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  const Vec3 x = cross(m.y, m.z) * (1 / (det * balanced.by.x));
  const Vec3 y = cross(m.z, m.x) * (1 / (det * balanced.by.y));
  const Vec3 z = cross(m.x, m.y) * (1 / (det * balanced.by.z));
  return transposed({x, y, z});
}

Affine inverse(const Affine& a) {
  const Mat3 linear = inverse(a.linear);
  return {linear, -(linear * a.origin)};
}

Affine translation(Vec3 v) { return {{}, v}; }

Affine rotation(Quat q) { return {matrix(q), {}}; }

Mat3 orthonormal(const Mat3& m) {
  // A lost column (zero scale) follows from the other two, so that a rotation survives it.
  Vec3 x = unit(m.x);
  if (is_zero(x)) x = lost_x(unit(m.y), unit(m.z));
  Vec3 y = reject(m.y, x);
  if (is_zero(y)) y = reject(cross(unit(m.z), x), x);
  if (is_zero(y)) y = across(x);
  return {x, y, cross(x, y)};
}

Mat3 frame(Vec3 primary, Vec3 secondary) {
  const Vec3 y = normalised(reject(secondary, primary), perpendicular(primary));
  return {primary, y, cross(primary, y)};
}

Affine compose(const Trs& trs) {
  const Mat3 r = matrix(trs.rotation);
  return {{r.x * trs.scale.x, r.y * trs.scale.y, r.z * trs.scale.z}, trs.translation};
}

Trs decompose(const Affine& a) {
  const Mat3 r = orthonormal(a.linear);
  return {
      a.origin, quaternion(r), {dot(r.x, a.linear.x), dot(r.y, a.linear.y), dot(r.z, a.linear.z)}};
}

double shear(const Affine& a) {
  const Trs parts = decompose(a);
  const Affine rigid = compose(parts);
  double largest = 0, difference = 0;
  for (std::size_t column = 0; column < 3; ++column) {
    const Vec3& of_a = column == 0 ? a.linear.x : column == 1 ? a.linear.y : a.linear.z;
    const Vec3& of_rigid = column == 0   ? rigid.linear.x
                           : column == 1 ? rigid.linear.y
                                         : rigid.linear.z;
    largest = std::fmax(largest, length(of_a));
    for (std::size_t row = 0; row < 3; ++row) {
      difference = std::fmax(difference, std::fabs(of_a[row] - of_rigid[row]));
    }
  }
  return largest > 0 ? difference / largest : 0;
}

}  // namespace rigc::math
