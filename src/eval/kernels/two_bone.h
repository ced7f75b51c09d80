// SPDX-License-Identifier: MIT
// Analytic two-bone IK by the law of cosines. Out of reach the limb is exactly straight, too near
// it is folded to the difference of its bones. What each input means is in scene/kinds.h.
// Test: tests/eval/two_bone_test.cpp
#pragma once

#include "eval/kernels/lanes.h"
#include "math/generic/exponential.h"

namespace rigc::eval {
namespace {

/// base ... middle_scale; data: goal offset, rotation offsets, normal -> two worlds
struct TwoBone {
  enum Argument : std::size_t {
    kBase,
    kGoal,
    kPole,
    kTwist,
    kStart,
    kMiddle,
    kEnd,
    kStartScale,
    kMiddleScale
  };
  // Rows of the twist, which has one or, where joints may be turned about their bones, three.
  enum Twist : std::size_t { kOfPlane, kOfStart, kOfMiddle };
  enum Table : std::size_t { kGoalOffset = 0, kStartOffset = 3, kMiddleOffset = 7, kNormal = 11 };

  // Nearer to straight or folded than this (relative) counts as exactly so: the angle there is the
  // square root of rounding noise.
  static constexpr double kSnap = 1e-13;
  // Sine of the angle between goal and pole below which the pole says no plane.
  static constexpr double kPoleOnLine = 1e-6;
  // A goal nearer to the start than this, in lengths of the limb, has no direction.
  static constexpr double kNowhere = 1e-12;

  RIGC_INLINE static void run(const Lanes& lanes) {
    const double* d = lanes.data();
    const Affine base = lanes.affine(kBase);
    const Vec3 start_scale = lanes.vec3(kStartScale), middle_scale = lanes.vec3(kMiddleScale);
    const Vec3 upper = scaled(lanes.vec3(kMiddle), start_scale);
    const Vec3 lower = scaled(lanes.vec3(kEnd), scaled(start_scale, middle_scale));
    const Real size = generic::cbrt(magnitude(generic::determinant(base.linear)));
    const Real a = generic::length(upper) * size, b = generic::length(lower) * size;

    const Vec3 start = base * lanes.vec3(kStart);
    const Vec3 to_goal = lanes.affine(kGoal) * vec3_at(d + kGoalOffset) - start;
    const Vec3 to_pole = lanes.origin(kPole) - start;
    const Mat3 axes = generic::orthonormal(base.linear);
    const Vec3 base_scale{dot(axes.x, base.linear.x), dot(axes.y, base.linear.y),
                          dot(axes.z, base.linear.z)};
    const Vec3 normal =
        generic::normalised(vec3_at(d + kNormal), Vec3{Real(0.0), Real(0.0), Real(1.0)});
    Plane plane = plane_of(to_goal, to_pole, axes * normal, a + b);
    const Quat twist = generic::axis_angle(plane.direction, generic::radians(lanes.number(kTwist)));
    plane.normal = rotate(twist, plane.normal);
    const Bones bones = bend(plane, a, b, generic::length(to_goal));

    const Vec3 first_normal = turned(lanes, kOfStart, bones.first, plane.normal);
    const Vec3 second_normal = turned(lanes, kOfMiddle, bones.second, plane.normal);
    // A mirrored base is one whose z is turned over.
    const Vec3 mirror{Real(1.0), Real(1.0), select(base_scale.z < 0.0, Real(-1.0), Real(1.0))};
    const Mat3 first =
        joint_axes(bones.first, first_normal, quat_at(d + kStartOffset), scaled(upper, mirror));
    const Mat3 second =
        joint_axes(bones.second, second_normal, quat_at(d + kMiddleOffset), scaled(lower, mirror));
    const Vec3 start_total = scaled(base_scale, start_scale);
    const Vec3 middle_total = scaled(start_total, middle_scale);
    lanes.put(0, world(first, start_total, start));
    lanes.put(12, world(second, middle_total, start + bones.first * a));
  }

