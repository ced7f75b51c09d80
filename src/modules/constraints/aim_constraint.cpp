// SPDX-License-Identifier: MIT
// aim_constraint: an axis of a node looks at targets, another stays turned up.
// Test: tests/modules/constraints_test.cpp
#include <cmath>

#include "modules/codes.h"
#include "modules/constraints/weights.h"
#include "modules/registry.h"

namespace rigc::modules {
namespace {

using math::Mat3;
using math::Vec3;

Vec3 axis_vector(const std::string& name) {
  const double sign = name[0] == '-' ? -1.0 : 1.0;
  Vec3 axis;
  axis[static_cast<std::size_t>(name[1] - 'x')] = sign;
  return axis;
}

/// The axis of `axes` nearest to a direction; `except` (an axis) and its opposite are left out.
Vec3 nearest_axis(const Mat3& axes, Vec3 direction, const Vec3* except) {
  const Vec3 local = math::transposed(axes) * direction;
  Vec3 best;
  double most = -1;
  for (std::size_t i = 0; i < 3; ++i) {
    if ((except && (*except)[i] != 0) || std::abs(local[i]) <= most) continue;
    most = std::abs(local[i]);
    best = {};
    best[i] = local[i] < 0 ? -1.0 : 1.0;
  }
  return best;
}

/// Up in rig space at rest, and how the constraint finds it while the rig moves.
Vec3 connect_up(Builder& b, NodeId node, NodeId driven) {
  namespace aim = scene::aim;
  const Vec3 written = b.with().vec3("up_vector");
  const Vec3 up = math::normalised(character_axes(b) * written, b.character().up);
  if (!b.with().has("up_target")) {
    b.set({node, aim::kUpVector}, up);
    return up;
  }
  const NodeId up_target = b.with().node("up_target");
  if (!check_place(b, up_target, "up_target")) return up;
  b.set({node, aim::kUpMode}, 1.0);
  b.set({node, aim::kUpVector}, up);
  b.connect(world_of(up_target), {node, aim::kUpTarget});
  return math::normalised(position(b, up_target) - position(b, driven), up);
}

/// Where targets rest on average; without weight all count the same, as in the constraint itself.
Vec3 mean_position(const std::vector<Target>& targets, const std::vector<double>& weights) {
  double sum = 0;
  for (double weight : weights) sum += weight;
  Vec3 mean;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const double share = sum > 0 ? weights[i] / sum : 1 / static_cast<double>(targets.size());
    mean = mean + targets[i].rest.origin * share;
  }
  return mean;
}

/// Rotation of the driven node seen from the aim frame (x at the targets, y up), so that its named
/// axes lie on the frame's. `axes`: as it rests; `auto` names the nearest.
Mat3 named_axes(Builder& b, const Mat3& axes, Vec3 toward, Vec3 up) {
  const std::string& aim_name = b.with().text("aim");
  const std::string& up_name = b.with().text("up");
  const Vec3 named_up = up_name == "auto" ? Vec3{} : axis_vector(up_name);
  const Vec3 aim_axis = aim_name == "auto"
                            ? nearest_axis(axes, toward, up_name == "auto" ? nullptr : &named_up)
                            : axis_vector(aim_name);
  const Vec3 up_axis = up_name == "auto" ? nearest_axis(axes, up, &aim_axis) : named_up;
  if (math::dot(aim_axis, up_axis) != 0) {
    b.fail(codes::kSameAxis, "up", "aim and up name the same axis",
           "one axis looks at the targets, another stays turned up");
  }
  return math::transposed(math::frame(aim_axis, up_axis));
}

}  // namespace

void aim_constraint(Builder& b) {
  namespace aim = scene::aim;
  const NodeId driven = driven_node(b);
  const std::vector<Target> targets = constraint_targets(b);
  const std::vector<double> weights = constraint_weights(b, targets.size());
  if (b.failed()) return;
  const NodeId node = b.make({.kind = scene::Kind::aim_constraint,
                              .role = "constraint",
                              .joint = {},
                              .parent = {},
                              .suffix = ""});
  b.connect({driven, scene::transform::kParent}, {node, aim::kParent});
  b.connect({driven, scene::transform::kTranslate}, {node, aim::kPosition});
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const auto element = static_cast<std::int32_t>(i);
    b.set({node, aim::kTargets, element}, targets[i].rest);
    b.set({node, aim::kWeights, element}, weights[i]);
    b.connect(targets[i].world, {node, aim::kTargets, element});
  }
  connect_weights(b, node, aim::kWeights, weights);
  const Vec3 up = connect_up(b, node, driven);
  const Mat3 axes = math::orthonormal(rest(b, driven).linear);
  const Vec3 toward = math::normalised(mean_position(targets, weights) - position(b, driven),
                                       b.character().forward);
  const Mat3 offset = b.with().flag("maintain") ? math::transposed(math::frame(toward, up)) * axes
                                                : named_axes(b, axes, toward, up);
  if (b.failed()) return;
  b.set({node, aim::kOffset}, math::quaternion(offset));
  const std::string& which = b.with().text("axes");
  if (which == "xyz")
    return b.connect({node, aim::kRotation}, {driven, scene::transform::kRotation});
  connect_axes(b, {node, aim::kRotate}, {driven, scene::transform::kRotate}, which);
}

}  // namespace rigc::modules
