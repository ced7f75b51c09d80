// SPDX-License-Identifier: MIT
// Proxy meshes (scene kind mesh) as skinned meshes, each piece bound rigidly to its joint.
// Test: tests/gltf/proxy_mesh_test.cpp
#pragma once

#include <optional>
#include <vector>

#include "gltf/patch.h"
#include "gltf/proxy_shapes.h"
#include "scene/scene.h"

namespace rigc::gltf {

/// Numbers of a part in scene::mesh::kParts.
inline constexpr std::size_t kPartWidth = 15;

/// Pieces that one skin can hold: glTF wants the joints of a skin to share a root.
struct ProxyGroup {
  scene::NodeId mesh;
  std::vector<scene::NodeId> joints;  ///< one for each part
  std::vector<ProxyPart> parts;
};

/// Pieces of all mesh nodes of a scene, by mesh node and root. `roots`: by scene node, whatever
/// names the tree that it lies in in the file; -1 for nodes that have no place there.
std::vector<ProxyGroup> proxy_groups(const scene::Scene& scene, const std::vector<int>& roots);

/// Appends mesh, materials and skin of a group. `nodes`: glTF node of each scene node. Gives the
/// text of the node to append as a root of the scene, which `extras` (JSON, may be empty) becomes
/// part of; empty where a number is too large for glTF.
std::optional<std::string> write_proxy(Patch& patch, const scene::Scene& scene,
                                       const std::vector<int>& nodes, const ProxyGroup& group,
                                       const std::string& extras);

}  // namespace rigc::gltf
