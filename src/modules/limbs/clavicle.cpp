// SPDX-License-Identifier: MIT
// clavicle: the control that shrugs a shoulder. Test: tests/modules/clavicle_test.cpp
#include "modules/registry.h"
#include "modules/steps.h"

namespace rigc::modules {

void clavicle(Builder& b) {
  const Parameters& with = b.with();
  const NodeId joint = b.joint();
  ControlSpec spec;
  spec.joint = joint;
  spec.frame = oriented(b, joint, "character");
  spec.space = space_from(b, "parent", space_of(b, joint));
  spec.shape = with.text("shape");
  spec.size = with.number("size");
  spec.color = side_color(b, joint, "color");
  spec.translate = with.flag("translate");
  const math::Vec3 bone = with.has("shoulder")
                              ? position(b, with.node("shoulder")) - position(b, joint)
                              : bone_direction(b, joint) * bone_length(b, joint);
  spec.offset = math::transposed(spec.frame.linear) * bone * with.number("along");
  if (b.failed()) return;
  const ControlNodes made = make_control(b, spec);
  if (!b.failed()) drive(b, spec, made.control);
}

}  // namespace rigc::modules
