// SPDX-License-Identifier: MIT
// The IK of a chain of any number of joints or transforms: shared by ik_handle and chain.
// Test: tests/modules/ik_test.cpp
#pragma once

#include <vector>

#include "modules/steps.h"

namespace rigc::modules {

struct ChainIk {
  std::vector<NodeId> nodes;  ///< first to last, each under the one before it; free to turn
  NodeId joint;               ///< that the solver belongs to
  NodeId goal;                ///< what the last one is brought to, with the offset at rest
  NodeId pole;                ///< toward which it bends; invalid: it keeps its bend
  double twist = 0;           ///< degrees
  double iterations = 20;
};

/// The solver, which turns all nodes but the last.
NodeId make_chain_ik(Builder& b, const ChainIk& spec);

}  // namespace rigc::modules
