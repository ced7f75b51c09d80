// SPDX-License-Identifier: MIT
// Clamping along and about axes. Test: tests/math/limit_test.cpp
#include "math/limit.h"

#include <cmath>
#include <limits>

namespace rigc::math {

namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();
// Sums of angles nearer to each other than this are equal: the first triple counts.
constexpr double kTie = 1e-9;

double clamped(double x, double low, double high) { return x < low ? low : x > high ? high : x; }

Vec3 clamped(Vec3 v, const LimitSpace& space) {
  return {clamped(v.x, space.min.x, space.max.x), clamped(v.y, space.min.y, space.max.y),
          clamped(v.z, space.min.z, space.max.z)};
}

double size_of(Vec3 angles) {
  return std::fabs(angles.x) + std::fabs(angles.y) + std::fabs(angles.z);
}

double half_turn_on(double degrees) { return degrees > 0 ? degrees - 180 : degrees + 180; }

/// Angles about three axes turned about in order x, y, z; the smaller of the two triples.
Vec3 smaller_angles(Quat q) {
  const Vec3 angles = to_euler_degrees(q);
  const Vec3 other{half_turn_on(angles.x), (angles.y < 0 ? -180 : 180) - angles.y,
                   half_turn_on(angles.z)};
  return size_of(other) < size_of(angles) - kTie ? other : angles;
}

/// By whole turns to where the angle lies between its bounds, or is nearest to them.
double turned_near(double angle, double low, double high) {
  if ((angle >= low && angle <= high) || !(low > -kNone && high < kNone)) return angle;
  const double above = angle + 360 * std::ceil((low - angle) / 360);
  return above - high <= low - (above - 360) ? above : above - 360;
}

/// An odd order of axes is a mirror image: angles turn round.
double sign_of(const int* order) { return (order[1] - order[0] + 3) % 3 == 1 ? 1.0 : -1.0; }

double& at(Quat& q, int axis) { return axis == 0 ? q.x : axis == 1 ? q.y : q.z; }

Vec3 angles_of(Quat q, const int* order) {
  const double sign = sign_of(order);
  const Quat permuted{sign * at(q, order[0]), sign * at(q, order[1]), sign * at(q, order[2]), q.w};
  const Vec3 found = smaller_angles(permuted);
  Vec3 angles;
  for (std::size_t i = 0; i < 3; ++i) angles[static_cast<std::size_t>(order[i])] = sign * found[i];
  return angles;
}

Quat rotation_of(Vec3 angles, const int* order) {
  const double sign = sign_of(order);
  Vec3 permuted;
  for (std::size_t i = 0; i < 3; ++i)
    permuted[i] = sign * angles[static_cast<std::size_t>(order[i])];
  const Quat found = from_euler_degrees(permuted);
  Quat q;
  q.w = found.w;
  at(q, order[0]) = sign * found.x;
  at(q, order[1]) = sign * found.y;
  at(q, order[2]) = sign * found.z;
  return q;
}

}  // namespace

LimitSpace::LimitSpace() : min{-kNone, -kNone, -kNone}, max{kNone, kNone, kNone} {}

bool LimitSpace::bounded() const {
  for (std::size_t i = 0; i < 3; ++i)
    if (min[i] > -kNone || max[i] < kNone) return true;
  return false;
}

Vec3 limit_vector(Vec3 value, const LimitSpace& space) {
  const Vec3 measured = rotate(conjugate(space.axes), value - space.origin);
  const Vec3 inside = clamped(measured, space);
  if (inside == measured) return value;
  return space.origin + rotate(space.axes, inside);
}

Quat limit_rotation(Quat value, const LimitSpace& space) {
  const Quat turn = normalised(value) * conjugate(space.rest);
  Vec3 angles = angles_of(conjugate(space.axes) * turn * space.axes, space.order);
  for (std::size_t i = 0; i < 3; ++i)
    angles[i] = turned_near(angles[i], space.min[i], space.max[i]);
  const Vec3 inside = clamped(angles, space);
  if (inside == angles) return value;
  return space.axes * rotation_of(inside, space.order) * conjugate(space.axes) * space.rest;
}

}  // namespace rigc::math
