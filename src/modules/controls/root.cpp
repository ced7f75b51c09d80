// SPDX-License-Identifier: MIT
// root: world and offset controls that move the whole rig, with a master scale.
// Test: tests/modules/root_test.cpp
#include "modules/codes.h"
#include "modules/registry.h"
#include "modules/wiring.h"

namespace rigc::modules {
namespace {

/// Heights of the ground below this, in heights of the character, count as the floor itself.
constexpr double kFloor = 0.05;

/// On the ground below the joint: the skeleton's lowest point, or the floor of its space where that
/// is near.
math::Affine ground_frame(const Builder& b) {
  const tags::Character& c = b.character();
  double lowest = math::dot(position(b, b.joint()), c.up);
  for (NodeId id : b.scene().nodes()) {
    if (!b.scene()[id].is_skeleton()) break;
    lowest = std::min(lowest, math::dot(position(b, id), c.up));
  }
  if (std::abs(lowest) < kFloor * c.height) lowest = 0;
  const math::Vec3 at = position(b, b.joint());
  return {character_axes(b), at + c.up * (lowest - math::dot(at, c.up))};
}

void add_master_scale(Builder& b, NodeId world) {
  const Plug plug = add_number(b, world, {.name = "master_scale", .value = 1, .min = 0.001});
  for (std::int8_t axis = 0; axis < 3; ++axis) {
    b.connect(plug, {world, scene::transform::kScale, -1, axis});
  }
}

}  // namespace

void root(Builder& b) {
  if (root_control(b).valid()) {
    b.fail(codes::kRootExists, {}, "the rig has a root already", "a part's root can be a control");
    return;
  }
  const Parameters& with = b.with();
  ControlSpec spec;
  spec.joint = b.joint();
  spec.role = "world";
  spec.frame =
      with.text("place") == "joint" ? oriented(b, b.joint(), "character") : ground_frame(b);
  spec.shape = with.text("shape");
  spec.size = with.number("size");
  spec.color = with.vec3("color");
  const ControlNodes world = make_control(b, spec);
  if (b.failed()) return;
  if (with.flag("scale")) add_master_scale(b, world.control);
  spec.role = "offset";
  spec.space = world.control;
  spec.shape = with.text("offset_shape");
  spec.shape_parameter = "offset_shape";
  spec.size = with.number("offset_size");
  spec.color = with.vec3("offset_color");
  const ControlNodes offset = make_control(b, spec);
  if (b.failed() || !with.flag("drive")) return;
  drive(b, spec, offset.control);
}

}  // namespace rigc::modules
