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
  math::Affine frame = oriented(b, parent, with.text("orient"));
  frame.origin = frame.origin + math::orthonormal(rest(b, parent).linear) * with.vec3("offset");
  const math::Trs local = math::decompose(math::inverse(rest(b, parent)) * frame);
  b.set({node, scene::transform::kTranslate}, local.translation);
  b.set({node, scene::transform::kRotation}, local.rotation);
}

}  // namespace rigc::modules
