// SPDX-License-Identifier: MIT
// look_at: eyes turn toward a common target, each with an aim control of its own; lids go along.
// Test: tests/modules/look_at_test.cpp
#include <algorithm>

#include "modules/layers.h"
#include "modules/made.h"
#include "modules/registry.h"

namespace rigc::modules {
namespace {

/// Turns an eye so that what pointed at its aim at rest keeps pointing at it. `head`: what the eye
/// moves with; invalid: nothing.
void aim_eye(Builder& b, NodeId eye, NodeId aim, NodeId head) {
  namespace attribute = scene::aim;
  const NodeId node = b.make({.kind = scene::Kind::aim_constraint,
                              .role = "driver",
                              .joint = eye,
                              .parent = {},
                              .suffix = "driver"});
  const math::Vec3 up = b.character().up;
  const math::Vec3 direction = math::normalised(position(b, aim) - position(b, eye));
  const math::Mat3 frame = math::frame(direction, up);
  const math::Mat3 eye_axes = math::orthonormal(rest(b, eye).linear);
  b.connect({eye, scene::transform::kParent}, {node, attribute::kParent});
  b.connect({eye, scene::transform::kTranslate}, {node, attribute::kPosition});
  b.set({node, attribute::kWeights, 0}, 1.0);
  follow_world(b, {node, attribute::kTargets, 0}, aim);
  // Up turns with the head, so that a rolled head keeps its gaze upright in the head.
  if (head.valid()) {
    b.set({node, attribute::kUpMode}, 2.0);
    b.set({node, attribute::kUpVector},
          math::transposed(math::orthonormal(rest(b, head).linear)) * up);
    b.connect(world_of(head), {node, attribute::kUpTarget});
  } else {
    b.set({node, attribute::kUpVector}, up);
  }
  b.set({node, attribute::kOffset}, math::quaternion(math::transposed(frame) * eye_axes));
  b.connect({node, attribute::kRotation}, {eye, scene::transform::kRotation});
}

/// Where `converge` of the target is 1 the aim lies in the target itself: the eyes cross there.
void converge(Builder& b, const Plug& amount, NodeId target, const ControlNodes& aim) {
  const math::Vec3 to_target = math::inverse(rest(b, aim.zero)) * position(b, target);
  const Computed moved = compute(b, owner(b, aim.control), "converge",
                                 {{"target", scene::Value(to_target)}, {"amount", amount}},
                                 "out move = target * amount;");
  b.connect(moved["move"], {make_layer(b, aim.control, "converge"), scene::transform::kTranslate});
}

/// How much of the eye's turn up or down the lids take.
constexpr double kUpperLid = 0.8, kLowerLid = 0.35;

struct Eye {
  NodeId joint;
  NodeId head;  ///< what it moves with; invalid: nothing
};

/// Lets a lid turn about the eye's middle by a part of what the eye does: sideways a third of what
/// it does up and down. Its control, which bulges up or down, adds to it.
void follow_eye(Builder& b, NodeId lid, const Eye& eye, const Plug& amount, bool upper) {
  const math::Mat3 axes = character_axes(b);
  ControlSpec spec;
  spec.joint = lid;
  spec.role = "fk";
  spec.frame = {axes, position(b, eye.joint)};
  spec.space = eye.head;
  spec.shape = b.with().text("lid_shape");
  spec.shape_parameter = "lid_shape";
  spec.size = b.with().number("eye_size");
  spec.color = side_color(b, lid, "eye_color");
  spec.facing = {0, 0, upper ? -1.0 : 1.0};
  spec.offset =
      math::transposed(axes) * (position(b, lid) - spec.frame.origin) + math::Vec3{0, 0, spec.size};
  if (is_mirrored(b, lid)) spec.offset.x = -spec.offset.x;
  spec.translate = false;
  const ControlNodes made = make_control(b, spec);
  if (b.failed()) return;
  spec.translate = true;  // the joint goes round the eye, wherever it lies in the lid
  drive(b, spec, made.control);
  const math::Quat in_zero =
      math::quaternion(math::transposed(axes) * math::orthonormal(rest(b, eye.joint).linear));
  const Computed turned = compute(
      b, lid, "lid",
      {{"zero", made.zero},
       {"eye", eye.joint},
       {"eye_rest", scene::Value(in_zero)},
       {"amount", amount},
       {"part", scene::Value(upper ? kUpperLid : kLowerLid)}},
      "gaze = inverse(rotation(zero)) * rotation(eye) * inverse(eye_rest) * vector(0, 0, 1);"
      "up = asin(clamp(gaze.y, -1, 1)); side = asin(clamp(gaze.x, -1, 1)); by = amount * part;"
      "out turn = axis_angle(vector(0, 1, 0), side * by / 3)"
      " * axis_angle(vector(1, 0, 0), -up * by);");
  b.connect(turned["turn"], {make_layer(b, made.control, "lid"), scene::transform::kRotation});
}

/// The eye that a lid lies nearest to.
const Eye& eye_of(const Builder& b, const std::vector<Eye>& eyes, NodeId lid) {
  return *std::min_element(eyes.begin(), eyes.end(), [&](const Eye& one, const Eye& other) {
    return math::length(position(b, one.joint) - position(b, lid)) <
           math::length(position(b, other.joint) - position(b, lid));
  });
}

void make_lids(Builder& b, const std::vector<Eye>& eyes, NodeId target) {
  const Parameters& with = b.with();
  if (with.nodes("upper_lids").empty() && with.nodes("lower_lids").empty()) return;
  const Plug amount =
      add_number(b, target, {.name = "lids", .value = with.number("lids"), .min = 0, .max = 1});
  for (const char* lids : {"upper_lids", "lower_lids"})
    for (const NodeId lid : with.nodes(lids)) {
      follow_eye(b, lid, eye_of(b, eyes, lid), amount, lids[0] == 'u');
      if (b.failed()) return;
    }
}

/// What the common target belongs to: the joint that holds the command, or, where that is one of
/// two sides, the joint that both hang on.
NodeId target_joint(const Builder& b) {
  const tags::TaggedJoint* holder = b.tagged(b.joint());
  if (!holder || holder->mirror.opposite.uid == 0) return b.joint();
  const NodeId above = joint_above(b, b.joint());
  return above.valid() ? above : b.joint();
}

}  // namespace

void look_at(Builder& b) {
  const Parameters& with = b.with();
  const std::vector<NodeId>& eyes = with.nodes("eyes");
  math::Vec3 middle;
  for (NodeId eye : eyes) middle = middle + position(b, eye);
  middle = middle * (1.0 / static_cast<double>(eyes.size()));
  const math::Vec3 ahead = b.character().forward * with.number("distance");

  ControlSpec spec;
  spec.joint = target_joint(b);
  spec.role = "target";
  spec.frame = {character_axes(b), middle + ahead};
  spec.space = space_from(b, "parent", root_control(b));
  spec.shape = with.text("target_shape");
  spec.shape_parameter = "target_shape";
  spec.size = with.number("target_size");
  spec.color = with.vec3("target_color");
  spec.facing = {0, 0, 1};
  if (b.failed()) return;
  const ControlNodes common = make_control(b, spec);
  if (b.failed()) return;
  const Plug crossing =
      add_number(b, common.control,
                 {.name = "converge", .value = with.number("converge"), .min = 0, .max = 1});
  std::vector<Eye> made;
  for (NodeId eye : eyes) {
    spec.joint = eye;
    spec.role = "aim";
    spec.frame.origin = position(b, eye) + ahead;
    spec.space = common.control;
    spec.shape = with.text("eye_shape");
    spec.shape_parameter = "eye_shape";
    spec.size = with.number("eye_size");
    spec.color = side_color(b, eye, "eye_color");
    spec.rotate = false;
    const ControlNodes own = make_control(b, spec);
    if (b.failed()) return;
    const NodeId space = space_of(b, eye);
    const bool carried = carried_by(b, eye, space);
    if (!carried && space.valid()) carry(b, eye, space);
    converge(b, crossing, common.control, own);
    made.push_back({eye, carried ? b.scene()[eye].parent : space});
    aim_eye(b, eye, own.control, made.back().head);
  }
  make_lids(b, made, common.control);
}

}  // namespace rigc::modules
