// SPDX-License-Identifier: MIT
// A curve through points: cubic Hermite segments whose ends' directions are given, or follow from
// the neighbouring points. A direction of length 1 leaves a point as fast as the segment's chord is
// long: so the curve keeps its shape when points move apart or together, and makes no loops. Knots
// are the points: x = i at point i. Test: tests/math/spline_test.cpp
#pragma once

#include "math/generic/transforms.h"

namespace rigc::math::generic {

/// Straight pieces that a segment is measured by.
inline constexpr int kSplinePieces = 4;

template <class R>
struct SegmentOf {
  Vec3Of<R> from, leaving, to, arriving;  ///< ends, and the derivatives there
};

/// What each part of a segment counts at one place.
template <class R>
struct BasisOf {
  R from, leaving, to, arriving;
};

/// Of the place at t in 0..1 (Hermite).
template <class R>
RIGC_INLINE BasisOf<R> place_basis(R t) {
  const R u = 1.0 - t;
  return {u * u * (1.0 + 2.0 * t), t * u * u, t * t * (3.0 - 2.0 * t), -(t * t * u)};
}
/// Of the derivative by t there.
template <class R>
RIGC_INLINE BasisOf<R> slope_basis(R t) {
  const R u = 1.0 - t;
  return {-6.0 * t * u, u * (1.0 - 3.0 * t), 6.0 * t * u, t * (3.0 * t - 2.0)};
}

template <class R>
RIGC_INLINE Vec3Of<R> combined(const SegmentOf<R>& s, const BasisOf<R>& b) {
  return s.from * b.from + s.leaving * b.leaving + s.to * b.to + s.arriving * b.arriving;
}

/// The direction at a point between two chords (unit vectors and lengths): that of the parabola
/// through the three points, at most of length 1 (Bessel's tangents).
template <class R>
RIGC_INLINE Vec3Of<R> direction_between(Vec3Of<R> before, R before_length, Vec3Of<R> after,
                                        R after_length) {
  const R sum = before_length + after_length;
  const auto some = sum > 0.0;
  const R part = select(some, before_length / select(some, sum, R(1.0)), R(0.5));
  return before + (after - before) * part;
}

/// The direction at the end of a chord (unit vector) whose other end has `direction`: as in an arc.
template <class R>
RIGC_INLINE Vec3Of<R> direction_at_end(Vec3Of<R> direction, Vec3Of<R> chord) {
  return chord * (2.0 * dot(direction, chord)) - direction;
}

/// Where unit vector `y` at right angles to unit vector `x` gets by the shortest turn from x to
/// unit vector `to`: the reflection that swaps x and -to. A half turn is about y.
template <class R>
RIGC_INLINE Vec3Of<R> swung(Vec3Of<R> y, Vec3Of<R> x, Vec3Of<R> to) {
  const Vec3Of<R> half = x + to;
  const R squares = dot(half, half);
  const auto opposite = squares < 1e-24;
  const R part = 2.0 * dot(y, half) / select(opposite, R(1.0), squares);
  return y - half * select(opposite, R(0.0), part);
}

}  // namespace rigc::math::generic
