// SPDX-License-Identifier: MIT
// ik_handle: a chain of joints whose last joint follows the handle.
// Test: tests/modules/ik_test.cpp
#include <fmt/format.h>

#include <cmath>

#include "modules/codes.h"
#include "modules/limbs/two_bone.h"
#include "modules/registry.h"
#include "modules/wiring.h"

namespace rigc::modules {
namespace {

namespace transform = scene::transform;

/// Without the joints between start and end that no joint of the template stands for: roll and
/// twist joints of the model. Where the template says nothing about any of them all count.
std::vector<NodeId> without_riders(const Builder& b, const std::vector<NodeId>& path) {
  std::vector<NodeId> chain;
  for (NodeId joint : path) {
    const Identifiers& ids = b.scene()[joint].ids;
    const bool tagged = !ids.local.empty() || !ids.label.empty();
    if (tagged || joint == path.front() || joint == path.back()) chain.push_back(joint);
  }
  return chain.size() < 3 ? path : chain;
}

void build_two_bone(Builder& b, const std::vector<NodeId>& path, NodeId handle) {
  const std::vector<NodeId> chain = without_riders(b, path);
  if (chain.size() != 3) {
    b.fail(chain.size() < 3 ? codes::kTooFewJoints : codes::kNotAChain, "end",
           fmt::format("the two_bone solver takes three joints, but {} lie from start to end",
                       chain.size()),
           chain.size() > 3 ? "use solver: chain" : "name a joint further down as `end`");
    return;
  }
  const TwoBone limb = measure_two_bone(b, chain[0], chain[1], chain[2], b.with().text("bend"));
  if (b.failed()) return;
  const NodeId pole = space_from(b, "pole", {});
  if (b.failed()) return;
  const NodeId solver = make_two_bone(b, limb, handle, pole, b.with().number("twist"));
  const std::uint16_t solved[2] = {scene::ik2::kStartWorld, scene::ik2::kMiddleWorld};
  for (std::size_t i = 0; i < 2; ++i) {
    const NodeId turn =
        make_constraint(b, scene::Kind::orient_constraint, chain[i],
                        {{{solver, solved[i]}, rest(b, chain[i])}}, {}, false, "driver", chain[i]);
    b.connect({turn, scene::constraint::kRotation}, {chain[i], transform::kRotation});
  }
}

/// Where each joint is in the space of the one above it, and how it rests there. The solver knows
/// no scale: places below a scaled joint of the chain are given at the size that they have, as they
/// rest; the others are live.
void connect_joints(Builder& b, const std::vector<NodeId>& chain, NodeId solver) {
  namespace ik = scene::ik_chain;
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

/// Every joint on the way takes part, roll joints too: this is the solver for tails and ropes, of
/// which models have more joints than templates name.
void build_chain(Builder& b, const std::vector<NodeId>& chain, NodeId handle) {
  namespace ik = scene::ik_chain;
  if (chain.size() < 2) {
    b.fail(codes::kTooFewJoints, "end", "an IK chain takes at least two joints");
    return;
  }
  const NodeId solver = b.make({.kind = scene::Kind::ik_chain,
                                .role = "driver",
                                .joint = chain[0],
                                .parent = {},
                                .suffix = "ik"});
  b.connect({chain.front(), transform::kParent}, {solver, ik::kBase});
  follow_world(b, {solver, ik::kGoal}, handle);
  b.set({solver, ik::kGoalOffset}, math::inverse(rest(b, handle)) * position(b, chain.back()));
  b.set({solver, ik::kTwist}, b.with().number("twist"));
  b.set({solver, ik::kIterations}, b.with().number("iterations"));
  NodeId pole = space_from(b, "pole", {});
  if (b.failed()) return;
  if (!pole.valid()) pole = straight_chain_pole(b, chain, b.with().text("bend"));
  if (pole.valid()) {
    b.set({solver, ik::kHasPole}, 1.0);
    follow_world(b, {solver, ik::kPole}, pole);
  }
  connect_joints(b, chain, solver);
}

}  // namespace

void ik_handle(Builder& b) {
  const Parameters& with = b.with();
  const std::vector<NodeId> chain = chain_between(b, with.node("start"), with.node("end"), "end");
  const NodeId goal = space_from(b, "goal", root_control(b));
  if (b.failed()) return;
  const NodeId handle = b.make({.kind = scene::Kind::handle,
                                .role = "handle",
                                .joint = chain.back(),
                                .parent = {},
                                .suffix = ""});
  hang(b, handle, goal, {character_axes(b), position(b, chain.back())});
  if (with.text("solver") == "two_bone") {
    build_two_bone(b, chain, handle);
  } else {
    build_chain(b, chain, handle);
  }
}

}  // namespace rigc::modules
