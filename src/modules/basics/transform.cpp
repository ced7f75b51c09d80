// SPDX-License-Identifier: MIT
// transform: a plain transform, a space to hang under, follow or measure from.
// Test: tests/modules/basics_test.cpp
#include "modules/registry.h"
#include "modules/steps.h"

namespace rigc::modules {

void transform(Builder& b) {
  const Parameters& with = b.with();
  const NodeId node = b.make({.kind = scene::Kind::transform,
                              .role = "transform",
                              .joint = {},
                              .parent = {},
                              .suffix = ""});
  const std::string& orient = with.text("orient");
  math::Affine frame = oriented(b, b.joint(), orient);
  frame.origin =
      frame.origin + frame.linear * own_offset(b, b.joint(), orient, with.vec3("offset"));
  NodeId space = space_from(b, "parent", root_control(b));
  space = space_from(b, "follow", space);
  if (!b.failed()) hang(b, node, space, frame);
}

}  // namespace rigc::modules
