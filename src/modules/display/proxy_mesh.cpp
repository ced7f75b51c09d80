// SPDX-License-Identifier: MIT
// proxy_mesh: capsules and boxes around the bones, rigidly bound.
// Test: tests/modules/proxy_mesh_test.cpp
#include "modules/registry.h"
#include "modules/steps.h"

namespace rigc::modules {
namespace {

constexpr double kDepth = 0.8;       // of a piece's width
constexpr double kLeafLength = 0.6;  // of the parent's bone, for joints without children
constexpr double kThinnest = 0.012;  // in heights of the character
constexpr double kThickest = 0.055;

std::size_t skeleton_children(const Builder& b, NodeId joint) {
  std::size_t count = 0;
  for (NodeId child : b.scene()[joint].children) count += b.scene()[child].is_skeleton() ? 1 : 0;
  return count;
}

/// One row of scene::mesh::kParts, in joint space.
void add_part(const Builder& b, NodeId joint, std::vector<double>& parts) {
  const Parameters& with = b.with();
  const double height = b.character().height;
  const std::size_t children = skeleton_children(b, joint);
  const std::string& style = with.text("style");
  const bool box = style == "box" || (style == "auto" && children != 1);
  const math::Vec3 direction = bone_direction(b, joint);
  const double length = bone_length(b, joint) * (children == 0 ? kLeafLength : 1.0);
  const double width = std::clamp(with.number("thickness") * bone_length(b, joint),
                                  kThinnest * height, kThickest * height);
  const math::Vec3 side = math::frame(direction, b.character().left).y;

  const math::Affine to_joint = math::inverse(rest(b, joint));
  const math::Vec3 head = to_joint * position(b, joint);
  const math::Vec3 tail = to_joint * (position(b, joint) + direction * length);
  const math::Vec3 side_end = to_joint.linear * side;
  const double unit = math::length(side_end);  // joint-space length of a rig unit
  const math::Vec3 side_unit = math::normalised(side_end);
  const math::Vec3 color = with.vec3("color");
  parts.push_back(box ? 1.0 : 0.0);
  for (const math::Vec3& v : {head, tail, side_unit}) parts.insert(parts.end(), {v.x, v.y, v.z});
  parts.insert(parts.end(), {width * unit, width * kDepth * unit, color.x, color.y, color.z});
}

}  // namespace

void proxy_mesh(Builder& b) {
  std::vector<NodeId> joints = b.with().nodes("joints");
  if (joints.empty()) {
    for (NodeId id : b.scene().nodes()) {
      if (!b.scene()[id].is_skeleton()) break;
      joints.push_back(id);
    }
  }
  const NodeId mesh = b.make(
      {.kind = scene::Kind::mesh, .role = "mesh", .joint = {}, .parent = {}, .suffix = "mesh"});
  std::vector<double> parts;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const Plug element{mesh, scene::mesh::kJoints, static_cast<std::int32_t>(i)};
    b.set(element, rest(b, joints[i]));
    b.connect(world_of(joints[i]), element);
    add_part(b, joints[i], parts);
  }
  b.set({mesh, scene::mesh::kParts}, parts);
}

}  // namespace rigc::modules
