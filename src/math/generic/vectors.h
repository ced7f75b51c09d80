// SPDX-License-Identifier: MIT
// Lengths and directions, also of vectors whose squares overflow or vanish.
// Test: tests/math/vector_test.cpp
#pragma once

#include "math/generic/trigonometry.h"

namespace rigc::math::generic {

template <class R>
RIGC_INLINE R length(Vec3Of<R> a) {
  const R squares = dot(a, a);
  const auto plain = (squares > 1e-280) & (squares < 1e300);
  const R size = root(select(plain, squares, R(0.0)));
  if (!any(!plain)) return size;
  const R x = magnitude(a.x), y = magnitude(a.y), z = magnitude(a.z);
  const R xy = select(x > y, x, y);
  const R largest = select(xy > z, xy, z);
  const auto some = largest > 0.0;
  const R by = select(some, largest, R(1.0));
  const Vec3Of<R> small{a.x / by, a.y / by, a.z / by};
  return select(plain, size, select(some, largest * root(dot(small, small)), R(0.0)));
}

/// `a` at unit length, or `fallback` where it is shorter than 1e-30.
template <class R>
RIGC_INLINE Vec3Of<R> normalised(Vec3Of<R> a, Vec3Of<R> fallback) {
  const R size = length(a);
  const auto found = size >= 1e-30;
  const R by = select(found, size, R(1.0));
  const Vec3Of<R> unit{a.x / by, a.y / by, a.z / by};
  return any(!found) ? select(found, unit, fallback) : unit;
}
/// The same with zero for what has no direction.
template <class R>
RIGC_INLINE Vec3Of<R> unit(Vec3Of<R> a) {
  return normalised(a, Vec3Of<R>{});
}

template <class R>
RIGC_INLINE auto is_zero(Vec3Of<R> a) {
  return (a.x == 0.0) & (a.y == 0.0) & (a.z == 0.0);
}

/// Any unit vector at right angles to unit vector `a`, the same for the same `a`.
template <class R>
RIGC_INLINE Vec3Of<R> perpendicular(Vec3Of<R> a) {
  const R x = magnitude(a.x), y = magnitude(a.y), z = magnitude(a.z);
  // The axis that `a` leans to least, so that the product is never short.
  const auto least_x = (x <= y) & (x <= z);
  const auto least_y = y <= z;
  const R one(1.0), none(0.0);
  const Vec3Of<R> axis =
      select(least_x, Vec3Of<R>{one, none, none},
             select(least_y, Vec3Of<R>{none, one, none}, Vec3Of<R>{none, none, one}));
  return normalised(cross(a, axis), Vec3Of<R>{none, one, none});
}

}  // namespace rigc::math::generic
