// SPDX-License-Identifier: MIT
// joint: a joint that belongs to the rig, not to the template.
// Test: tests/modules/basics_test.cpp
#include "modules/registry.h"
#include "modules/steps.h"

namespace rigc::modules {

void joint(Builder& b) {
  const Parameters& with = b.with();
  const NodeId parent = with.node("parent");
  const NodeId node = b.make(
      {.kind = scene::Kind::joint, .role = "joint", .joint = {}, .parent = parent, .suffix = ""});
  const std::string& orient = with.text("orient");
  math::Affine frame = oriented(b, parent, orient);
  frame.origin = frame.origin + frame.linear * own_offset(b, parent, orient, with.vec3("offset"));
  const math::Trs local = math::decompose(math::inverse(rest(b, parent)) * frame);
  b.set({node, scene::transform::kTranslate}, local.translation);
  b.set({node, scene::transform::kRotation}, local.rotation);
}

}  // namespace rigc::modules
