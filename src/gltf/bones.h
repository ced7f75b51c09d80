// SPDX-License-Identifier: MIT
// Which nodes of a file form a skeleton. Test: tests/gltf/skeletons_test.cpp
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "gltf/slim.h"

namespace rigc::gltf {

/// The nodes of one skeleton, parents first.
struct Bones {
  std::vector<int> nodes;
  std::vector<int> skins;  ///< in the order of their topmost joint
  int ancestor = -1;       ///< lowest common node above all of them; -1: the scene
};

/// For each node the nearest joint above it, -1: none. `is_joint` has an entry for each node.
std::vector<int> joints_above(const Slim& slim, const std::vector<bool>& is_joint);

/// Bones of the VRM humanoid table (VRM 0.x, VRM 1.0, VRM animation) with their nodes.
std::vector<std::pair<std::string, int>> read_humanoid(const File& file);

/// Skins that share joints, or whose joints hang under one another, are one skeleton; the humanoid
/// table counts like a skin. Nodes between joints, nodes below joints that hold no mesh or camera,
/// and nodes between the ancestor and the topmost joints belong to it, to the first that claims
/// them. In the order of the first joint.
std::vector<Bones> find_bones(const Slim& slim,
                              const std::vector<std::pair<std::string, int>>& humanoid);

}  // namespace rigc::gltf
