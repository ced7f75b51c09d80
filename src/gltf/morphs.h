// SPDX-License-Identifier: MIT
// Morph targets of a file's meshes: their names, their weights, and the channels on these.
// Test: tests/pipeline/morphs_test.cpp
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "anim/clip.h"
#include "gltf/file.h"
#include "gltf/slim.h"

namespace rigc::gltf {

/// A node with a mesh that has morph targets.
struct MorphedNode {
  int node = -1;
  std::vector<std::string> targets;  ///< [targets]: `extras.targetNames` of the mesh; "" without
  std::vector<float> weights;        ///< [targets]: as the file stands
};

/// Nodes of the file whose mesh has morph targets and which some of `joints` move: one of them is
/// in their skin, or they hang at or below one.
std::vector<MorphedNode> find_morphed(const File& file, const Slim& slim,
                                      const std::set<int>& joints);

/// The keys that an animation of the file (-1: none) has on the weights of a node, which has
/// `count` targets; without keys a curve without times. Empty where they are damaged (reported).
/// `slim` was read with animations.
std::optional<anim::Curve> read_weights_curve(const File& file, const Slim& slim, int animation,
                                              int node, std::size_t count,
                                              Diagnostics& diagnostics);

}  // namespace rigc::gltf
