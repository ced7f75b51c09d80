// SPDX-License-Identifier: MIT
// The index over a scene: what selectors are answered from. It is told of nodes as they come and
// go, so resolving never scans the scene. Test: tests/traversal/index_test.cpp
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "scene/edit.h"
#include "scene/scene.h"

namespace rigc::traversal {

using scene::NodeId;

class Index final : public scene::Observer {
 public:
  void added(const scene::Scene& scene, NodeId node) override;
  void removing(const scene::Scene& scene, NodeId node) override;

  /// Joints of a local group, of the skeleton alone (START and END stay what they are when a
  /// command makes a joint): parents first, in document order.
  const std::vector<NodeId>& joints(std::string_view global, std::string_view local) const;
  /// Everything of a local group in the order made, skeleton joints first.
  const std::vector<NodeId>& group(std::string_view global, std::string_view local) const;
  /// Skeleton joints and made nodes that carry a label.
  const std::vector<NodeId>& labelled(std::string_view global, std::string_view local,
                                      std::string_view label) const;
  /// Nodes that commands made for a joint, in the order made.
  const std::vector<NodeId>& made_for(const JointKey& owner) const;
  /// Nodes that a module made anywhere in a rig, in the order made.
  const std::vector<NodeId>& made_by(std::string_view global, std::string_view module) const;
  /// The skeleton's joint with this key; invalid if there is none.
  NodeId joint(const JointKey& key) const;
  bool has_global(std::string_view global) const;

  /// Names for "did you mean", sorted.
  std::vector<std::string> groups(std::string_view global) const;
  std::vector<std::string> labels(std::string_view global, std::string_view local) const;

 private:
  using Lists = std::unordered_map<std::string, std::vector<NodeId>>;
  Lists joints_, groups_, labels_, modules_;
  std::map<JointKey, std::vector<NodeId>> made_;
  std::map<JointKey, NodeId> skeleton_;
  std::map<std::string, std::map<std::string, std::map<std::string, int>>>
      names_;  // global, local, label: count
};

}  // namespace rigc::traversal
