// SPDX-License-Identifier: MIT
// pivot: a point about which a control turns and scales, which animators move. A layer above the
// control undoes what the turn about the control's own place does to the pivot: T(p) R S T(-p).
// Test: tests/modules/pivot_test.cpp
#include "modules/layers.h"
#include "modules/made.h"
#include "modules/registry.h"

namespace rigc::modules {

void pivot(Builder& b) {
  namespace transform = scene::transform;
  const Parameters& with = b.with();
  const NodeId control = with.node("control");
  const NodeId joint = owner(b, control);
  const NodeId place = b.make({.kind = scene::Kind::transform,
                               .role = "space",
                               .joint = joint,
                               .parent = b.scene()[control].parent,
                               .suffix = "pivot_place"});
  const NodeId layer = make_layer(b, control, "pivot_layer");

  // The pivot goes along where the control is moved, and stays where it is turned.
  b.connect({control, transform::kTranslate}, {place, transform::kTranslate});
  ControlSpec spec;
  spec.joint = joint;
  spec.suffix = "pivot";
  spec.frame = rest(b, control);
  spec.space = place;
  spec.shape = with.text("shape");
  spec.size = with.number("size");
  spec.color = with.vec3("color");
  spec.rotate = false;
  const ControlNodes made = make_control(b, spec);
  if (b.failed()) return;
  const Plug shown = add_to(b, control,
                            {.name = "pivot_visible",
                             .value = with.flag("visible") ? 1.0 : 0.0,
                             .flavour = scene::UserAttribute::Flavour::boolean},
                            "control");
  if (b.failed()) return;
  b.connect(shown, {made.control, transform::kVisible});

  const Computed moved = compute(b, joint, "pivot",
                                 {{"pivot", Plug{made.control, transform::kTranslate}},
                                  {"turn", Plug{control, transform::kRotation}},
                                  {"size", Plug{control, transform::kScale}}},
                                 "out move = pivot - turn * multiply(size, pivot);");
  b.connect(moved["move"], {layer, transform::kTranslate});
}

}  // namespace rigc::modules
