// SPDX-License-Identifier: MIT
// fk_chain: a control for each joint of a chain, each under the one before.
// Test: tests/modules/fk_chain_test.cpp
#include "modules/registry.h"
#include "modules/steps.h"

namespace rigc::modules {

void fk_chain(Builder& b) {
  const Parameters& with = b.with();
  std::vector<NodeId> joints = with.nodes("joints");
  if (!with.flag("last") && joints.size() > 1) joints.pop_back();
  const std::string& orient = with.text("orient");
  ControlSpec spec;
  spec.role = "fk";
  spec.shape = with.text("shape");
  spec.axes = axes_from(orient);
  spec.size = with.number("size");
  spec.translate = with.flag("translate");
  spec.space = space_from(b, "parent", space_of(b, joints.front()));
  if (b.failed() || !check_descends(b, joints, "joints")) return;
  for (NodeId joint : joints) {
    spec.joint = joint;
    spec.frame = oriented(b, joint, orient);
    spec.color = side_color(b, joint, "color");
    face(b, spec, with.text("axis"), bone_direction(b, joint));
    const ControlNodes made = make_control(b, spec);
    if (b.failed()) return;
    drive(b, joint, target(b, made.control), spec.translate);
    spec.space = made.control;
  }
}

}  // namespace rigc::modules
