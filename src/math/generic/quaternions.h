// SPDX-License-Identifier: MIT
// Quaternions: from and to matrices, axes and Euler angles, and between each other.
// Test: tests/math/quaternion_test.cpp
#pragma once

#include "math/generic/vectors.h"

namespace rigc::math::generic {

/// Unit length, identity where `q` is shorter than 1e-30 or not finite.
template <class R>
RIGC_INLINE QuatOf<R> normalised(QuatOf<R> q) {
  R squares = dot(q, q);
  const auto large = squares >= 1e300;
  if (any(large)) {
    const R down = select(large, R(0x1p-600), R(1.0));
    q = {q.x * down, q.y * down, q.z * down, q.w * down};
    squares = dot(q, q);
  }
  const auto found = (squares > 1e-60) & (squares < 1e300);
  const R size = root(select(found, squares, R(1.0)));
  const QuatOf<R> unit{q.x / size, q.y / size, q.z / size, q.w / size};
  return any(!found) ? select(found, unit, QuatOf<R>{}) : unit;
}

template <class R>
RIGC_INLINE QuatOf<R> weighted_sum(QuatOf<R> a, R of_a, QuatOf<R> b, R of_b) {
  return normalised(QuatOf<R>{a.x * of_a + b.x * of_b, a.y * of_a + b.y * of_b,
                              a.z * of_a + b.z * of_b, a.w * of_a + b.w * of_b});
}

/// The nearer way round; `t` in 0..1. Source: Shoemake 1985.
template <class R>
RIGC_INLINE QuatOf<R> slerp(QuatOf<R> a, QuatOf<R> b, R t) {
  b = select(dot(a, b) < 0.0, -b, b);
  const QuatOf<R> difference{a.x - b.x, a.y - b.y, a.z - b.z, a.w - b.w};
  const QuatOf<R> sum{a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w};
  // The angle between them, exact for near and far ones alike, where an arc cosine is not.
  const R angle = 2.0 * atan2(root(dot(difference, difference)), root(dot(sum, sum)));
  const auto near = angle < 1e-9;
  const R before = 1.0 - t;
  const R of_a = select(near, before, sine_cosine(before * angle).sine);
  const R of_b = select(near, t, sine_cosine(t * angle).sine);
  return weighted_sum(a, of_a, b, of_b);
}

template <class R>
RIGC_INLINE QuatOf<R> axis_angle(Vec3Of<R> unit_axis, R radians) {
  const SineCosine<R> half = sine_cosine(radians * 0.5);
  return {unit_axis.x * half.sine, unit_axis.y * half.sine, unit_axis.z * half.sine, half.cosine};
}

/// For unit vectors at most a right angle apart.
template <class R>
RIGC_INLINE QuatOf<R> between_near(Vec3Of<R> a, Vec3Of<R> b) {
  const Vec3Of<R> axis = cross(a, b);
  return normalised(QuatOf<R>{axis.x, axis.y, axis.z, 1.0 + dot(a, b)});
}

/// The shortest rotation that takes unit vector `a` to unit vector `b`; half turns about
/// perpendicular(a).
template <class R>
RIGC_INLINE QuatOf<R> between(Vec3Of<R> a, Vec3Of<R> b) {
  const auto far = dot(a, b) < 0.0;
  if (none(far)) return between_near(a, b);
  // Far ones by a half turn to -a, about the axis on which b lies too, and the rest of the way: the
  // sum of two nearly opposite vectors says too little about where b is.
  const QuatOf<R> rest = between_near(select(far, -a, a), b);
  const Vec3Of<R> any_axis = perpendicular(a);
  const Vec3Of<R> normal = normalised(cross(a, b), any_axis);
  const Vec3Of<R> axis = normalised(normal - a * dot(normal, a), any_axis);
  const QuatOf<R> both = normalised(rest * QuatOf<R>{axis.x, axis.y, axis.z, R(0.0)});
  return select(far, select(both.w < 0.0, -both, both), rest);
}

/// `q`, or at unit length where the square of its length would overflow or vanish; identity where
/// it is shorter than 1e-30.
template <class R>
RIGC_INLINE QuatOf<R> moderate(QuatOf<R> q) {
  const R squares = dot(q, q);
  const auto plain = (squares > 1e-60) & (squares < 1e300);
  return any(!plain) ? select(plain, q, normalised(q)) : q;
}

/// Of a quaternion of any length, identity where it is shorter than 1e-30: dividing by the square
/// of its length takes one division, its length a square root and four.
template <class R>
RIGC_INLINE Mat3Of<R> matrix(QuatOf<R> q) {
  q = moderate(q);
  const R two = 2.0 / dot(q, q);
  const R x = q.x * two, y = q.y * two, z = q.z * two;
  const R xx = q.x * x, yy = q.y * y, zz = q.z * z;
  const R xy = q.x * y, xz = q.x * z, yz = q.y * z;
  const R wx = q.w * x, wy = q.w * y, wz = q.w * z;
  return {{1.0 - (yy + zz), xy + wz, xz - wy},
          {xy - wz, 1.0 - (xx + zz), yz + wx},
          {xz + wy, yz - wx, 1.0 - (xx + yy)}};
}

/// Rotation of an orthonormal right-handed matrix, w >= 0. Source: Shepperd 1978.
template <class R>
RIGC_INLINE QuatOf<R> quaternion(const Mat3Of<R>& m) {
  const R trace = m.x.x + m.y.y + m.z.z;
  // Shepperd: divide by the largest of the four components, which is at least a half.
  const auto by_w = (trace >= m.x.x) & (trace >= m.y.y) & (trace >= m.z.z);
  const auto by_x = (m.x.x >= m.y.y) & (m.x.x >= m.z.z);
  const auto by_y = m.y.y >= m.z.z;
  const R wx = m.y.z - m.z.y, wy = m.z.x - m.x.z, wz = m.x.y - m.y.x;
  const R xy = m.x.y + m.y.x, xz = m.z.x + m.x.z, yz = m.y.z + m.z.y;
  QuatOf<R> q = select(by_y, QuatOf<R>{xy, 1.0 + 2.0 * m.y.y - trace, yz, wy},
                       QuatOf<R>{xz, yz, 1.0 + 2.0 * m.z.z - trace, wz});
  q = select(by_x, QuatOf<R>{1.0 + 2.0 * m.x.x - trace, xy, xz, wx}, q);
  q = normalised(select(by_w, QuatOf<R>{wx, wy, wz, 1.0 + trace}, q));
  return select(q.w < 0.0, -q, q);
}

/// Applied X first, then Y, then Z, about fixed axes: R = Rz * Ry * Rx. Degrees.
template <class R>
RIGC_INLINE QuatOf<R> from_euler_degrees(Vec3Of<R> degrees) {
  const SineCosine<R> x = sine_cosine_degrees(degrees.x * 0.5);
  const SineCosine<R> y = sine_cosine_degrees(degrees.y * 0.5);
  const SineCosine<R> z = sine_cosine_degrees(degrees.z * 0.5);
  return {x.sine * y.cosine * z.cosine - x.cosine * y.sine * z.sine,
          x.cosine * y.sine * z.cosine + x.sine * y.cosine * z.sine,
          x.cosine * y.cosine * z.sine - x.sine * y.sine * z.cosine,
          x.cosine * y.cosine * z.cosine + x.sine * y.sine * z.sine};
}

/// The inverse; at +-90 degrees of Y, Z is 0.
template <class R>
RIGC_INLINE Vec3Of<R> to_euler_degrees(QuatOf<R> q) {
  const Mat3Of<R> m = matrix(q);
  const R cosine_y = root(m.x.x * m.x.x + m.x.y * m.x.y);
  const R y = atan2(-m.x.z, cosine_y);
  // Z first, then X of what is left once Z is taken off: so the three angles agree with each other
  // however near Y is to 90 degrees (Herter and Lott 1993).
  const R z = select(cosine_y < 1e-12, R(0.0), atan2(m.x.y, m.x.x));
  const SineCosine<R> of_z = sine_cosine(z);
  const R x =
      atan2(of_z.sine * m.z.x - of_z.cosine * m.z.y, of_z.cosine * m.y.y - of_z.sine * m.y.x);
  return {degrees(x), degrees(y), degrees(z)};
}

}  // namespace rigc::math::generic
