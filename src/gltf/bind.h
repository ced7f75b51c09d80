// SPDX-License-Identifier: MIT
// The bind pose of a skeleton from its skins' inverse bind matrices. Test:
// tests/gltf/skeletons_test.cpp
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "gltf/bones.h"
#include "gltf/slim.h"

namespace rigc::gltf {

/// What the skins of a file have in common, found once.
struct BindContext {
  std::vector<int> mesh_nodes;  ///< by skin: the first node that it deforms, -1: none
  std::vector<int> above;       ///< by node: the nearest joint of any skin above it, -1: none
};
BindContext bind_context(const Slim& slim);

/// Bind matrices of joints by node, in the space of the skeleton's ancestor.
///
/// Inverse bind matrices give a pose only up to one map C: joint world = C * inverse(ibm), the same
/// for all joints of a skin. Exporters use the scene's space (C = identity: Blender, glTF 2.0's
/// reading), the skeleton's ancestor, or the mesh node's space (FBX2glTF, COLLADA2GLTF, Babylon). C
/// is the one of the three under which the skin's topmost joints, seen from their parents, differ
/// least from their nodes in scale, place and rotation. An error in the guess is large (a factor of
/// 100, a quarter turn), while a pose in mid-clip changes all three alike; the first wins ties. A
/// quantised mesh has its dequantisation folded into the matrices: then only the rotation is
/// compared, and scale and place are taken from the topmost joint's node. A skin that shares a
/// joint with an earlier one is placed by it.
///
/// Singular matrices are reported. `notes` tells where C is not the identity.
std::optional<std::map<int, math::Affine>> read_bind(const File& file, const Slim& slim,
                                                     const BindContext& context, const Bones& bones,
                                                     std::vector<std::string>& notes,
                                                     Diagnostics& diagnostics);

}  // namespace rigc::gltf
