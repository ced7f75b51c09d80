// SPDX-License-Identifier: MIT
// fk_chain: a control for each joint of a chain, each under the one before.
// Test: tests/modules/fk_chain_test.cpp
#include "modules/limbs/two_bone.h"
#include "modules/registry.h"

namespace rigc::modules {
namespace {

/// Axes of the n-th joint's control.
math::Mat3 axes(Builder& b, const std::vector<NodeId>& chain, std::size_t n, math::Vec3 direction) {
  const std::string& orient = b.with().text("orient");
  if (orient != "hinge") return oriented(b, chain[n], orient, direction).linear;
  if (n == 0 || n + 1 == chain.size()) return bone_frame(b, chain[n], direction);
  const TwoBone limb = measure_two_bone(b, chain[n - 1], chain[n], chain[n + 1], "auto");
  return b.failed() ? math::Mat3{} : hinge_frame(b, limb, direction);
}

}  // namespace

void fk_chain(Builder& b) {
  const Parameters& with = b.with();
  const std::vector<NodeId>& joints = with.nodes("joints");
  const std::size_t count = joints.size() - (!with.flag("last") && joints.size() > 1 ? 1 : 0);
  ControlSpec spec;
  spec.role = "fk";
  spec.shape = with.text("shape");
  spec.axes = axes_from(with.text("orient"));
  spec.size = with.number("size");
  spec.translate = with.flag("translate");
  spec.space = space_from(b, "parent", space_of(b, joints.front()));
  if (b.failed() || !check_order(b, joints, "joints")) return;
  for (std::size_t i = 0; i < count; ++i) {
    const math::Vec3 direction = chain_direction(b, joints, i);
    spec.joint = joints[i];
    spec.frame = {axes(b, joints, i, direction), position(b, spec.joint)};
    if (b.failed()) return;
    spec.color = side_color(b, spec.joint, "color");
    face(b, spec, with.text("axis"), direction);
    const ControlNodes made = make_control(b, spec);
    if (b.failed()) return;
    drive(b, spec, made.control);
    spec.space = made.control;
  }
}

}  // namespace rigc::modules
