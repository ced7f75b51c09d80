// SPDX-License-Identifier: MIT
// Shared steps, third part: controls under zeros, hanging, driving.
// Test: tests/modules/steps_test.cpp
#include "modules/steps.h"

#include <fmt/format.h>

#include <cmath>

#include "base/text.h"
#include "modules/codes.h"
#include "modules/shapes.h"

namespace rigc::modules {
namespace {

using math::Affine;
using math::Vec3;
using scene::Kind;
namespace transform = scene::transform;
namespace constraint = scene::constraint;

/// Cosine above which two axes count as one.
constexpr double kAligned = 0.999;
constexpr Vec3 kLeftColor{0.16, 0.42, 0.95};
constexpr Vec3 kRightColor{0.93, 0.16, 0.18};
constexpr Vec3 kMiddleColor{0.98, 0.82, 0.13};

/// What the control on a mirrored joint shows of a point that the one on the other side shows: its
/// mirror image. The same function leads back.
Vec3 mirror_image(const Builder& b, const ControlSpec& spec, Vec3 point) {
  if (!is_mirrored(b, spec.joint)) return point;
  if (spec.axes != AxesFrom::character) return -point;
  const Vec3 left = math::transposed(spec.frame.linear) * b.character().left;
  return point - left * (2 * math::dot(left, point));
}

/// Flattened polylines in control space: the number of points, then their coordinates, repeated.
/// Rounded, because they are written out as text.
std::vector<double> placed(const Builder& b, const ShapeLines& lines, const ControlSpec& spec) {
  const math::Quat turn = math::between({0, 1, 0}, math::normalised(spec.facing, {0, 1, 0}));
  Vec3 offset = spec.offset;
  if (is_mirrored(b, spec.joint)) offset.x = -offset.x;  // expansion had turned it round
  const double decimals = shape_decimals(spec.size);
  std::vector<double> out;
  for (const auto& line : lines) {
    out.push_back(static_cast<double>(line.size()));
    for (const Vec3& point : line) {
      const Vec3 p = mirror_image(b, spec, math::rotate(turn, point) * spec.size + offset);
      for (double x : {p.x, p.y, p.z}) out.push_back(std::nearbyint(x * decimals) / decimals);
    }
  }
  return out;
}

/// Signs of scene::control::kMirror: what the character's mirror plane does to the control's axes,
/// seen from the axes of the control on the other side.
std::vector<double> mirror_signs(const Builder& b, const ControlSpec& spec, NodeId opposite) {
  if (spec.axes == AxesFrom::bone) return {-1, -1, -1};
  const Vec3 left = b.character().left;
  const math::Mat3 other = spec.axes == AxesFrom::joint
                               ? math::orthonormal(rest(b, opposite).linear)
                               : spec.frame.linear;
  const Vec3 own_axes[3] = {spec.frame.linear.x, spec.frame.linear.y, spec.frame.linear.z};
  const Vec3 other_axes[3] = {other.x, other.y, other.z};
  std::vector<double> signs;
  for (int i = 0; i < 3; ++i) {
    const Vec3 reflected = own_axes[i] - left * (2 * math::dot(left, own_axes[i]));
    const double cosine = math::dot(reflected, other_axes[i]);
    signs.push_back(cosine > kAligned ? 1.0 : cosine < -kAligned ? -1.0 : 0.0);
  }
  return signs;
}

/// Says how values are copied to the control on the other side, and which it is: what the twin of
/// the command makes, or what the command itself has made before.
void set_opposite(Builder& b, NodeId control, const ControlSpec& spec) {
  const tags::TaggedJoint* owner = b.tagged(spec.joint);
  if (!owner || owner->mirror.opposite.uid == 0) return;
  const NodeId joint = b.index().joint(owner->mirror.opposite);
  if (!joint.valid()) return;
  b.set({control, scene::control::kMirror}, mirror_signs(b, spec, joint));
  const Identity own = b.scene()[control].identity;
  Identity other = own;
  other.owner = owner->mirror.opposite;
  const JointKey twin = b.twin();
  if (twin.uid != 0) {
    other.holder = twin;
    b.set({control, scene::control::kOpposite}, to_text(other));
    return;
  }
  for (const NodeId made : b.index().made_for(other.owner)) {
    if (!(b.scene()[made].identity == other)) continue;
    b.set({control, scene::control::kOpposite}, to_text(other));
    b.set({made, scene::control::kOpposite}, to_text(own));
  }
}

void place(Builder& b, NodeId node, NodeId parent, const Affine& frame) {
  const Affine local = parent.valid() ? math::inverse(rest(b, parent)) * frame : frame;
  const math::Trs trs = math::decompose(local);
  b.set({node, transform::kTranslate}, trs.translation);
  b.set({node, transform::kRotation}, trs.rotation);
  b.set({node, transform::kScale}, trs.scale);
}

}  // namespace

Target target(const Builder& b, NodeId node) { return {world_of(node), rest(b, node)}; }

NodeId make_constraint(Builder& b, Kind kind, NodeId driven, const std::vector<Target>& targets,
                       const std::vector<double>& weights, bool maintain, const std::string& role,
                       NodeId owner) {
  const NodeId node =
      b.make({.kind = kind, .role = role, .joint = owner, .parent = {}, .suffix = role});
  const Affine driven_rest = rest(b, driven);
  const NodeId parent = b.scene()[driven].parent;
  const Affine to_parent = parent.valid() ? math::inverse(rest(b, parent)) : Affine{};
  const auto offset_from = [&](const Affine& target) {
    if (kind != Kind::point_constraint) return math::inverse(target) * driven_rest;
    return math::translation(to_parent * driven_rest.origin - to_parent * target.origin);
  };
  b.connect({driven, transform::kParent}, {node, constraint::kParent});
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const auto element = static_cast<std::int32_t>(i);
    b.set({node, constraint::kTargets, element}, targets[i].rest);
    b.set({node, constraint::kWeights, element}, weights.empty() ? 1.0 : weights[i]);
    b.set({node, constraint::kOffsets, element},
          maintain ? offset_from(targets[i].rest) : Affine{});
    b.connect(targets[i].world, {node, constraint::kTargets, element});
  }
  return node;
}

