// SPDX-License-Identifier: MIT
// The chain solver with everything connected. Test: tests/modules/ik_test.cpp
#include "modules/limbs/chain_ik.h"

#include <cmath>

#include "modules/wiring.h"

namespace rigc::modules {

namespace ik = scene::ik_chain;
namespace transform = scene::transform;

namespace {

/// Where each joint is in the space of the one above it, and how it rests there. The solver knows
/// no scale: places below a scaled joint of the chain are given at the size that they have, as they
/// rest; the others are live.
void connect_joints(Builder& b, const std::vector<NodeId>& chain, NodeId solver) {
  double size = 1;  // of what lies below the joints so far, seen from the chain's base
  bool scaled = false;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const auto element = static_cast<std::int32_t>(i);
    const math::Trs local = b.scene().local(chain[i]);
    b.set({solver, ik::kTranslates, element}, local.translation * size);
    if (!scaled) b.connect({chain[i], transform::kTranslate}, {solver, ik::kTranslates, element});
    b.set({solver, ik::kRests, element}, local.rotation);
    if (i + 1 == chain.size()) break;
    b.connect({solver, ik::kRotations, element}, {chain[i], transform::kRotation});
    scaled = scaled || local.scale != math::Vec3{1, 1, 1};
    size *= math::cbrt(std::abs(local.scale.x * local.scale.y * local.scale.z));
  }
}

}  // namespace

NodeId make_chain_ik(Builder& b, const ChainIk& spec) {
  const NodeId solver = b.make({.kind = scene::Kind::ik_chain,
                                .role = "driver",
                                .joint = spec.joint,
                                .parent = {},
                                .suffix = "ik"});
  b.connect({spec.nodes.front(), transform::kParent}, {solver, ik::kBase});
  follow_world(b, {solver, ik::kGoal}, spec.goal);
  const math::Vec3 end = position(b, spec.nodes.back());
  b.set({solver, ik::kGoalOffset}, math::inverse(rest(b, spec.goal)) * end);
  b.set({solver, ik::kTwist}, spec.twist);
  b.set({solver, ik::kIterations}, spec.iterations);
  if (spec.pole.valid()) {
    b.set({solver, ik::kHasPole}, 1.0);
    follow_world(b, {solver, ik::kPole}, spec.pole);
  }
  connect_joints(b, spec.nodes, solver);
  return solver;
}

}  // namespace rigc::modules