 private:
  /// The plane of the limb: unit vectors at right angles to each other.
  struct Plane {
    Vec3 direction;  // start to goal
    Vec3 normal;
  };

  RIGC_INLINE static Plane plane_of(Vec3 to_goal, Vec3 to_pole, Vec3 rest_normal, Real reach) {
    const Vec3 pole = generic::unit(to_pole);
    Plane plane;
    plane.direction = generic::normalised(to_goal, Vec3{Real(1.0), Real(0.0), Real(0.0)});
    const Vec3 normal = cross(plane.direction, pole);
    const auto on_line = generic::length(normal) < kPoleOnLine;
    plane.normal = generic::normalised(normal, rest_normal);
    if (any(on_line)) {
      const Vec3 beside = generic::frame(plane.direction, rest_normal).y;
      plane.normal = select(on_line, beside, plane.normal);
    }
    const auto nowhere = generic::length(to_goal) <= kNowhere * reach;
    if (any(nowhere)) {
      // The limb lies in its rest plane, with the middle toward the pole.
      const Mat3 fold = generic::frame(rest_normal, pole);
      plane.direction = select(nowhere, cross(fold.y, rest_normal), plane.direction);
      plane.normal = select(nowhere, rest_normal, plane.normal);
    }
    return plane;
  }

  /// Direction of the first bone, and of the second.
  struct Bones {
    Vec3 first, second;
  };

  RIGC_INLINE static Bones bend(const Plane& plane, Real a, Real b, Real distance) {
    const Real longest = a + b, shortest = magnitude(a - b);
    const auto straight = distance >= longest * (1.0 - kSnap);
    const auto short_of = distance <= shortest * (1.0 + kSnap);
    const auto folded = (shortest > kSnap * longest) & short_of;
    const Vec3 back = select(a >= b, plane.direction, -plane.direction);
    // The middle's foot on the line, and its height above it.
    const auto away = distance > kNowhere * longest;
    const Real apart = select(away, distance, Real(1.0));
    const Real foot = select(away, ((a - b) * (longest / apart) + apart) * 0.5, Real(0.0));
    const Real height = generic::sqrt((a - foot) * (a + foot));
    const Vec3 side = cross(plane.normal, plane.direction);
    const Vec3 middle = plane.direction * foot + side * height;
    const Vec3 rest = plane.direction * (distance - foot) - side * height;
    const Vec3 first = generic::normalised(middle, plane.direction);
    const Vec3 second = generic::normalised(rest, plane.direction);
    return {select(straight, plane.direction, select(folded, back, first)),
            select(straight, plane.direction, select(folded, -back, second))};
  }

  /// World rotation of a joint whose child lies along `bone`: x of the bone frame, z the bend
  /// normal. `child` is the child's place in the joint's rotated space: the frame is corrected so
  /// that the child lands on the bone also when it was moved off its rest direction.
  RIGC_INLINE static Mat3 joint_axes(Vec3 bone, Vec3 normal, Quat offset, Vec3 child) {
    const Mat3 axes = generic::frame(bone, cross(normal, bone));
    const Vec3 x{Real(1.0), Real(0.0), Real(0.0)};
    const Vec3 seen = rotate(offset, generic::unit(child));
    const Quat correction =
        select(generic::is_zero(seen), Quat{}, generic::between(generic::normalised(seen, x), x));
    return axes * generic::matrix(correction * offset);
  }

  /// The bend normal as a joint that is turned about its bone takes it.
  RIGC_INLINE static Vec3 turned(const Lanes& lanes, Twist row, Vec3 bone, Vec3 normal) {
    if (lanes.width(kTwist) <= row) return normal;
    return rotate(generic::axis_angle(bone, generic::radians(lanes.number(kTwist, row))), normal);
  }

  RIGC_INLINE static Affine world(const Mat3& r, Vec3 scale, Vec3 origin) {
    return {{r.x * scale.x, r.y * scale.y, r.z * scale.z}, origin};
  }
};

}  // namespace
}  // namespace rigc::eval
