// SPDX-License-Identifier: MIT
// What one command made, from the index of its module. Test: tests/modules/limb_stretch_test.cpp
#include "modules/made.h"

#include <algorithm>

namespace rigc::modules {

Made::Made(const Builder& b, NodeId any) : b_(b) {
  const scene::Node& named = b.scene()[any];
  if (named.is_skeleton()) return;
  for (NodeId node : b.index().made_by(b.global(), named.module)) {
    if (b.scene()[node].command == named.command) nodes_.push_back(node);
  }
}

std::string_view Made::module() const {
  return empty() ? std::string_view{} : std::string_view(b_.scene()[nodes_.front()].module);
}

std::vector<NodeId> Made::with_role(std::string_view role) const {
  std::vector<NodeId> found;
  std::copy_if(nodes_.begin(), nodes_.end(), std::back_inserter(found),
               [&](NodeId node) { return b_.scene()[node].identity.role == role; });
  return found;
}

bool Made::is_of(NodeId node, NodeId joint) const {
  return !joint.valid() || owner(b_, node) == joint;
}

NodeId Made::first(std::string_view role, NodeId joint) const {
  for (NodeId node : nodes_) {
    if (b_.scene()[node].identity.role == role && is_of(node, joint)) return node;
  }
  return {};
}

NodeId Made::first(scene::Kind kind, NodeId joint) const {
  for (NodeId node : nodes_) {
    if (b_.scene()[node].kind == kind && is_of(node, joint)) return node;
  }
  return {};
}

NodeId Made::first(scene::Kind kind, std::string_view role, NodeId joint) const {
  for (NodeId node : nodes_) {
    const scene::Node& made = b_.scene()[node];
    if (made.kind == kind && made.identity.role == role && is_of(node, joint)) return node;
  }
  return {};
}

NodeId owner(const Builder& b, NodeId node) {
  return b.index().joint(b.scene()[node].identity.owner);
}

}  // namespace rigc::modules
