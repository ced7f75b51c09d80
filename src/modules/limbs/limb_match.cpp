// SPDX-License-Identifier: MIT
// What the rig says about keying a limb both ways. Test: tests/modules/limb_match_test.cpp
#include "modules/limbs/limb_match.h"

#include "modules/steps.h"

namespace rigc::modules {
namespace {

namespace match = scene::match;

void name_world(Builder& b, NodeId of, const Plug& input) { b.connect(world_of(of), input); }

}  // namespace

NodeId make_match(Builder& b, const LimbParts& limb, const Meanings& meanings) {
  const NodeId node = b.make({.kind = scene::Kind::match,
                              .role = "driver",
                              .joint = limb.joints[2],
                              .parent = {},
                              .suffix = "match"});
  b.set({node, match::kLimb}, b.scene()[limb.settings].ids.local);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto element = static_cast<std::int32_t>(i);
    name_world(b, limb.joints[i], {node, match::kJoints, element});
    name_world(b, limb.fk[i], {node, match::kFk, element});
  }
  name_world(b, limb.ik, {node, match::kIk});
  name_world(b, limb.pole, {node, match::kPole});
  b.connect({limb.solver, scene::ik2::kStartWorld}, {node, match::kSolver});
  b.connect(limb.ik_weight, {node, match::kSwitch});
  add_meanings(b, node, meanings);
  return node;
}

void add_held(Builder& b, NodeId node, NodeId control) {
  if (!node.valid()) return;
  const std::size_t count = b.scene()[node].attributes[match::kHeld].size();
  name_world(b, control, {node, match::kHeld, static_cast<std::int32_t>(count)});
}

void add_meanings(Builder& b, NodeId node, const Meanings& meanings) {
  std::string words = std::get<std::string>(b.scene().value({node, match::kMeanings}));
  auto count = static_cast<std::int32_t>(b.scene()[node].attributes[match::kNumbers].size());
  for (const auto& [word, plug] : meanings) {
    words += (words.empty() ? "" : " ") + word;
    b.connect(plug, {node, match::kNumbers, count++});
  }
  b.set({node, match::kMeanings}, words);
}

}  // namespace rigc::modules
