// SPDX-License-Identifier: MIT
// A two-bone limb backwards: the arithmetic of eval's kernel, read the other way.
// Test: tests/bake/transfer_test.cpp
#include "bake/transfer_limb.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace rigc::bake {
namespace {

using math::Vec3;

/// Sine of the angle between the bones below which the start's joint says the plane of the limb;
/// above twice of it the bones do.
constexpr double kStraight = 2e-5;

constexpr std::size_t kAround = 4;

/// The 32-bit floats around a number, the nearest first.
void floats_around(double x, double (&out)[kAround]) {
  const auto nearest = static_cast<float>(x);
  const float up = std::nextafter(nearest, HUGE_VALF), down = std::nextafter(nearest, -HUGE_VALF);
  const bool is_above = static_cast<double>(nearest) < x;
  const float beyond = is_above ? std::nextafter(up, HUGE_VALF) : std::nextafter(down, -HUGE_VALF);
  const float all[kAround] = {nearest, is_above ? up : down, is_above ? down : up, beyond};
  std::copy(std::begin(all), std::end(all), out);
}

/// Sine of the angle between the bones below which a limb counts as exactly straight or folded: no
/// goal of 32-bit floats says so little.
constexpr double kExactly = 5e-6;

/// 1 for a limb that is exactly straight, whose goal may lie farther away but no nearer; -1 for one
/// that is exactly folded, where it is the other way round; else 0.
double bend_of(const Bones& bones) {
  if (math::length(math::cross(bones.first, bones.second)) > kExactly) return 0;
  return math::dot(bones.first, bones.second) > 0 ? 1 : -1;
}

/// How far the goal is from the start.
double distance_of(const Bones& bones, double bent) {
  if (bent == 0) return math::length(bones.end - bones.start);
  const double upper = math::length(bones.middle - bones.start);
  const double lower = math::length(bones.end - bones.middle);
  return std::fabs(upper + bent * lower);
}

Vec3 perpendicular_part(Vec3 v, Vec3 unit) { return v - unit * math::dot(v, unit); }

}  // namespace

Bones bones_of(const Limb& limb, const math::Affine& start, const math::Affine& middle) {
  const Vec3 upper = math::scaled(limb.middle, limb.start_scale);
  const Vec3 lower = math::scaled(limb.end, math::scaled(limb.start_scale, limb.middle_scale));
  const double determinant = math::determinant(limb.base.linear);
  const double size = math::cbrt(std::fabs(determinant));
  const Vec3 mirror{1, 1, determinant < 0 ? -1.0 : 1.0};
  Bones bones;
  bones.first_child = math::normalised(math::scaled(upper, mirror));
  bones.second_child = math::normalised(math::scaled(lower, mirror));
  bones.first = math::orthonormal(start.linear) * bones.first_child;
  bones.second = math::orthonormal(middle.linear) * bones.second_child;
  bones.start = limb.base * limb.start;
  bones.middle = bones.start + bones.first * (math::length(upper) * size);
  bones.end = bones.middle + bones.second * (math::length(lower) * size);
  return bones;
}

Vec3 rounded_goal(const Bones& bones, const math::Affine& to_point) {
  const Vec3 exact = math::inverse(to_point) * bones.end;
  const double bent = bend_of(bones);
  const double distance = distance_of(bones, bent);
  const auto error_of = [&](Vec3 translation) {
    const double more = math::length(to_point * translation - bones.start) - distance;
    return std::fabs(more) + (more * bent < 0 ? distance : 0);
  };
  double candidates[3][kAround];
  for (std::size_t i = 0; i < 3; ++i) floats_around(exact[i], candidates[i]);
  Vec3 best{candidates[0][0], candidates[1][0], candidates[2][0]};
  for (const double x : candidates[0])
    for (const double y : candidates[1])
      for (const double z : candidates[2])
        if (error_of({x, y, z}) < error_of(best)) best = {x, y, z};
  return best;
}

Vec3 bent_side(const Bones& bones, const math::Affine& start, math::Quat bone_offset) {
  const Vec3 direction = math::normalised(bones.end - bones.start, bones.first);
  const math::Mat3 axes = math::orthonormal(start.linear) *
                          math::transposed(math::matrix(math::normalised(bone_offset)));
  const Vec3 turned =
      math::normalised(math::cross(axes.z, direction), math::perpendicular(direction));
  const double sine = math::length(math::cross(bones.first, bones.second));
  const double weight = std::clamp(sine / kStraight - 1, 0.0, 1.0);
  const Vec3 out = perpendicular_part(bones.middle - bones.start, direction);
  const Vec3 mixed = math::normalised(out, turned) * weight + turned * (1 - weight);
  return math::normalised(perpendicular_part(mixed, direction), turned);
}

double twist_of(const Bones& bones, Vec3 side, Vec3 bone, Vec3 child, math::Quat joint_offset,
                const math::Affine& joint) {
  const Vec3 direction = math::normalised(bones.end - bones.start, bones.first);
  const Vec3 normal = math::cross(direction, side);
  const math::Mat3 frame = math::frame(bone, math::cross(normal, bone));
  const math::Quat offset = math::normalised(joint_offset);
  const math::Quat correction =
      math::between(math::normalised(math::rotate(offset, child)), {1, 0, 0});
  const math::Mat3 untwisted = frame * math::matrix(correction * offset);
  const math::Quat turn =
      math::quaternion(math::orthonormal(joint.linear) * math::transposed(untwisted));
  return math::degrees(2 * math::atan2(math::dot(Vec3{turn.x, turn.y, turn.z}, bone), turn.w));
}

}  // namespace rigc::bake
