// SPDX-License-Identifier: MIT
// A pose of a rig as an animator makes it.
#include "support/pose.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

namespace rigc::test {

using math::Affine;
using math::Vec3;
using scene::NodeId;

namespace {

NodeId parent_of(const Rig& rig, const std::string& node) {
  return rig.scene()[rig.node(node)].parent;
}

}  // namespace

Pose& Pose::set(const std::string& plug, const scene::Value& value) {
  const scene::Plug at = rig_.plug(plug);
  std::erase_if(settings_, [&](const eval::Setting& s) { return s.plug == at; });
  settings_.push_back({at, value});
  return *this;
}

Pose& Pose::translate(const std::string& control, Vec3 value) {
  return set(control + "@translate", value);
}

Pose& Pose::rotate(const std::string& control, Vec3 degrees) {
  return turn(control, math::from_euler_degrees(degrees));
}

Pose& Pose::turn(const std::string& control, math::Quat rotation) {
  return set(control + "@rotation", rotation);
}

Pose& Pose::move_to(const std::string& control, Vec3 point) {
  const Affine space = worlds({parent_of(rig_, control)}).front();
  return translate(control, math::inverse(space) * point);
}

Pose& Pose::turn_in_world(const std::string& control, math::Quat rotation) {
  const Affine rest = rig_.scene().rest_world(parent_of(rig_, control));
  const math::Quat axes = math::quaternion(math::orthonormal(rest.linear));
  return turn(control, conjugate(axes) * rotation * axes);
}

std::vector<Affine> Pose::worlds(const std::vector<NodeId>& nodes) const {
  const std::vector<Affine> found = eval::worlds(rig_.scene(), nodes, settings_);
  REQUIRE(found.size() == nodes.size());
  return found;
}

Affine Pose::world(const std::string& node) const { return worlds({rig_.node(node)}).front(); }

std::vector<Affine> Pose::joints() const {
  std::vector<NodeId> nodes;
  for (const tags::TaggedJoint& joint : rig_.skeleton.joints) {
    nodes.push_back(rig_.index().joint(joint.key));
  }
  return worlds(nodes);
}

scene::Value Pose::value(const std::string& plug) const {
  Diagnostics diagnostics;
  const auto found = eval::evaluate(rig_.scene(), {rig_.plug(plug)}, settings_, diagnostics);
  INFO(plug << "\n" << text(diagnostics));
  REQUIRE(found);
  return found->front();
}

double Pose::number(const std::string& plug) const { return std::get<double>(value(plug)); }
Vec3 Pose::vector(const std::string& plug) const { return std::get<Vec3>(value(plug)); }

double distance(Vec3 a, Vec3 b) { return math::length(a - b); }

double difference(const Affine& a, const Affine& b, double length) {
  const double size = std::max(
      {math::length(b.linear.x), math::length(b.linear.y), math::length(b.linear.z), 1e-300});
  const double turn = std::max({distance(a.linear.x, b.linear.x), distance(a.linear.y, b.linear.y),
                                distance(a.linear.z, b.linear.z)}) /
                      size;
  return std::max(turn, distance(a.origin, b.origin) / length);
}

double largest_difference(const std::vector<Affine>& a, const std::vector<Affine>& b,
                          double length) {
  REQUIRE(a.size() == b.size());
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, difference(a[i], b[i], length));
  return most;
}

double rest_error(const Rig& rig) {
  std::vector<Affine> rests;
  for (std::size_t j = 0; j < rig.skeleton.joints.size(); ++j)
    rests.push_back(rig.skeleton.world(j));
  return largest_difference(Pose(rig).joints(), rests, rig.skeleton.character.height);
}

std::vector<double> bone_lengths(const Rig& rig, const std::vector<Affine>& joints) {
  std::vector<double> lengths;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const int parent = rig.skeleton.joints[j].parent;
    lengths.push_back(
        parent < 0 ? 0
                   : distance(joints[j].origin, joints[static_cast<std::size_t>(parent)].origin));
  }
  return lengths;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  REQUIRE(a.size() == b.size());
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

}  // namespace rigc::test
