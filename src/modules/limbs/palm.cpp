// SPDX-License-Identifier: MIT
// The hand at rest as geometry. Test: tests/modules/hand_test.cpp
#include "modules/limbs/palm.h"

#include <algorithm>
#include <cmath>

#include "modules/made.h"

namespace rigc::modules {
namespace {

using math::Vec3;

constexpr std::size_t kPhalanges = 3;
/// Wrists nearer to the middle than this, in heights of the character, are on the side that the
/// template says.
constexpr double kMiddle = 0.01;
/// Fingers nearer to the character's forward than this (cosine) have their thumb up.
constexpr double kForward = 0.8;
/// How much the palm's plane counts beside the sines of a finger's own bends.
constexpr double kPalmShare = 0.3;
/// Cosine to the palm's axis above which a finger's own bend counts.
constexpr double kAgrees = 0.7;

/// 1 for a left hand, -1 for a right one, turned round where the rig's space is mirrored.
double handedness(const Builder& b, NodeId wrist) {
  const tags::Character& c = b.character();
  const double side = math::dot(position(b, wrist), c.left) - b.side_middle();
  const bool clear = std::abs(side) > kMiddle * c.height;
  const bool left = clear ? side > 0 : !is_mirrored(b, wrist);
  const bool mirrored_space = math::dot(math::cross(c.up, c.forward), c.left) < 0;
  return left == mirrored_space ? -1 : 1;
}

Vec3 without(Vec3 v, Vec3 unit) { return v - unit * math::dot(v, unit); }

}  // namespace

namespace {

/// Knuckles are farther from the wrist than the bone after them is long; metacarpals begin at it.
bool is_metacarpal(const Builder& b, NodeId wrist, const std::vector<NodeId>& joints) {
  if (!wrist.valid() || joints.size() < 2) return false;
  const Vec3 first = position(b, joints[0]);
  return math::length(first - position(b, wrist)) < math::length(position(b, joints[1]) - first);
}

}  // namespace

Finger finger_from(const Builder& b, const std::vector<NodeId>& controls, NodeId wrist) {
  Finger finger;
  finger.controls = controls;
  for (NodeId control : controls) finger.joints.push_back(owner(b, control));
  finger.knuckle = controls.size() > kPhalanges ? controls.size() - kPhalanges : 0;
  if (finger.knuckle == 0 && is_metacarpal(b, wrist, finger.joints)) finger.knuckle = 1;
  for (std::size_t i = 0; i < controls.size(); ++i)
    finger.bones.push_back(chain_direction(b, finger.joints, i));
  return finger;
}

Palm palm_from(const Builder& b, NodeId wrist, const std::vector<Finger>& fingers) {
  const auto knuckle = [&](const Finger& f) { return position(b, f.joints[f.knuckle]); };
  Palm palm;
  for (const Finger& finger : fingers) palm.knuckles = palm.knuckles + knuckle(finger);
  palm.knuckles = palm.knuckles * (1.0 / static_cast<double>(fingers.size()));
  palm.along = math::normalised(palm.knuckles - position(b, wrist), bone_direction(b, wrist));
  // A single finger does not say where the thumb is: forward, as in a T-pose.
  const tags::Character& c = b.character();
  const Vec3 ahead = std::abs(math::dot(palm.along, c.forward)) > kForward ? c.up : c.forward;
  const bool several = fingers.size() > 1;
  const Vec3 across = several ? knuckle(fingers.front()) - knuckle(fingers.back()) : ahead;
  palm.across = math::normalised(without(across, palm.along), ahead);
  palm.inward = math::cross(palm.along, palm.across) * handedness(b, wrist);
  return palm;
}

Vec3 thumb_inward(const Palm& palm) { return math::normalised(palm.inward * 0.4 - palm.across); }

Vec3 bend_axis(const Finger& finger, Vec3 toward) {
  const Vec3 first = finger.bones[finger.knuckle];
  const Vec3 plain = math::normalised(math::cross(first, toward));
  Vec3 own;
  for (std::size_t i = finger.knuckle; i + 1 < finger.bones.size(); ++i)
    own = own + math::cross(finger.bones[i], finger.bones[i + 1]);
  if (math::dot(own, plain) < kAgrees * math::length(own)) return plain;
  return math::normalised(without(own + plain * kPalmShare, first), plain);
}

double bone_length(const Builder& b, const Finger& finger, std::size_t n) {
  if (n + 1 < finger.joints.size())
    return math::length(position(b, finger.joints[n + 1]) - position(b, finger.joints[n]));
  if (n > 0) return 0.8 * bone_length(b, finger, n - 1);
  const NodeId above = b.scene()[finger.joints[n]].parent;
  return 0.8 * math::length(position(b, finger.joints[n]) - position(b, above));
}

Vec3 first_of_two(Vec3 goal, double first, double second, Vec3 bend) {
  const double longest = first + second, shortest = std::abs(first - second);
  const double apart = std::clamp(math::length(goal), shortest, longest);
  const Vec3 direction = math::normalised(goal);
  if (!(first > 0) || !(apart > 0)) return direction;
  const double along = (first * first - second * second + apart * apart) / (2 * apart);
  const double out = math::sqrt(std::max(0.0, first * first - along * along));
  const Vec3 side = math::normalised(without(bend, direction), math::perpendicular(direction));
  return math::normalised(direction * along + side * out, direction);
}

double bend_between(Vec3 before, Vec3 bone, Vec3 axis) {
  return math::degrees(
      math::atan2(math::dot(math::cross(before, bone), axis), math::dot(before, bone)));
}

}  // namespace rigc::modules
