// SPDX-License-Identifier: MIT
// proxy_mesh: capsules, boxes and cylinders around the bones, rigidly bound.
// Test: tests/modules/proxy_mesh_test.cpp
#include "modules/registry.h"
#include "modules/steps.h"

namespace rigc::modules {
namespace {

constexpr double kDepth = 0.8;       // of a piece's width
constexpr double kLeafLength = 0.6;  // of the parent's bone, for joints without children
constexpr double kThinnest = 0.012;  // in heights of the character
constexpr double kThickest = 0.055;
constexpr double kSideways = 0.7;  // cosine: bones that reach to a side are wide from front to back

std::size_t skeleton_children(const Builder& b, NodeId joint) {
  std::size_t count = 0;
  for (NodeId child : b.scene()[joint].children) count += b.scene()[child].is_skeleton() ? 1 : 0;
  return count;
}

/// A piece at rest, rig space. `side` is the direction of its width, at right angles to it.
struct Piece {
  double style = 0;  ///< as in scene::mesh::kParts
  math::Vec3 head, tail, side;
  double width = 0, depth = 0;
};

Piece measure(const Builder& b, NodeId joint) {
  const Parameters& with = b.with();
  const double height = b.character().height;
  const std::size_t children = skeleton_children(b, joint);
  const std::string& style = with.text("style");
  const std::string& toward = with.text("toward");
  const double bone = bone_length(b, joint);
  const math::Vec3 direction =
      toward == "bone" ? bone_direction(b, joint) : character_direction(b, toward);
  const double length =
      with.has("length") ? with.number("length") : bone * (children == 0 ? kLeafLength : 1.0);
  Piece piece;
  const bool box = style == "box" || (style == "auto" && children != 1);
  piece.style = style == "cylinder" ? 2 : box ? 1 : 0;
  piece.head = position(b, joint);
  piece.tail = piece.head + direction * length;
  const bool sideways = std::abs(math::dot(direction, b.character().left)) > kSideways;
  piece.side = math::frame(direction, sideways ? b.character().forward : b.character().left).y;
  piece.width = with.has("width") ? with.number("width")
                                  : std::clamp(with.number("thickness") * bone, kThinnest * height,
                                               kThickest * height);
  piece.depth = with.has("depth") ? with.number("depth") : kDepth * piece.width;
  return piece;
}

/// One row of scene::mesh::kParts, in joint space.
void add_part(const Builder& b, NodeId joint, std::vector<double>& parts) {
  const Piece piece = measure(b, joint);
  const math::Affine to_joint = math::inverse(rest(b, joint));
  const math::Vec3 side = to_joint.linear * piece.side;
  const double unit = math::length(side);  // joint-space length of a rig unit
  const math::Vec3 color = b.with().vec3("color");
  parts.push_back(piece.style);
  for (const math::Vec3& v :
       {to_joint * piece.head, to_joint * piece.tail, math::normalised(side)}) {
    parts.insert(parts.end(), {v.x, v.y, v.z});
  }
  parts.insert(parts.end(), {piece.width * unit, piece.depth * unit, color.x, color.y, color.z});
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
