// SPDX-License-Identifier: MIT
// Vectors, matrices and rotations in long double for twins of kernels: slow, obvious, with the
// elementary functions of the C library. Nothing here is shared with src/math, so that an error
// there shows. (Where long double is double, the bounds of bounds.h leave room for that.)
#pragma once

#include <cmath>

#include "math/math.h"

namespace rigc::exact {

using Real = long double;

inline constexpr Real kPi = 3.141592653589793238462643383279502884L;
inline constexpr Real kDegree = kPi / 180;

struct V {
  Real x = 0, y = 0, z = 0;
  V() = default;
  V(Real a, Real b, Real c) : x(a), y(b), z(c) {}
  V(const math::Vec3& v) : x(v.x), y(v.y), z(v.z) {}
  Real& operator[](std::size_t i) { return i == 0 ? x : i == 1 ? y : z; }
  Real operator[](std::size_t i) const { return i == 0 ? x : i == 1 ? y : z; }
};

inline V operator+(V a, V b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline V operator-(V a, V b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline V operator-(V a) { return {-a.x, -a.y, -a.z}; }
inline V operator*(V a, Real s) { return {a.x * s, a.y * s, a.z * s}; }
inline V times_each(V a, V b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
inline Real dot(V a, V b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline V cross(V a, V b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Real length(V a) { return sqrtl(dot(a, a)); }
inline V unit(V a, V otherwise = {}) {
  const Real size = length(a);
  return size < 1e-30L ? otherwise : a * (1 / size);
}
/// The part of `a` at right angles to unit vector `axis`.
inline V beside(V a, V axis) { return a - axis * dot(a, axis); }

/// Columns.
struct M {
  V x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  M() = default;
  M(V a, V b, V c) : x(a), y(b), z(c) {}
  M(const math::Mat3& m) : x(m.x), y(m.y), z(m.z) {}
  V& operator[](std::size_t i) { return i == 0 ? x : i == 1 ? y : z; }
  const V& operator[](std::size_t i) const { return i == 0 ? x : i == 1 ? y : z; }
};

inline V operator*(const M& m, V v) { return m.x * v.x + m.y * v.y + m.z * v.z; }
inline M operator*(const M& a, const M& b) { return {a * b.x, a * b.y, a * b.z}; }
inline M transposed(const M& m) {
  return {{m.x.x, m.y.x, m.z.x}, {m.x.y, m.y.y, m.z.y}, {m.x.z, m.y.z, m.z.z}};
}
inline Real determinant(const M& m) { return dot(m.x, cross(m.y, m.z)); }
inline M scaled(const M& m, V s) { return {m.x * s.x, m.y * s.y, m.z * s.z}; }
inline M inverse(const M& m) {
  const Real d = 1 / determinant(m);
  return transposed({cross(m.y, m.z) * d, cross(m.z, m.x) * d, cross(m.x, m.y) * d});
}
inline bool is_flat(const M& m) {
  return !(fabsl(determinant(m)) > 1e-14L * length(m.x) * length(m.y) * length(m.z));
}

struct A {
  M linear;
  V origin;
  A() = default;
  A(const M& m, V o) : linear(m), origin(o) {}
  A(const math::Affine& a) : linear(a.linear), origin(a.origin) {}
};
inline V operator*(const A& a, V v) { return a.linear * v + a.origin; }
inline A operator*(const A& a, const A& b) { return {a.linear * b.linear, a * b.origin}; }

/// Rotation about a unit axis: Rodrigues' formula.
inline M turn(V axis, Real radians) {
  M m;
  for (std::size_t i = 0; i < 3; ++i)
    m[i] = m[i] * cosl(radians) + cross(axis, m[i]) * sinl(radians) +
           axis * (dot(axis, m[i]) * (1 - cosl(radians)));
  return m;
}
/// Rotation of a quaternion of any length by its axis and angle; none where it has no length.
inline M turn(const math::Quat& q) {
  const V axis{q.x, q.y, q.z};
  const Real sine = length(axis);
  return sine == 0 ? M{} : turn(axis * (1 / sine), 2 * atan2l(sine, q.w));
}
/// About a coordinate axis.
inline M turn_degrees(std::size_t axis, Real degrees) {
  V v;
  v[axis] = 1;
  return turn(v, degrees * kDegree);
}

/// Axis (unit) and angle 0..pi of a rotation; any axis where there is none.
struct Turn {
  V axis{1, 0, 0};
  Real angle = 0;
};
inline Turn axis_angle(const M& m) {
  const V twice{m.y.z - m.z.y, m.z.x - m.x.z, m.x.y - m.y.x};
  const Real angle = atan2l(length(twice), m.x.x + m.y.y + m.z.z - 1);
  return {unit(twice, {1, 0, 0}), angle};
}
/// Angle between two rotations, exact for small ones too.
inline Real angle_between(const M& a, const M& b) {
  Real squares = 0;
  for (std::size_t i = 0; i < 3; ++i) squares += dot(a[i] - b[i], a[i] - b[i]);
  return 2 * asinl(fminl(1, sqrtl(squares / 8)));
}
/// The shortest turn that takes unit vector a to unit vector b.
inline M shortest(V a, V b) {
  const V normal = cross(a, b);
  return turn(unit(normal, {1, 0, 0}), atan2l(length(normal), dot(a, b)));
}

/// Gram and Schmidt on x, then y; z completes them. For matrices whose columns are independent.
inline M orthonormal(const M& m) {
  const V x = unit(m.x), y = unit(beside(m.y, x));
  return {x, y, cross(x, y)};
}
/// x is `primary`, y leans to `secondary`.
inline M frame(V primary, V secondary) {
  const V y = unit(beside(secondary, primary));
  return {primary, y, cross(primary, y)};
}
/// What is left of a matrix without its rotation: the scales along the axes; z below 0: mirrored.
inline V scales(const M& rotation, const M& m) {
  return {dot(rotation.x, m.x), dot(rotation.y, m.y), dot(rotation.z, m.z)};
}

/// Into a parent's space; where the parent is flat, into that of its rotation.
inline A into(const A& parent) {
  const M back =
      is_flat(parent.linear) ? transposed(orthonormal(parent.linear)) : inverse(parent.linear);
  return {back, -(back * parent.origin)};
}

}  // namespace rigc::exact
