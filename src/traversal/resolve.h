// SPDX-License-Identifier: MIT
// Resolves selectors to nodes and plugs at the moment when a command runs.
// Test: tests/traversal/resolve_test.cpp
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "selector/selector.h"
#include "traversal/index.h"

namespace rigc::traversal {

/// From where a selector is resolved.
struct Context {
  const scene::Scene& scene;
  const Index& index;
  std::string global;  ///< of the rig that is being built
  NodeId self;         ///< the joint that holds the command
  /// Says which later command would make what a choice names ("... runs later, biped.yaml:88");
  /// empty text if none.
  std::function<std::string(const selector::Choice&)> forecast;
};

/// What a selector found. `nodes` and `plugs` run in parallel where the selector names an
/// attribute.
struct Found {
  std::vector<NodeId> nodes;
  std::vector<scene::Plug> plugs;
  bool absent_rig = false;  ///< nothing, because the selector names a rig that is not there
                            ///< (reported as a warning)
};

/// The nodes of the first choice that finds any. Without a role, the auxiliary roles zero, driver
/// and space are left out. Finding nothing is an error unless the selector is optional (`?`): then
/// the result is empty. Attributes must exist.
std::optional<Found> resolve(const selector::Selector& selector, const Context& context,
                             Diagnostics& diagnostics);

/// `arm_l.elbow/control.zero (control, "elbow_ctl")`: a node in messages.
std::string describe(const scene::Scene& scene, NodeId node);

}  // namespace rigc::traversal
