// SPDX-License-Identifier: MIT
// Shared steps, first part: frames from positions and the character, never from joint axes.
// Test: tests/modules/steps_test.cpp
#include <algorithm>

#include "modules/steps.h"

namespace rigc::modules {
namespace {

using math::Mat3;
using math::Vec3;
using scene::Kind;

/// Bones nearer to forward than this (cosine) take up as their second direction.
constexpr double kForwardBone = 0.8;
/// Shortest bone that has a direction, in heights of the character.
constexpr double kShortest = 1e-6;
/// Joints nearer to the middle than this, in heights of the character, are on no side.
constexpr double kMiddle = 0.01;

std::vector<NodeId> skeleton_children(const Builder& b, NodeId joint) {
  std::vector<NodeId> children;
  for (NodeId child : b.scene()[joint].children) {
    if (b.scene()[child].is_skeleton()) children.push_back(child);
  }
  return children;
}

/// Where the bone of a joint ends; nothing for a leaf.
std::optional<Vec3> bone_end(const Builder& b, NodeId joint) {
  const std::vector<NodeId> children = skeleton_children(b, joint);
  if (children.empty()) return std::nullopt;
  const std::string& local = b.scene()[joint].ids.local;
  for (NodeId child : children) {
    if (!local.empty() && b.scene()[child].ids.local == local) return position(b, child);
  }
  Vec3 sum;
  for (NodeId child : children) sum = sum + position(b, child);
  return sum * (1.0 / static_cast<double>(children.size()));
}

std::optional<Vec3> bone_vector(const Builder& b, NodeId joint) {
  const double shortest = kShortest * b.character().height;
  if (const auto end = bone_end(b, joint)) {
    const Vec3 bone = *end - position(b, joint);
    if (math::length(bone) > shortest) return bone;
  }
  const NodeId parent = b.scene()[joint].parent;
  if (parent.valid()) {
    const Vec3 bone = position(b, joint) - position(b, parent);
    if (math::length(bone) > shortest) return bone;
  }
  return std::nullopt;
}

}  // namespace

math::Affine rest(const Builder& b, NodeId node) { return b.scene().rest_world(node); }
Vec3 position(const Builder& b, NodeId node) { return rest(b, node).origin; }

Mat3 character_axes(const Builder& b) {
  const tags::Character& c = b.character();
  return {math::cross(c.up, c.forward), c.up, c.forward};
}

Vec3 character_direction(const Builder& b, const std::string& name) {
  const tags::Character& c = b.character();
  if (name == "forward") return c.forward;
  if (name == "backward") return -c.forward;
  if (name == "left") return c.left;
  if (name == "right") return -c.left;
  return name == "down" ? -c.up : c.up;
}

Vec3 bone_direction(const Builder& b, NodeId joint) {
  const auto bone = bone_vector(b, joint);
  return bone ? math::normalised(*bone) : b.character().up;
}

double bone_length(const Builder& b, NodeId joint) {
  const auto bone = bone_vector(b, joint);
  return std::max(bone ? math::length(*bone) : 0.0, 0.01 * b.character().height);
}

Vec3 chain_direction(const Builder& b, const std::vector<NodeId>& chain, std::size_t n) {
  const NodeId joint = chain[n];
  const bool last = n + 1 == chain.size();
  if (last && (n == 0 || !skeleton_children(b, joint).empty())) return bone_direction(b, joint);
  const Vec3 bone = last ? position(b, joint) - position(b, chain[n - 1])
                         : position(b, chain[n + 1]) - position(b, joint);
  const bool found = math::length(bone) > kShortest * b.character().height;
  return found ? math::normalised(bone) : bone_direction(b, joint);
}

bool is_mirrored(const Builder& b, NodeId joint) {
  const tags::TaggedJoint* tagged = b.tagged(joint);
  return tagged && tagged->mirror.mirrored;
}

int side_of(const Builder& b, NodeId joint) {
  const double side = math::dot(position(b, joint), b.character().left) - b.side_middle();
  const double middle = kMiddle * b.character().height;
  return side > middle ? 1 : side < -middle ? -1 : 0;
}

Mat3 bone_frame(const Builder& b, NodeId joint, Vec3 direction) {
  const tags::Character& c = b.character();
  const bool forward_bone = std::abs(math::dot(direction, c.forward)) > kForwardBone;
  const Vec3 second = forward_bone ? c.up : c.forward;
  const double sign = is_mirrored(b, joint) ? -1.0 : 1.0;
  return math::frame(direction * sign, second * sign);
}

Vec3 own_offset(const Builder& b, NodeId joint, const std::string& orient, Vec3 offset) {
  if (!is_mirrored(b, joint) || axes_from(orient) == AxesFrom::character) return offset;
  return {offset.x, -offset.y, -offset.z};
}

AxesFrom axes_from(const std::string& orient) {
  if (orient == "bone" || orient == "hinge") return AxesFrom::bone;
  return orient == "joint" ? AxesFrom::joint : AxesFrom::character;
}

math::Affine oriented(const Builder& b, NodeId joint, const std::string& orient) {
  return oriented(b, joint, orient, bone_direction(b, joint));
}

math::Affine oriented(const Builder& b, NodeId joint, const std::string& orient, Vec3 direction) {
  const math::Affine at = rest(b, joint);
  if (orient == "joint") return {math::orthonormal(at.linear), at.origin};
  if (orient == "world") return {Mat3{}, at.origin};
  if (orient == "bone") return {bone_frame(b, joint, direction), at.origin};
  return {character_axes(b), at.origin};
}

}  // namespace rigc::modules
