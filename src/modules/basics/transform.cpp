// SPDX-License-Identifier: MIT
// transform: a plain transform, a space to hang under, follow or measure from.
// Test: tests/modules/basics_test.cpp
#include "modules/codes.h"
#include "modules/registry.h"
#include "modules/steps.h"

namespace rigc::modules {

void transform(Builder& b) {
  const Parameters& with = b.with();
  const NodeId node = b.make(
      {.kind = scene::Kind::transform, .role = "space", .joint = {}, .parent = {}, .suffix = ""});
  math::Affine frame = oriented(b, b.joint(), with.text("orient"));
  frame.origin = frame.origin + frame.linear * with.vec3("offset");
  NodeId space = with.has("parent") ? with.node("parent") : root_control(b);
  if (with.has("follow")) space = with.node("follow");
  if (space.valid() && !scene::spec(b.scene()[space].kind).is_transform) {
    b.fail(codes::kNotATransform, with.has("follow") ? "follow" : "parent",
           traversal::describe(b.scene(), space) + " has no place in space");
    return;
  }
  hang(b, node, space, frame);
}

}  // namespace rigc::modules
