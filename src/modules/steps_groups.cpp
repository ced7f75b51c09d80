// SPDX-License-Identifier: MIT
// Named nodes that several commands add members to.
// Test: tests/modules/control_set_test.cpp
#include "modules/steps_groups.h"

#include <fmt/format.h>

#include <set>

#include "base/text.h"
#include "modules/codes.h"
#include "modules/steps.h"

namespace rigc::modules {

std::optional<std::vector<NodeId>> group_members(const Builder& b) {
  if (b.with().found_nothing("nodes") && !b.with().has("nodes")) return std::nullopt;
  std::vector<NodeId> members;
  std::set<NodeId> seen;
  if (b.with().has("nodes")) {
    for (NodeId node : b.with().nodes("nodes")) {
      if (seen.insert(node).second) members.push_back(node);
    }
    return members;
  }
  const scene::Node& joint = b.scene()[b.joint()];
  const auto& group = joint.ids.local.empty() ? b.index().made_for(joint.identity.owner)
                                              : b.index().group(b.global(), joint.ids.local);
  for (NodeId node : group) {
    if (b.scene()[node].kind == scene::Kind::control) members.push_back(node);
  }
  return members;
}

bool check_group_name(Builder& b, std::string_view parameter) {
  const std::string& name = b.with().text(parameter);
  if (is_name(name) && name != "rigc") return true;
  b.fail(codes::kGroupName, parameter, fmt::format("\"{}\" is no name", printable(name)),
         "letters, digits, _ and -, not starting with a digit; `rigc` is reserved");
  return false;
}

NodeId find_group(const Builder& b, scene::Kind kind, std::uint16_t attribute,
                  const std::string& name) {
  for (NodeId id{0}; id.index < b.scene().size(); ++id.index) {
    if (b.scene()[id].kind == kind &&
        std::get<std::string>(b.scene().value({id, attribute})) == name)
      return id;
  }
  return {};
}

std::vector<NodeId> members_of(const scene::Scene& scene, NodeId group, std::uint16_t attribute) {
  std::vector<NodeId> members;
  for (const scene::Connection& connection : scene[group].inputs) {
    if (connection.to.attribute == attribute) members.push_back(connection.from.node);
  }
  return members;
}

std::vector<NodeId> add_members(Builder& b, NodeId group, std::uint16_t attribute,
                                const std::vector<NodeId>& nodes) {
  const std::vector<NodeId> before = members_of(b.scene(), group, attribute);
  std::set<NodeId> inside(before.begin(), before.end());
  auto element = static_cast<std::int32_t>(before.size());
  std::vector<NodeId> added;
  for (NodeId node : nodes) {
    if (!inside.insert(node).second) continue;
    b.connect(world_of(node), {group, attribute, element++});
    added.push_back(node);
  }
  return added;
}

}  // namespace rigc::modules