void hang(Builder& b, NodeId node, NodeId space, const Affine& frame) {
  const bool follows = space.valid() && b.scene()[space].kind == Kind::joint;
  const NodeId parent = follows ? root_control(b) : space;
  if (parent.valid()) b.reparent(node, parent);
  place(b, node, parent, frame);
  if (!follows) return;
  const NodeId owner_constraint =
      make_constraint(b, Kind::parent_constraint, node, {target(b, space)}, {}, true, "space");
  b.connect({owner_constraint, constraint::kTranslate}, {node, transform::kTranslate});
  b.connect({owner_constraint, constraint::kRotation}, {node, transform::kRotation});
  b.connect({owner_constraint, constraint::kScale}, {node, transform::kScale});
}

ControlNodes make_control(Builder& b, const ControlSpec& spec) {
  const auto lines = find_shape(b, spec.shape);
  if (!lines) {
    b.fail(codes::kUnknownShape, spec.shape_parameter,
           fmt::format("there is no shape \"{}\"", printable(spec.shape)),
           suggest_shape(b, spec.shape));
    return {};
  }
  const std::string suffix = spec.suffix.empty() ? spec.role : spec.suffix;
  ControlNodes made;
  made.zero = b.make({.kind = Kind::transform,
                      .role = "zero",
                      .joint = spec.joint,
                      .parent = {},
                      .suffix = suffix + "_zero"});
  hang(b, made.zero, spec.space, spec.frame);
  made.control = b.make({.kind = Kind::control,
                         .role = spec.role,
                         .joint = spec.joint,
                         .parent = made.zero,
                         .suffix = suffix == "control" ? "" : suffix});
  namespace control = scene::control;
  b.set({made.control, control::kShape}, spec.shape);
  b.set({made.control, control::kPoints}, placed(b, *lines, spec));
  b.set({made.control, control::kColor}, spec.color);
  b.set(
      {made.control, control::kKeyable},
      static_cast<double>((spec.translate ? 1 : 0) + (spec.rotate ? 2 : 0) + (spec.scale ? 4 : 0)));
  set_opposite(b, made.control, spec);
  return made;
}

void face(const Builder& b, ControlSpec& spec, const std::string& axis, Vec3 bone) {
  spec.facing = axis == "x" ? Vec3{1, 0, 0} : axis == "z" ? Vec3{0, 0, 1} : Vec3{0, 1, 0};
  if (axis == "bone") {
    spec.facing = mirror_image(b, spec, math::transposed(spec.frame.linear) * bone);
  }
}

Vec3 side_color(const Builder& b, NodeId joint, std::string_view parameter) {
  if (b.with().has(parameter)) return b.with().vec3(parameter);
  const int side = side_of(b, joint);
  return side > 0 ? kLeftColor : side < 0 ? kRightColor : kMiddleColor;
}

namespace {

/// Scale comes from the constraint where nothing above the joint is driven.
void connect_scale(Builder& b, NodeId node, NodeId joint) {
  for (NodeId at = b.scene()[joint].parent; at.valid(); at = b.scene()[at].parent) {
    if (is_driven(b.scene(), at)) return;
  }
  b.connect({node, constraint::kScale}, {joint, transform::kScale});
}

NodeId make_driver(Builder& b, NodeId joint, NodeId follows) {
  return make_constraint(b, Kind::parent_constraint, joint, {target(b, follows)}, {}, true,
                         "driver", joint);
}

}  // namespace

void drive(Builder& b, const ControlSpec& spec, NodeId control) {
  const NodeId joint = spec.joint;
  const NodeId node = make_driver(b, joint, control);
  b.connect({node, constraint::kRotation}, {joint, transform::kRotation});
  if (spec.translate || !carried_by(b, joint, spec.space)) {
    b.connect({node, constraint::kTranslate}, {joint, transform::kTranslate});
  }
  connect_scale(b, node, joint);
}

void carry(Builder& b, NodeId joint, NodeId follows) {
  const NodeId node = make_driver(b, joint, follows);
  b.connect({node, constraint::kTranslate}, {joint, transform::kTranslate});
  connect_scale(b, node, joint);
}

}  // namespace rigc::modules
