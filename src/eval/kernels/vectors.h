// SPDX-License-Identifier: MIT
// Kernels of formulas over vectors, rotations and matrices; what each means is in scene/formula.h.
// Rotations come at any length. Test: tests/eval/twins_test.cpp, tests/eval/compute_test.cpp
#pragma once

#include "eval/kernels/lanes.h"

namespace rigc::eval {
namespace {

struct VectorAdd {
  RIGC_INLINE static void run(const Lanes& lanes) { lanes.put(0, lanes.vec3(0) + lanes.vec3(1)); }
};

struct VectorSubtract {
  RIGC_INLINE static void run(const Lanes& lanes) { lanes.put(0, lanes.vec3(0) - lanes.vec3(1)); }
};

/// vector, number
struct VectorScale {
  RIGC_INLINE static void run(const Lanes& lanes) { lanes.put(0, lanes.vec3(0) * lanes.number(1)); }
};

/// Component by component.
struct VectorMultiply {
  RIGC_INLINE static void run(const Lanes& lanes) {
    const Vec3 a = lanes.vec3(0), b = lanes.vec3(1);
    lanes.put(0, Vec3{a.x * b.x, a.y * b.y, a.z * b.z});
  }
};

/// a, b, t -> a + (b - a) t
struct VectorLerp {
  RIGC_INLINE static void run(const Lanes& lanes) {
    const Vec3 a = lanes.vec3(0);
    lanes.put(0, a + (lanes.vec3(1) - a) * lanes.number(2));
  }
};

struct Dot {
  RIGC_INLINE static void run(const Lanes& lanes) {
    lanes.put(0, dot(lanes.vec3(0), lanes.vec3(1)));
  }
};

struct Cross {
  RIGC_INLINE static void run(const Lanes& lanes) {
    lanes.put(0, cross(lanes.vec3(0), lanes.vec3(1)));
  }
};

struct Length {
  RIGC_INLINE static void run(const Lanes& lanes) { lanes.put(0, generic::length(lanes.vec3(0))); }
};

/// At unit length; zero where it is shorter than 1e-30.
struct Normalise {
  RIGC_INLINE static void run(const Lanes& lanes) { lanes.put(0, generic::unit(lanes.vec3(0))); }
};

/// a, b -> the rotation that turns by b, then by a; at unit length, as the lengths of a chain of
/// products would vanish
struct RotationMultiply {
  RIGC_INLINE static void run(const Lanes& lanes) {
    lanes.put(0, generic::normalised(lanes.quat(0)) * generic::normalised(lanes.quat(1)));
  }
};

struct RotationInverse {
  RIGC_INLINE static void run(const Lanes& lanes) {
    const Quat q = generic::moderate(lanes.quat(0));
    lanes.put(0, Quat{-q.x, -q.y, -q.z, q.w});
  }
};

/// rotation, vector
struct RotationApply {
  RIGC_INLINE static void run(const Lanes& lanes) {
    lanes.put(0, generic::matrix(lanes.quat(0)) * lanes.vec3(1));
  }
};

/// a, b, t in 0..1 -> part of the nearer way from a to b
struct RotationSlerp {
  RIGC_INLINE static void run(const Lanes& lanes) {
    const Real t = generic::clamped(lanes.number(2), 0.0, 1.0);
    lanes.put(0, generic::slerp(generic::normalised(lanes.quat(0)),
                                generic::normalised(lanes.quat(1)), t));
  }
};

/// axis of any length, degrees -> rotation; none about an axis of no length
struct AxisAngle {
  RIGC_INLINE static void run(const Lanes& lanes) {
    const Vec3 axis = generic::unit(lanes.vec3(0));
    const auto half = generic::sine_cosine_degrees(lanes.number(1) * 0.5);
    const Quat turned{axis.x * half.sine, axis.y * half.sine, axis.z * half.sine, half.cosine};
    lanes.put(0, select(generic::is_zero(axis), Quat{}, turned));
  }
};

/// rotation, axis of any length -> degrees by which the rotation turns about the axis once the
/// shortest turn of the axis (the swing) is taken off, -180..180. Of a half turn across the axis 0.
struct TwistAngle {
  RIGC_INLINE static void run(const Lanes& lanes) {
    const Quat q = generic::normalised(lanes.quat(0));
    const Vec3 axis = generic::unit(lanes.vec3(1));
    const Real sine = dot(Vec3{q.x, q.y, q.z}, axis);
    const Real sign = select(q.w < 0.0, Real(-1.0), Real(1.0));
    const auto lost = (sine == 0.0) & (q.w == 0.0);
    const Real angle =
        2.0 * generic::degrees(generic::atan2(sine * sign, select(lost, Real(1.0), q.w * sign)));
    lanes.put(0, angle);
  }
};

/// from, to of any length -> the shortest rotation from one direction to the other
struct Between {
  RIGC_INLINE static void run(const Lanes& lanes) {
    const Vec3 from = generic::unit(lanes.vec3(0)), to = generic::unit(lanes.vec3(1));
    const auto lost = generic::is_zero(from) | generic::is_zero(to);
    const Vec3 x{Real(1.0), Real(0.0), Real(0.0)};
    lanes.put(0, generic::between(select(lost, x, from), select(lost, x, to)));
  }
};

/// primary, secondary -> the rotation whose x is along the primary and whose y leans to the
/// secondary
struct AimRotation {
  RIGC_INLINE static void run(const Lanes& lanes) {
    const Vec3 x{Real(1.0), Real(0.0), Real(0.0)};
    const Vec3 primary = generic::normalised(lanes.vec3(0), x);
    lanes.put(0, generic::quaternion(generic::frame(primary, lanes.vec3(1))));
  }
};

struct MatrixRotation {
  RIGC_INLINE static void run(const Lanes& lanes) {
    lanes.put(0, generic::quaternion(generic::orthonormal(lanes.affine(0).linear)));
  }
};

/// Along the matrix's own axes; z is negative where it is mirrored.
struct MatrixScale {
  RIGC_INLINE static void run(const Lanes& lanes) {
    lanes.put(0, generic::decompose(lanes.affine(0)).scale);
  }
};

/// Of a flat matrix the inverse of its rotation.
struct MatrixInverse {
  RIGC_INLINE static void run(const Lanes& lanes) { lanes.put(0, into(lanes.affine(0))); }
};

/// matrix, point
struct TransformPoint {
  RIGC_INLINE static void run(const Lanes& lanes) { lanes.put(0, lanes.affine(0) * lanes.vec3(1)); }
};

/// matrix, vector: without the origin
struct TransformVector {
  RIGC_INLINE static void run(const Lanes& lanes) {
    lanes.put(0, lanes.affine(0).linear * lanes.vec3(1));
  }
};

/// condition, where true, where false: of any width
struct Choose {
  RIGC_INLINE static void run(const Lanes& lanes) {
    const auto condition = lanes.number(0) != 0.0;
    for (std::size_t row = 0; row < lanes.width(1); ++row)
      lanes.put(row, select(condition, lanes.number(1, row), lanes.number(2, row)));
  }
};

}  // namespace
}  // namespace rigc::eval
