// SPDX-License-Identifier: MIT
// control: one control at a joint, under a zero; the joint follows it.
// Test: tests/modules/control_test.cpp
#include "modules/registry.h"
#include "modules/steps.h"

namespace rigc::modules {

void control(Builder& b) {
  const Parameters& with = b.with();
  ControlSpec spec;
  spec.joint = b.joint();
  spec.frame = oriented(b, b.joint(), with.text("orient"));
  spec.axes = axes_from(with.text("orient"));
  spec.space = space_from(b, "parent", space_of(b, b.joint()));
  spec.shape = with.text("shape");
  spec.size = with.number("size");
  spec.color = side_color(b, b.joint(), "color");
  face(b, spec, with.text("axis"), bone_direction(b, b.joint()));
  spec.offset = with.vec3("offset");
  spec.translate = with.flag("translate");
  spec.rotate = with.flag("rotate");
  spec.scale = with.flag("scale");
  if (b.failed()) return;
  const ControlNodes made = make_control(b, spec);
  if (b.failed() || !with.flag("drive")) return;
  drive(b, spec, made.control);
}

}  // namespace rigc::modules
