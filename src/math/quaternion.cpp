// SPDX-License-Identifier: MIT
// Quaternions: from and to matrices, axes and Euler angles, and between each other.
// Test: tests/math/quaternion_test.cpp
#include <cmath>

#include "math/math.h"

namespace rigc::math {

Quat normalised(Quat q) {
  const double squares = dot(q, q);
  if (squares > 1e-60 && squares < 1e300) {
    const double size = std::sqrt(squares);
    return {q.x / size, q.y / size, q.z / size, q.w / size};
  }
  if (!(squares >= 1e300)) return {};
  const double down = 0x1p-600;
  return normalised(Quat{q.x * down, q.y * down, q.z * down, q.w * down});
}

namespace {

Quat blend(Quat a, double of_a, Quat b, double of_b) {
  return normalised(Quat{a.x * of_a + b.x * of_b, a.y * of_a + b.y * of_b, a.z * of_a + b.z * of_b,
                         a.w * of_a + b.w * of_b});
}

}  // namespace

Quat slerp(Quat a, Quat b, double t) {
  if (dot(a, b) < 0) b = -b;
  const Quat difference{a.x - b.x, a.y - b.y, a.z - b.z, a.w - b.w};
  const Quat sum{a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w};
  // The angle between them, exact for near and far ones alike, where an arc cosine is not.
  const double angle = 2 * atan2(sqrt(dot(difference, difference)), sqrt(dot(sum, sum)));
  if (angle < 1e-9) return blend(a, 1 - t, b, t);
  return blend(a, sin((1 - t) * angle), b, sin(t * angle));
}

Quat axis_angle(Vec3 unit_axis, double radians) {
  const double s = sin(radians / 2);
  return {unit_axis.x * s, unit_axis.y * s, unit_axis.z * s, cos(radians / 2)};
}

namespace {

// For vectors at most a right angle apart.
Quat between_near(Vec3 a, Vec3 b) {
  const Vec3 half = normalised(a + b);
  const Vec3 axis = cross(a, half);
  return normalised(Quat{axis.x, axis.y, axis.z, dot(a, half)});
}

}  // namespace

Quat between(Vec3 a, Vec3 b) {
  if (dot(a, b) >= 0) return between_near(a, b);
  // A half turn to -a, about the axis on which b lies too, and the rest of the way: the sum of two
  // nearly opposite vectors says too little about where b is.
  const Vec3 normal = normalised(cross(a, b), perpendicular(a));
  const Vec3 axis = normalised(normal - a * dot(normal, a), perpendicular(a));
  const Quat q = normalised(between_near(-a, b) * Quat{axis.x, axis.y, axis.z, 0});
  return q.w < 0 ? -q : q;
}

Mat3 matrix(Quat q) {
  const double xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z;
  const double xy = q.x * q.y, xz = q.x * q.z, yz = q.y * q.z;
  const double wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
  return {{1 - 2 * (yy + zz), 2 * (xy + wz), 2 * (xz - wy)},
          {2 * (xy - wz), 1 - 2 * (xx + zz), 2 * (yz + wx)},
          {2 * (xz + wy), 2 * (yz - wx), 1 - 2 * (xx + yy)}};
}

Quat quaternion(const Mat3& m) {
  const double trace = m.x.x + m.y.y + m.z.z;
  // Shepperd: divide by the largest of the four components, which is at least a half.
  Quat q;
  if (trace >= m.x.x && trace >= m.y.y && trace >= m.z.z) {
    q = {m.y.z - m.z.y, m.z.x - m.x.z, m.x.y - m.y.x, 1 + trace};
  } else if (m.x.x >= m.y.y && m.x.x >= m.z.z) {
    q = {1 + 2 * m.x.x - trace, m.x.y + m.y.x, m.z.x + m.x.z, m.y.z - m.z.y};
  } else if (m.y.y >= m.z.z) {
    q = {m.x.y + m.y.x, 1 + 2 * m.y.y - trace, m.y.z + m.z.y, m.z.x - m.x.z};
  } else {
    q = {m.z.x + m.x.z, m.y.z + m.z.y, 1 + 2 * m.z.z - trace, m.x.y - m.y.x};
  }
  q = normalised(q);
  return q.w < 0 ? -q : q;
}

Quat from_euler_degrees(Vec3 degrees) {
  const Vec3 s{sin_degrees(degrees.x / 2), sin_degrees(degrees.y / 2), sin_degrees(degrees.z / 2)};
  const Vec3 c{cos_degrees(degrees.x / 2), cos_degrees(degrees.y / 2), cos_degrees(degrees.z / 2)};
  return {s.x * c.y * c.z - c.x * s.y * s.z, c.x * s.y * c.z + s.x * c.y * s.z,
          c.x * c.y * s.z - s.x * s.y * c.z, c.x * c.y * c.z + s.x * s.y * s.z};
}

Vec3 to_euler_degrees(Quat q) {
  const Mat3 m = matrix(normalised(q));
  const double cosine_y = sqrt(m.x.x * m.x.x + m.x.y * m.x.y);
  const double y = atan2(-m.x.z, cosine_y);
  // Z first, then X of what is left once Z is taken off: so the three angles agree with each other
  // however near Y is to 90 degrees (Herter and Lott 1993).
  const double z = cosine_y < 1e-12 ? 0.0 : atan2(m.x.y, m.x.x);
  const double s = sin(z), c = cos(z);
  const double x = atan2(s * m.z.x - c * m.z.y, c * m.y.y - s * m.y.x);
  return {degrees(x), degrees(y), degrees(z)};
}

}  // namespace rigc::math
