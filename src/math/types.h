// SPDX-License-Identifier: MIT
// Vectors, quaternions and transforms of any number type that real.h knows, and their arithmetic.
// Test: tests/math/vector_test.cpp
#pragma once

#include <cstddef>
#include <type_traits>

#include "math/real.h"

namespace rigc::math {

template <class R>
struct Vec3Of {
  R x{}, y{}, z{};
  RIGC_INLINE R& operator[](std::size_t i) { return i == 0 ? x : i == 1 ? y : z; }
  RIGC_INLINE const R& operator[](std::size_t i) const { return i == 0 ? x : i == 1 ? y : z; }
  bool operator==(const Vec3Of&) const = default;
};

/// A rotation as a unit quaternion; identity by default.
template <class R>
struct QuatOf {
  R x{}, y{}, z{}, w = R(1.0);
  bool operator==(const QuatOf&) const = default;
};

/// Columns of a 3 x 3 matrix.
template <class R>
struct Mat3Of {
  Vec3Of<R> x{R(1.0), R(0.0), R(0.0)}, y{R(0.0), R(1.0), R(0.0)}, z{R(0.0), R(0.0), R(1.0)};
  bool operator==(const Mat3Of&) const = default;
};

/// An affine map: p -> linear * p + origin.
template <class R>
struct AffineOf {
  Mat3Of<R> linear;
  Vec3Of<R> origin;
  bool operator==(const AffineOf&) const = default;
};

/// Translation, rotation, scale; as a matrix T * R * S.
template <class R>
struct TrsOf {
  Vec3Of<R> translation;
  QuatOf<R> rotation;
  Vec3Of<R> scale{R(1.0), R(1.0), R(1.0)};
  bool operator==(const TrsOf&) const = default;
};

using Vec3 = Vec3Of<double>;
using Quat = QuatOf<double>;
using Mat3 = Mat3Of<double>;
using Affine = AffineOf<double>;
using Trs = TrsOf<double>;

/// A number beside a vector of R: what converts to R will do.
template <class R>
using Scalar = std::type_identity_t<R>;

template <class R>
RIGC_INLINE Vec3Of<R> operator+(Vec3Of<R> a, Vec3Of<R> b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class R>
RIGC_INLINE Vec3Of<R> operator-(Vec3Of<R> a, Vec3Of<R> b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class R>
RIGC_INLINE Vec3Of<R> operator-(Vec3Of<R> a) {
  return {-a.x, -a.y, -a.z};
}
template <class R>
RIGC_INLINE Vec3Of<R> operator*(Vec3Of<R> a, Scalar<R> s) {
  return {a.x * s, a.y * s, a.z * s};
}
template <class R>
RIGC_INLINE Vec3Of<R> operator*(Scalar<R> s, Vec3Of<R> a) {
  return a * s;
}
template <class R>
RIGC_INLINE Vec3Of<R> scaled(Vec3Of<R> a, Vec3Of<R> b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
template <class R>
RIGC_INLINE R dot(Vec3Of<R> a, Vec3Of<R> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class R>
RIGC_INLINE Vec3Of<R> cross(Vec3Of<R> a, Vec3Of<R> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class R>
RIGC_INLINE Vec3Of<R> lerp(Vec3Of<R> a, Vec3Of<R> b, Scalar<R> t) {
  return a + (b - a) * t;
}

template <class R>
RIGC_INLINE Vec3Of<R> operator*(const Mat3Of<R>& a, Vec3Of<R> v) {
  return a.x * v.x + a.y * v.y + a.z * v.z;
}
template <class R>
RIGC_INLINE Mat3Of<R> operator*(const Mat3Of<R>& a, const Mat3Of<R>& b) {
  return {a * b.x, a * b.y, a * b.z};
}
template <class R>
RIGC_INLINE Vec3Of<R> operator*(const AffineOf<R>& a, Vec3Of<R> point) {
  return a.linear * point + a.origin;
}
template <class R>
RIGC_INLINE AffineOf<R> operator*(const AffineOf<R>& a, const AffineOf<R>& b) {
  return {a.linear * b.linear, a * b.origin};
}

template <class R>
RIGC_INLINE QuatOf<R> operator*(QuatOf<R> a, QuatOf<R> b) {
  return {
      a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
      a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}
/// `q` is a unit quaternion.
template <class R>
RIGC_INLINE Vec3Of<R> rotate(QuatOf<R> q, Vec3Of<R> v) {
  const Vec3Of<R> axis{q.x, q.y, q.z};
  const Vec3Of<R> twice = cross(axis, v) * 2.0;
  return v + twice * q.w + cross(axis, twice);
}
template <class R>
RIGC_INLINE QuatOf<R> conjugate(QuatOf<R> q) {
  return {-q.x, -q.y, -q.z, q.w};
}
template <class R>
RIGC_INLINE R dot(QuatOf<R> a, QuatOf<R> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
}
template <class R>
RIGC_INLINE QuatOf<R> operator-(QuatOf<R> a) {
  return {-a.x, -a.y, -a.z, -a.w};
}

// Choices, component by component; C is bool or a mask.
template <class C, class R>
RIGC_INLINE Vec3Of<R> select(C condition, Vec3Of<R> a, Vec3Of<R> b) {
  return {select(condition, a.x, b.x), select(condition, a.y, b.y), select(condition, a.z, b.z)};
}
template <class C, class R>
RIGC_INLINE QuatOf<R> select(C condition, QuatOf<R> a, QuatOf<R> b) {
  return {select(condition, a.x, b.x), select(condition, a.y, b.y), select(condition, a.z, b.z),
          select(condition, a.w, b.w)};
}
template <class C, class R>
RIGC_INLINE Mat3Of<R> select(C condition, const Mat3Of<R>& a, const Mat3Of<R>& b) {
  return {select(condition, a.x, b.x), select(condition, a.y, b.y), select(condition, a.z, b.z)};
}

/// The same value in all places.
template <class R>
RIGC_INLINE Vec3Of<R> splat(Vec3 v) {
  return {R(v.x), R(v.y), R(v.z)};
}
template <class R>
RIGC_INLINE QuatOf<R> splat(Quat q) {
  return {R(q.x), R(q.y), R(q.z), R(q.w)};
}
template <class R>
RIGC_INLINE AffineOf<R> splat(const Affine& a) {
  return {{splat<R>(a.linear.x), splat<R>(a.linear.y), splat<R>(a.linear.z)}, splat<R>(a.origin)};
}

}  // namespace rigc::math
