// SPDX-License-Identifier: MIT
// parent: hangs a node that a command made under another node.
// Test: tests/modules/basics_test.cpp
#include <fmt/format.h>

#include "modules/codes.h"
#include "modules/registry.h"
#include "modules/steps.h"

namespace rigc::modules {

void parent(Builder& b) {
  const NodeId node = b.with().node("node");
  const NodeId to = b.with().node("to");
  if (!check_place(b, node, "node") || !check_place(b, to, "to")) return;
  if (b.scene()[node].is_skeleton()) {
    b.fail(codes::kNotMadeByCommand, "node",
           traversal::describe(b.scene(), node) + " is a joint of the skeleton",
           "let a parent_constraint move it instead");
    return;
  }
  for (NodeId at = to; at.valid(); at = b.scene()[at].parent) {
    if (at != node) continue;
    b.fail(codes::kUnderItself, "to",
           fmt::format("{} would hang under itself", traversal::describe(b.scene(), node)));
    return;
  }
  const math::Affine world = rest(b, node);
  b.reparent(node, to);
  math::Trs local;
  if (b.with().flag("maintain")) local = math::decompose(math::inverse(rest(b, to)) * world);
  b.set({node, scene::transform::kTranslate}, local.translation);
  b.set({node, scene::transform::kRotation}, local.rotation);
  b.set({node, scene::transform::kScale}, local.scale);
}

}  // namespace rigc::modules
