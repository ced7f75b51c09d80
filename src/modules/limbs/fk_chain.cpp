// SPDX-License-Identifier: MIT
// fk_chain: a control for each joint of a chain, each under the one before.
// Test: tests/modules/fk_chain_test.cpp
#include "modules/registry.h"
#include "modules/steps.h"

namespace rigc::modules {

void fk_chain(Builder& b) {
  const Parameters& with = b.with();
  const std::vector<NodeId>& joints = with.nodes("joints");
  const std::size_t count = joints.size() - (!with.flag("last") && joints.size() > 1 ? 1 : 0);
  const std::string& orient = with.text("orient");
  ControlSpec spec;
  spec.role = "fk";
  spec.shape = with.text("shape");
  spec.axes = axes_from(orient);
  spec.size = with.number("size");
  spec.translate = with.flag("translate");
  spec.space = space_from(b, "parent", space_of(b, joints.front()));
  if (b.failed() || !check_order(b, joints, "joints")) return;
  for (std::size_t i = 0; i < count; ++i) {
    const math::Vec3 direction = chain_direction(b, joints, i);
    spec.joint = joints[i];
    spec.frame = oriented(b, spec.joint, orient, direction);
    spec.color = side_color(b, spec.joint, "color");
    face(b, spec, with.text("axis"), direction);
    const ControlNodes made = make_control(b, spec);
    if (b.failed()) return;
    drive(b, spec, made.control);
    spec.space = made.control;
  }
}

}  // namespace rigc::modules
