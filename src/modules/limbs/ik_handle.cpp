// SPDX-License-Identifier: MIT
// ik_handle: a chain of joints whose last joint follows the handle.
// Test: tests/modules/ik_test.cpp
#include <fmt/format.h>

#include "modules/codes.h"
#include "modules/limbs/chain_ik.h"
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

/// Every joint on the way takes part, roll joints too: this is the solver for tails and ropes, of
/// which models have more joints than templates name.
void build_chain(Builder& b, const std::vector<NodeId>& chain, NodeId handle) {
  if (chain.size() < 2) {
    b.fail(codes::kTooFewJoints, "end", "an IK chain takes at least two joints");
    return;
  }
  NodeId pole = space_from(b, "pole", {});
  if (b.failed()) return;
  if (!pole.valid()) pole = straight_chain_pole(b, chain, b.with().text("bend"));
  make_chain_ik(b, {chain, chain.front(), handle, pole, b.with().number("twist"),
                    b.with().number("iterations")});
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
