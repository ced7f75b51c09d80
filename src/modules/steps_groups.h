// SPDX-License-Identifier: MIT
// What layers and sets share: named nodes that several commands add members to.
// Test: tests/modules/control_set_test.cpp
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "modules/builder.h"

namespace rigc::modules {

/// The nodes of parameter `nodes`, each once; where it was left out, all controls of this joint's
/// local group. Empty where its selector may find nothing and did.
std::optional<std::vector<NodeId>> group_members(const Builder& b);

/// Whether a text can name a layer, a set, or the switch of a layer; fails where it cannot.
bool check_group_name(Builder& b, std::string_view parameter);

/// The node of a kind whose text attribute holds a name; invalid if the rig has none.
NodeId find_group(const Builder& b, scene::Kind kind, std::uint16_t attribute,
                  const std::string& name);

/// Whose worlds are connected into an array of worlds, in order.
std::vector<NodeId> members_of(const scene::Scene& scene, NodeId group, std::uint16_t attribute);

/// Members that were not in the group yet, now added to its array of worlds.
std::vector<NodeId> add_members(Builder& b, NodeId group, std::uint16_t attribute,
                                const std::vector<NodeId>& nodes);

}  // namespace rigc::modules
