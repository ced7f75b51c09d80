// SPDX-License-Identifier: MIT
// Matrices, frames, and transforms taken apart and put together. Degenerate input has a defined
// result. Test: tests/math/transform_test.cpp
#pragma once

#include "math/generic/quaternions.h"

namespace rigc::math::generic {

template <class R>
RIGC_INLINE Mat3Of<R> transposed(const Mat3Of<R>& a) {
  return {{a.x.x, a.y.x, a.z.x}, {a.x.y, a.y.y, a.z.y}, {a.x.z, a.y.z, a.z.z}};
}

template <class R>
RIGC_INLINE R determinant(const Mat3Of<R>& a) {
  return dot(a.x, cross(a.y, a.z));
}

/// 1, or for lengths whose products overflow or vanish a power of two near them.
template <class R>
RIGC_INLINE R balance(R length) {
  const auto plain = ((length > 1e-30) & (length < 1e30)) | (length == 0.0);
  if (!any(!plain)) return R(1.0);
  const R exponent = parts_of(select(plain, R(1.0), length)).exponent;
  return select(plain, R(1.0), power_of_two(clamped(exponent, -1000.0, 1000.0)));
}

/// Inverse; the zero matrix where `a` is singular (its columns span less than 1e-14 of their box).
template <class R>
RIGC_INLINE Mat3Of<R> inverse(const Mat3Of<R>& a) {
  const R by_x = balance(length(a.x)), by_y = balance(length(a.y)), by_z = balance(length(a.z));
  const Mat3Of<R> m{a.x * (1.0 / by_x), a.y * (1.0 / by_y), a.z * (1.0 / by_z)};
  const R det = determinant(m);
  const R box = length(m.x) * length(m.y) * length(m.z);
  const auto regular = magnitude(det) > 1e-14 * box;
  const R d = select(regular, det, R(1.0));
  const Vec3Of<R> x = cross(m.y, m.z) * (1.0 / (d * by_x));
  const Vec3Of<R> y = cross(m.z, m.x) * (1.0 / (d * by_y));
  const Vec3Of<R> z = cross(m.x, m.y) * (1.0 / (d * by_z));
  const Mat3Of<R> found = transposed(Mat3Of<R>{x, y, z});
  const Vec3Of<R> zero;
  return any(!regular) ? select(regular, found, Mat3Of<R>{zero, zero, zero}) : found;
}

template <class R>
RIGC_INLINE AffineOf<R> inverse(const AffineOf<R>& a) {
  const Mat3Of<R> linear = inverse(a.linear);
  return {linear, -(linear * a.origin)};
}

/// The direction of `a` without its part along unit vector `along`; zero where only rounding noise
/// is left.
template <class R>
RIGC_INLINE Vec3Of<R> reject(Vec3Of<R> a, Vec3Of<R> along) {
  const R squares = dot(a, a);
  const Vec3Of<R> across = a - along * dot(a, along);
  const R rest = dot(across, across);
  const auto clear = (squares > 1e-200) & (squares < 1e200) & (rest > 0.25 * squares);
  const R size = root(select(clear, rest, R(1.0)));
  const Vec3Of<R> plain{across.x / size, across.y / size, across.z / size};
  if (!any(!clear)) return plain;
  const Vec3Of<R> direction = unit(a);
  const Vec3Of<R> leaning = direction - along * dot(direction, along);
  // What is left of a small difference still leans: twice is enough.
  const Vec3Of<R> side = unit(leaning);
  const Vec3Of<R> upright = unit(side - along * dot(side, along));
  return select(clear, plain, select(length(leaning) < 1e-12, Vec3Of<R>{}, upright));
}

/// At right angles to unit vector `a`: Y for X, X for Y and Z.
template <class R>
RIGC_INLINE Vec3Of<R> across(Vec3Of<R> a) {
  return cross(perpendicular(a), a);
}

/// The first column of a frame whose other two columns, unit or zero, are `y` and `z`.
template <class R>
RIGC_INLINE Vec3Of<R> lost_x(Vec3Of<R> y, Vec3Of<R> z) {
  const Vec3Of<R> side = reject(z, y);
  const Vec3Of<R> from_y = select(is_zero(side), across(y), cross(y, side));
  const Vec3Of<R> from_z = select(is_zero(z), Vec3Of<R>{R(1.0), R(0.0), R(0.0)}, across(z));
  return select(is_zero(y), from_z, from_y);
}

/// The orthonormal right-handed frame nearest to `m` by Gram-Schmidt on x, then y. Columns of zero
/// length and mirrored matrices (z is flipped) are handled.
template <class R>
RIGC_INLINE Mat3Of<R> orthonormal(const Mat3Of<R>& m) {
  // A lost column (zero scale) follows from the other two, so that a rotation survives it.
  Vec3Of<R> x = unit(m.x);
  const auto no_x = is_zero(x);
  if (any(no_x)) x = select(no_x, lost_x(unit(m.y), unit(m.z)), x);
  Vec3Of<R> y = reject(m.y, x);
  const auto no_y = is_zero(y);
  if (any(no_y)) {
    const Vec3Of<R> from_z = reject(cross(unit(m.z), x), x);
    y = select(no_y, select(is_zero(from_z), across(x), from_z), y);
  }
  return {x, y, cross(x, y)};
}

/// A right-handed frame whose x is `primary` (unit) and whose y is `secondary` made perpendicular
/// to it; where they are parallel, perpendicular(primary).
template <class R>
RIGC_INLINE Mat3Of<R> frame(Vec3Of<R> primary, Vec3Of<R> secondary) {
  Vec3Of<R> y = reject(secondary, primary);
  const auto parallel = is_zero(y);
  if (any(parallel)) y = select(parallel, perpendicular(primary), y);
  return {primary, y, cross(primary, y)};
}

template <class R>
RIGC_INLINE AffineOf<R> compose(const TrsOf<R>& trs) {
  const Mat3Of<R> r = matrix(trs.rotation);
  return {{r.x * trs.scale.x, r.y * trs.scale.y, r.z * trs.scale.z}, trs.translation};
}

/// T, R = orthonormal(linear), S = diagonal of R^T * linear: exact where there is no shear,
/// negative z scale where mirrored.
template <class R>
RIGC_INLINE TrsOf<R> decompose(const AffineOf<R>& a) {
  const Mat3Of<R> r = orthonormal(a.linear);
  return {
      a.origin, quaternion(r), {dot(r.x, a.linear.x), dot(r.y, a.linear.y), dot(r.z, a.linear.z)}};
}

}  // namespace rigc::math::generic
