// SPDX-License-Identifier: MIT
// What one command made, by role and kind: for commands that put something into what an earlier
// command built. Test: tests/modules/limb_stretch_test.cpp
#pragma once

#include <string_view>
#include <vector>

#include "modules/builder.h"

namespace rigc::modules {

class Made {
 public:
  /// What the command made that made `any`; nothing where that is a joint of the skeleton.
  Made(const Builder& b, NodeId any);

  bool empty() const { return nodes_.empty(); }
  std::string_view module() const;
  /// In the order made.
  std::vector<NodeId> with_role(std::string_view role) const;
  /// The first with a role, of a joint where one is given; invalid if there is none.
  NodeId first(std::string_view role, NodeId joint = {}) const;
  /// The first of a kind, of a joint where one is given; invalid if there is none.
  NodeId first(scene::Kind kind, NodeId joint = {}) const;
  /// The first with both.
  NodeId first(scene::Kind kind, std::string_view role, NodeId joint = {}) const;

 private:
  bool is_of(NodeId node, NodeId joint) const;
  const Builder& b_;
  std::vector<NodeId> nodes_;
};

/// The skeleton joint that a node belongs to.
NodeId owner(const Builder& b, NodeId node);

}  // namespace rigc::modules
