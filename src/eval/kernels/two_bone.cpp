// SPDX-License-Identifier: MIT
// Analytic two-bone IK by the law of cosines. Out of reach the limb is exactly straight, too near
// it is folded to the difference of its bones. What each input means is in scene/kinds.h.
// Test: tests/eval/two_bone_test.cpp
#include <cmath>

#include "eval/kernels/table.h"

namespace rigc::eval {

namespace {

using math::Quat;
using math::Vec3;

// Nearer to straight or folded than this (relative) counts as exactly so: the angle there is the
// square root of rounding noise.
constexpr double kSnap = 1e-13;
// Sine of the angle between goal and pole below which the pole says no plane.
constexpr double kPoleOnLine = 1e-6;
// A goal nearer to the start than this, in lengths of the limb, has no direction.
constexpr double kNowhere = 1e-12;

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
enum Twist : std::uint32_t { kOfPlane, kOfStart, kOfMiddle };

struct Data {
  Vec3 goal_offset;
  Quat start_offset, middle_offset;
  Vec3 normal;
};

Data read_data(const double* d) {
  return {{d[0], d[1], d[2]},
          {d[3], d[4], d[5], d[6]},
          {d[7], d[8], d[9], d[10]},
          {d[11], d[12], d[13]}};
}

// The plane of the limb: unit vectors at right angles to each other.
struct Plane {
  Vec3 direction;  // start to goal
  Vec3 normal;
};

Plane plane_of(const Vec3 to_goal, Vec3 to_pole, Vec3 rest_normal, double reach) {
  const Vec3 pole = math::normalised(to_pole, {});
  Plane plane;
  if (math::length(to_goal) <= kNowhere * reach) {
    // The limb lies in its rest plane, with the middle toward the pole.
    const math::Mat3 fold = math::frame(rest_normal, pole);
    return {math::cross(fold.y, rest_normal), rest_normal};
  }
  plane.direction = math::normalised(to_goal);
  const Vec3 normal = math::cross(plane.direction, pole);
  plane.normal = math::length(normal) < kPoleOnLine ? math::frame(plane.direction, rest_normal).y
                                                    : math::normalised(normal);
  return plane;
}

// Direction of the first bone, and of the second.
struct Bones {
  Vec3 first, second;
};

Bones bend(const Plane& plane, double a, double b, double distance) {
  const double longest = a + b, shortest = std::fabs(a - b);
  const bool straight = distance >= longest * (1 - kSnap);
  const bool folded = !straight && shortest > kSnap * longest && distance <= shortest * (1 + kSnap);
  const Vec3 back = a >= b ? plane.direction : -plane.direction;
  if (straight) return {plane.direction, plane.direction};
  if (folded) return {back, -back};
  // The middle's foot on the line, and its height above it.
  const double foot =
      distance > kNowhere * longest ? ((a - b) * (longest / distance) + distance) / 2 : 0;
  const double height = math::sqrt((a - foot) * (a + foot));
  const Vec3 side = math::cross(plane.normal, plane.direction);
  const Vec3 middle = plane.direction * foot + side * height;
  const Vec3 rest = plane.direction * (distance - foot) - side * height;
  return {math::normalised(middle, plane.direction), math::normalised(rest, plane.direction)};
}

// World rotation of a joint whose child lies along `bone`: x of the bone frame, z the bend normal.
// `child` is the child's place in the joint's rotated space: the frame is corrected so that the
// child lands on the bone also when it was moved off its rest direction.
math::Mat3 joint_axes(Vec3 bone, Vec3 normal, Quat offset, Vec3 child) {
  const math::Mat3 axes = math::frame(bone, math::cross(normal, bone));
  const Vec3 seen = math::rotate(offset, math::normalised(child, {}));
  const Quat correction =
      seen == Vec3{} ? Quat{} : math::between(math::normalised(seen), {1, 0, 0});
  return axes * math::matrix(correction * offset);
}

// The bend normal as a joint that is turned about its bone takes it.
Vec3 turned(const Call& call, Twist twist, int lane, Vec3 bone, Vec3 normal) {
  if (call.arguments[kTwist].width <= twist) return normal;
  const double degrees = call.in(kTwist)[twist * kLanes + static_cast<std::uint32_t>(lane)];
  return math::rotate(math::axis_angle(bone, math::radians(degrees)), normal);
}

math::Affine world(const math::Mat3& r, Vec3 scale, Vec3 origin) {
  return {{r.x * scale.x, r.y * scale.y, r.z * scale.z}, origin};
}

void solve(const Call& call, const Data& data, int lane) {
  const math::Affine base = read_affine(call.in(kBase), lane);
  const Vec3 start_scale = read_vec3(call.in(kStartScale), lane);
  const Vec3 middle_scale = read_vec3(call.in(kMiddleScale), lane);
  const Vec3 upper = math::scaled(read_vec3(call.in(kMiddle), lane), start_scale);
  const Vec3 lower =
      math::scaled(read_vec3(call.in(kEnd), lane), math::scaled(start_scale, middle_scale));
  const double size = math::cbrt(std::fabs(math::determinant(base.linear)));
  const double a = math::length(upper) * size, b = math::length(lower) * size;

  const Vec3 start = base * read_vec3(call.in(kStart), lane);
  const Vec3 to_goal = read_affine(call.in(kGoal), lane) * data.goal_offset - start;
  const Vec3 to_pole = read_affine(call.in(kPole), lane).origin - start;
  const math::Trs of_base = math::decompose(base);
  const Vec3 rest_normal =
      math::rotate(of_base.rotation, math::normalised(data.normal, Vec3{0, 0, 1}));
  Plane plane = plane_of(to_goal, to_pole, rest_normal, a + b);
  const Quat twist = math::axis_angle(plane.direction, math::radians(call.in(kTwist)[lane]));
  plane.normal = math::rotate(twist, plane.normal);
  const Bones bones = bend(plane, a, b, math::length(to_goal));

  // A mirrored base is one whose z is turned over.
  const Vec3 mirror{1, 1, of_base.scale.z < 0 ? -1.0 : 1.0};
  const Vec3 first_normal = turned(call, kOfStart, lane, bones.first, plane.normal);
  const Vec3 second_normal = turned(call, kOfMiddle, lane, bones.second, plane.normal);
  const math::Mat3 first =
      joint_axes(bones.first, first_normal, data.start_offset, math::scaled(upper, mirror));
  const math::Mat3 second =
      joint_axes(bones.second, second_normal, data.middle_offset, math::scaled(lower, mirror));
  const Vec3 start_total = math::scaled(of_base.scale, start_scale);
  const Vec3 middle_total = math::scaled(start_total, middle_scale);
  const Vec3 middle = start + bones.first * a;
  write(call.result(), lane, world(first, start_total, start));
  write(call.result() + 12 * kLanes, lane, world(second, middle_total, middle));
}

}  // namespace

void ik_two_bone(const Call& call) {
  const Data data = read_data(call.data);
  for (int lane = 0; lane < kLanes; ++lane) solve(call, data, lane);
}

}  // namespace rigc::eval
