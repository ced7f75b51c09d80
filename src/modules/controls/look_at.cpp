// SPDX-License-Identifier: MIT
// look_at: eyes turn toward a common target, each with an aim control of its own.
// Test: tests/modules/look_at_test.cpp
#include "modules/codes.h"
#include "modules/registry.h"
#include "modules/wiring.h"

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

}  // namespace

void look_at(Builder& b) {
  const Parameters& with = b.with();
  const std::vector<NodeId>& eyes = with.nodes("eyes");
  math::Vec3 middle;
  for (NodeId eye : eyes) middle = middle + position(b, eye);
  middle = middle * (1.0 / static_cast<double>(eyes.size()));
  const math::Vec3 ahead = b.character().forward * with.number("distance");

  ControlSpec spec;
  spec.joint = b.joint();
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
    aim_eye(b, eye, own.control, carried ? b.scene()[eye].parent : space);
  }
}

}  // namespace rigc::modules
