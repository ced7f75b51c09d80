// SPDX-License-Identifier: MIT
// How each kind of node becomes instructions: what it reads, what is emitted, where its outputs
// then lie. A new kind is one row of the table in rules.cpp. Test: tests/eval/compile_test.cpp
#pragma once

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/diagnostics.h"
#include "eval/emitter.h"
#include "scene/formula.h"
#include "scene/scene.h"

namespace rigc::eval {

/// Where an output attribute lies in what a node's instructions computed.
struct OutputPlace {
  std::uint32_t offset = 0;
  std::uint32_t width = 0;
  bool euler = false;  ///< the angles of the rotation that lies there
};

/// The programs of compute nodes that were parsed, by their text: many nodes have the same.
class Programs {
 public:
  /// Null where it is wrong; `emit_of` then parses it again, to say why.
  const scene::Formula* of(const scene::Scene& scene, scene::NodeId node);

 private:
  std::unordered_map<std::uint32_t, const scene::Formula*> by_node_;
  std::unordered_map<std::string, std::optional<scene::Formula>> parsed_;  // by text
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
  /// Instead of these, of a kind whose outputs are computed each for itself, so that one may depend
  /// on what another drives.
  std::vector<scene::Plug> (*reads_of)(const scene::Scene&, const scene::Plug& output) = nullptr;
  /// The same for who asks often.
  std::vector<scene::Plug> (*reads_with)(Programs&, const scene::Scene&,
                                         const scene::Plug& output) = nullptr;
  std::optional<Operand> (*emit_of)(Emitter&, Programs&, const scene::Scene&,
                                    const scene::Plug& output,
                                    const std::vector<Operand>& arguments, Diagnostics&) = nullptr;
};

const KindRule& rule(scene::Kind kind);

/// "lower_arm", of command ik_fk_limb on joint arm_l, for messages.
std::string describe_node(const scene::Scene& scene, scene::NodeId node);

}  // namespace rigc::eval
