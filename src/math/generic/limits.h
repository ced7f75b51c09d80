// SPDX-License-Identifier: MIT
// Clamping along and about axes. Test: tests/math/limit_test.cpp
#pragma once

#include <limits>

#include "math/generic/quaternions.h"
#include "math/limit.h"

namespace rigc::math::generic {

inline constexpr double kNoBound = std::numeric_limits<double>::infinity();
// Sums of angles nearer to each other than this are equal: the first triple counts.
inline constexpr double kTie = 1e-9;

template <class R>
RIGC_INLINE Vec3Of<R> clamped(Vec3Of<R> v, const LimitSpace& space) {
  return {clamped(v.x, space.min.x, space.max.x), clamped(v.y, space.min.y, space.max.y),
          clamped(v.z, space.min.z, space.max.z)};
}

template <class R>
RIGC_INLINE auto equal(Vec3Of<R> a, Vec3Of<R> b) {
  return (a.x == b.x) & (a.y == b.y) & (a.z == b.z);
}

template <class R>
RIGC_INLINE R size_of(Vec3Of<R> angles) {
  return magnitude(angles.x) + magnitude(angles.y) + magnitude(angles.z);
}

template <class R>
RIGC_INLINE R half_turn_on(R degrees) {
  return degrees + select(degrees > 0.0, R(-180.0), R(180.0));
}

/// Angles about three axes turned about in order x, y, z; the smaller of the two triples.
template <class R>
RIGC_INLINE Vec3Of<R> smaller_angles(QuatOf<R> q) {
  const Vec3Of<R> angles = to_euler_degrees(q);
  const Vec3Of<R> other{half_turn_on(angles.x),
                        select(angles.y < 0.0, R(-180.0), R(180.0)) - angles.y,
                        half_turn_on(angles.z)};
  return select(size_of(other) < size_of(angles) - kTie, other, angles);
}

/// By whole turns to where the angle lies between its bounds, or is nearest to them.
template <class R>
RIGC_INLINE R turned_near(R angle, double low, double high) {
  if (!(low > -kNoBound && high < kNoBound)) return angle;
  const R turns = -floored((angle - low) / 360.0);
  const R above = angle + 360.0 * turns;
  const R turned = select(above - high <= low - (above - 360.0), above, above - 360.0);
  return select((angle >= low) & (angle <= high), angle, turned);
}

/// An odd order of axes is a mirror image: angles turn round.
RIGC_INLINE double sign_of(const int* order) {
  return (order[1] - order[0] + 3) % 3 == 1 ? 1.0 : -1.0;
}

template <class R>
RIGC_INLINE R& at(QuatOf<R>& q, int axis) {
  return axis == 0 ? q.x : axis == 1 ? q.y : q.z;
}

template <class R>
RIGC_INLINE Vec3Of<R> angles_of(QuatOf<R> q, const int* order) {
  const double sign = sign_of(order);
  const QuatOf<R> permuted{sign * at(q, order[0]), sign * at(q, order[1]), sign * at(q, order[2]),
                           q.w};
  const Vec3Of<R> found = smaller_angles(permuted);
  Vec3Of<R> angles;
  for (std::size_t i = 0; i < 3; ++i) angles[static_cast<std::size_t>(order[i])] = sign * found[i];
  return angles;
}

template <class R>
RIGC_INLINE QuatOf<R> rotation_of(Vec3Of<R> angles, const int* order) {
  const double sign = sign_of(order);
  Vec3Of<R> permuted;
  for (std::size_t i = 0; i < 3; ++i)
    permuted[i] = sign * angles[static_cast<std::size_t>(order[i])];
  const QuatOf<R> found = from_euler_degrees(permuted);
  QuatOf<R> q;
  q.w = found.w;
  at(q, order[0]) = sign * found.x;
  at(q, order[1]) = sign * found.y;
  at(q, order[2]) = sign * found.z;
  return q;
}

template <class R>
RIGC_INLINE Vec3Of<R> limit_vector(Vec3Of<R> value, const LimitSpace& space) {
  const QuatOf<R> axes = splat<R>(space.axes);
  const Vec3Of<R> origin = splat<R>(space.origin);
  const Vec3Of<R> measured = rotate(conjugate(axes), value - origin);
  const Vec3Of<R> inside = clamped(measured, space);
  return select(equal(inside, measured), value, origin + rotate(axes, inside));
}

/// Of the two triples of angles that are one rotation the one with the smaller sum counts; an angle
/// that has both bounds is taken by whole turns to where it violates them least.
template <class R>
RIGC_INLINE QuatOf<R> limit_rotation(QuatOf<R> value, const LimitSpace& space) {
  const QuatOf<R> axes = splat<R>(space.axes), rest = splat<R>(space.rest);
  const QuatOf<R> turn = normalised(value) * conjugate(rest);
  Vec3Of<R> angles = angles_of(conjugate(axes) * turn * axes, space.order);
  for (std::size_t i = 0; i < 3; ++i)
    angles[i] = turned_near(angles[i], space.min[i], space.max[i]);
  const Vec3Of<R> inside = clamped(angles, space);
  const QuatOf<R> held = axes * rotation_of(inside, space.order) * conjugate(axes) * rest;
  return select(equal(inside, angles), value, held);
}

}  // namespace rigc::math::generic
