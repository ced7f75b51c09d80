// SPDX-License-Identifier: MIT
// decompose: how far a node has moved and turned from rest: translation, scale, swing and twist
// about an axis, angles in any order.
// Test: tests/modules/decompose_test.cpp
#include <array>

#include "modules/made.h"
#include "modules/registry.h"
#include "modules/utilities/utilities.h"

namespace rigc::modules {
namespace {

using math::Affine;
using math::Vec3;

Vec3 axis_named(char name) {
  return {name == 'x' ? 1.0 : 0.0, name == 'y' ? 1.0 : 0.0, name == 'z' ? 1.0 : 0.0};
}

/// A rotation that takes x, y and z to the axes in an order. The third is turned round where the
/// order is odd (`sign` -1): then its angle is.
struct Order {
  math::Quat axes;
  double sign = 1;
};
Order order_from(const std::string& order) {
  const Vec3 first = axis_named(order[0]), second = axis_named(order[1]);
  const Vec3 third = math::cross(first, second);
  const double sign = math::dot(third, axis_named(order[2]));
  return {math::quaternion({first, second, third}), sign};
}

/// The frame, at the node, whose axes count.
Affine frame_of(const Builder& b, NodeId node) {
  const std::string& orient = b.with().text("orient");
  const Affine at_rest = rest(b, node);
  if (orient == "joint") return {math::orthonormal(at_rest.linear), at_rest.origin};
  const NodeId joint = owner(b, node);
  return {oriented(b, joint.valid() ? joint : b.joint(), orient).linear, at_rest.origin};
}

}  // namespace

void decompose(Builder& b) {
  const Parameters& with = b.with();
  const NodeId node = with.node("node");
  if (!check_place(b, node, "node")) return;
  const NodeId space = space_or_parent(b, "space", node);
  if (b.failed()) return;
  const Affine frame = frame_of(b, node);
  const Order order = order_from(with.text("order"));
  // Angles come in the order in which they are turned; x, y and z of the output are those about x,
  // y and z.
  const char* const parts[] = {"_a.x", "_a.y", "_sign * _a.z"};
  std::array<std::string, 3> about;
  for (std::size_t i = 0; i < 3; ++i)
    about[static_cast<std::size_t>(with.text("order")[i] - 'x')] = parts[i];
  make_utility(b,
               {{"_node", node},
                world_given("_space", space),
                {"_before", scene::Value(math::inverse(rest_or_identity(b, space)) * frame)},
                {"_on", scene::Value(math::inverse(rest(b, node)) * frame)},
                {"_axis", scene::Value(axis_named(with.text("axis")[0]))},
                {"_order", scene::Value(order.axes)},
                {"_sign", scene::Value(order.sign)}},
               "out matrix = inverse(_space * _before) * _node * _on;"
               " out translate = matrix.origin; out rotation = rotation(matrix);"
               " out scale = scale(matrix); out twist = twist(rotation, _axis);"
               " out swing = swing(rotation, _axis); out swing_angles = angles(swing);"
               " _a = angles(inverse(_order) * rotation * _order);"
               " out angles = vector(" +
                   about[0] + ", " + about[1] + ", " + about[2] + ");");
}

}  // namespace rigc::modules
