// SPDX-License-Identifier: MIT
// A pose of a rig as an animator makes it: values on controls, then where things are. Compares with
// rest, and with other poses.
#pragma once

#include <string>
#include <vector>

#include "eval/evaluate.h"
#include "support/rig.h"

namespace rigc::test {

class Pose {
 public:
  explicit Pose(const Rig& rig) : rig_(rig) {}

  /// `control@attribute`, whole: a vector, a number.
  Pose& set(const std::string& plug, const scene::Value& value);
  Pose& translate(const std::string& control, math::Vec3 value);
  /// Degrees, X then Y then Z.
  Pose& rotate(const std::string& control, math::Vec3 degrees);
  Pose& turn(const std::string& control, math::Quat rotation);

  /// Translates a control so that it is at a point of rig space, wherever its zero is now.
  Pose& move_to(const std::string& control, math::Vec3 point);
  /// Turns a control by a rotation about an axis of rig space, from how it rests.
  Pose& turn_in_world(const std::string& control, math::Quat rotation);

  math::Affine world(const std::string& node) const;
  math::Vec3 position(const std::string& node) const { return world(node).origin; }
  /// Worlds of the skeleton's joints, in its order.
  std::vector<math::Affine> joints() const;
  std::vector<math::Affine> worlds(const std::vector<scene::NodeId>& nodes) const;
  double number(const std::string& plug) const;
  math::Vec3 vector(const std::string& plug) const;

 private:
  scene::Value value(const std::string& plug) const;
  const Rig& rig_;
  std::vector<eval::Setting> settings_;
};

double distance(math::Vec3 a, math::Vec3 b);
/// Largest difference of any entry of two matrices; their linear parts are compared relative to
/// the size of `b`'s.
double difference(const math::Affine& a, const math::Affine& b, double length);
double largest_difference(const std::vector<math::Affine>& a, const std::vector<math::Affine>& b,
                          double length);

/// How far any joint is from its rest when no control is touched; in heights of the character.
double rest_error(const Rig& rig);

/// Distances from each joint to its parent; 0 for roots.
std::vector<double> bone_lengths(const Rig& rig, const std::vector<math::Affine>& joints);
double largest_difference(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace rigc::test
