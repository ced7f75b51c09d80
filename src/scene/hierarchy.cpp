// SPDX-License-Identifier: MIT
// Walks up from a node. Test: tests/scene/hierarchy_test.cpp
#include "scene/hierarchy.h"

namespace rigc::scene {

NodeId transform_above(const Scene& scene, NodeId node) {
  NodeId at = scene[node].parent;
  while (at.valid() && !spec(scene[at].kind).is_transform) at = scene[at].parent;
  return at;
}

bool is_bone(const Scene& scene, NodeId node) {
  for (NodeId at = node; at.valid(); at = scene[at].parent) {
    if (scene[at].kind != Kind::joint) return false;
    if (scene[at].is_skeleton()) return true;
  }
  return false;
}

}  // namespace rigc::scene
