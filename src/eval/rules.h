// SPDX-License-Identifier: MIT
// How each kind of node becomes instructions: what it reads, what is emitted, where its outputs
// then lie. A new kind is one row of the table in rules.cpp. Test: tests/eval/compile_test.cpp
#pragma once

#include <optional>
#include <vector>

#include "base/diagnostics.h"
#include "eval/emitter.h"
#include "scene/scene.h"

namespace rigc::eval {

/// Where an output attribute lies in what a node's instructions computed.
struct OutputPlace {
  std::uint32_t offset = 0;
  std::uint32_t width = 0;
  bool euler = false;  ///< the angles of the rotation that lies there
};

struct KindRule {
  scene::Kind kind;
  /// The plugs that the instructions read, in the order in which `emit` takes them. Null: the kind
  /// computes nothing here (transforms are compiled by compile.cpp itself, which asks limits.h;
  /// meshes, layers and sets are data).
  std::vector<scene::Plug> (*reads)(const scene::Scene&, scene::NodeId);
  /// Nothing where the node's data are wrong, which is then reported.
  std::optional<Operand> (*emit)(Emitter&, const scene::Scene&, scene::NodeId,
                                 const std::vector<Operand>& arguments, Diagnostics&);
  OutputPlace (*place)(const scene::Plug& output);
};

const KindRule& rule(scene::Kind kind);

/// "lower_arm", of command ik_fk_limb on joint arm_l, for messages.
std::string describe_node(const scene::Scene& scene, scene::NodeId node);

}  // namespace rigc::eval
