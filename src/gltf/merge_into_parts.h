// SPDX-License-Identifier: MIT
// What joining one rig to another needs: both as they are in the patch, where they stand in the
// file, and their texts made one. Inside of merge_into*.cpp. Test:
// tests/pipeline/merge_into_test.cpp
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "gltf/merge_into.h"
#include "gltf/rig.h"

namespace rigc::gltf {

/// A rig of RIGC_rig as it is in the patch.
struct PatchRig {
  json::Value item;
  Rig rig;  ///< with what RIGC_rig says, not with what stands in the nodes
};

struct PatchRigs {
  std::unique_ptr<json::Document> text;
  std::vector<PatchRig> rigs;
};
std::optional<PatchRigs> read_patch_rigs(const Patch& patch, const std::string& path,
                                         Diagnostics& diagnostics);

/// Nodes as they are in the patch.
struct PatchNodes {
  explicit PatchNodes(const Patch& patch);
  math::Affine world(int node) const;  ///< identity for -1
  /// The node that stands for a scene node: the one that says so, else the recorded one. -1: none.
  int node_of(const Rig& rig, scene::NodeId id) const;
  /// Node that the rig's roots are under, -1: the scene.
  int ancestor(const Rig& rig) const;

  std::vector<int> parents;
  std::vector<math::Affine> locals;
  std::map<Identity, int> marked;
};

/// A rig that joins another, and what of it hangs under what.
struct Joining {
  const PatchRig& into;
  const PatchRig& from;
  std::map<int, int> roots;  ///< root joint of `from` to joint of `into`
  math::Affine space;        ///< from the space of `from` to that of `into`
};

/// Places of what had no parent, relative to what it hangs under then.
struct Moved {
  std::map<int, math::Trs> joints;                           ///< by joint of `from`
  std::map<scene::NodeId, std::pair<int, math::Trs>> nodes;  ///< by scene node; joint of `into`
};
Moved move_roots(const Joining& joining);

/// Scene node of a joint of the skeleton; invalid where there is none.
scene::NodeId joint_node(const Rig& rig, const JointKey& key);

/// Reports what the two have both and cannot have both.
bool check_distinct(const Joining& joining, const std::string& path, Diagnostics& diagnostics);

/// The text of `into` with `from` in it.
std::string joined_text(const Joining& joining, const Moved& moved);

}  // namespace rigc::gltf
