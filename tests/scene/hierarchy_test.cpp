// SPDX-License-Identifier: MIT
// What counts as above a node, and which joints are bones.
#include "scene/hierarchy.h"

#include <doctest/doctest.h>

#include "scene/edit.h"

namespace rigc {
namespace {

using scene::Kind;
using scene::NodeId;

struct Tree {
  scene::Scene scene;
  scene::Journal journal;
  scene::Edit edit{scene, journal, nullptr};
  NodeId make(Kind kind, NodeId parent, std::uint32_t command) {
    scene::Node node;
    node.kind = kind;
    node.parent = parent;
    node.command = command;
    return edit.make(std::move(node));
  }
};

constexpr std::uint32_t kSkeleton = UINT32_MAX, kCommand = 3;

TEST_CASE("scene hierarchy: the nearest transform above") {
  Tree tree;
  const NodeId root = tree.make(Kind::transform, {}, kCommand);
  const NodeId solver = tree.make(Kind::ik_two_bone, root, kCommand);
  const NodeId below = tree.make(Kind::control, solver, kCommand);
  CHECK(!transform_above(tree.scene, root).valid());
  CHECK(transform_above(tree.scene, solver) == root);
  CHECK(transform_above(tree.scene, below) == root);
}

TEST_CASE("scene hierarchy: bones are the skeleton's joints and those hung under them") {
  Tree tree;
  const NodeId bone = tree.make(Kind::joint, {}, kSkeleton);
  const NodeId twist = tree.make(Kind::joint, bone, kCommand);
  const NodeId control = tree.make(Kind::control, bone, kCommand);
  const NodeId helper = tree.make(Kind::joint, control, kCommand);
  const NodeId alone = tree.make(Kind::joint, {}, kCommand);
  CHECK(is_bone(tree.scene, bone));
  CHECK(is_bone(tree.scene, twist));
  CHECK(!is_bone(tree.scene, control));
  CHECK(!is_bone(tree.scene, helper));
  CHECK(!is_bone(tree.scene, alone));
}

}  // namespace
}  // namespace rigc
