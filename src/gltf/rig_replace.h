// SPDX-License-Identifier: MIT
// The halves of replacing a rig: taking it out but for nodes that the next one keeps, and writing
// the next one into their places. Inside of rig*.cpp. Test: tests/gltf/rig_replace_test.cpp
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "gltf/rig.h"

namespace rigc::gltf {

/// Nodes that the next rig takes over.
struct Kept {
  std::set<int> nodes;   ///< of ours
  std::set<int> joints;  ///< of the model
};

/// strip_rigs() that leaves nodes of ours as they are: their meshes go, and nothing but kept nodes
/// has them as children. Joints of the model keep their marks.
std::set<int> strip_but(Patch& patch, const File& file, const std::vector<const Rig*>& rigs,
                        Strip remains, const Kept& kept);

/// What others added to a node of ours.
struct Additions {
  std::vector<std::pair<std::string, std::string>> members, extras;  ///< name and JSON text
  std::vector<int> children;
};

/// Places of a rig's nodes in its file.
struct NodePlaces {
  std::vector<int> nodes;              ///< by scene node: glTF node to write to, -1: a new one
  std::map<int, Additions> additions;  ///< by glTF node
  std::set<int> own;  ///< glTF nodes of the file that were rigs' own, but for meshes of others
};

/// write_rig() into given places.
bool write_rig(Patch& patch, Rig& rig, int ancestor, const NodePlaces& places,
               Diagnostics& diagnostics);

}  // namespace rigc::gltf
