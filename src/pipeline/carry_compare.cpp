// SPDX-License-Identifier: MIT
// Compares how a rig and its successor play. Test: tests/pipeline/update_test.cpp
#include <numeric>

#include "base/trace.h"
#include "pipeline/carry.h"
#include "update/skeleton.h"

namespace rigc::pipeline {
namespace {

using scene::NodeId;
using update::Destination;

std::map<JointKey, NodeId> joint_nodes(const scene::Scene& scene) {
  std::map<JointKey, NodeId> out;
  for (const NodeId id : scene.nodes())
    if (scene[id].is_skeleton()) out[scene[id].identity.owner] = id;
  return out;
}

/// The joints that both rigs have.
std::vector<update::JointPair> joint_pairs(const gltf::Rig& old, const gltf::Rig& fresh) {
  const std::map<JointKey, NodeId> before = joint_nodes(old.scene),
                                   after = joint_nodes(fresh.scene);
  const std::vector<int> from = update::counterparts(fresh.skeleton, old.skeleton);
  std::vector<update::JointPair> out;
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (from[i] < 0) continue;
    const tags::TaggedJoint& joint = fresh.skeleton.joints[i];
    const auto now = after.find(joint.key);
    const auto was = before.find(old.skeleton.joints[static_cast<std::size_t>(from[i])].key);
    if (now != after.end() && was != before.end())
      out.push_back({joint.name, was->second, now->second});
  }
  return out;
}

}  // namespace

/// Clips that play anything of the rig. Those on the model's joints alone play without it, and what
/// others play in the same file is no clip of this rig.
std::vector<bool> Carrier::concerned_clips() const {
  std::vector<bool> out(clips_.size(), false);
  for (const Move& move : moves_)
    if (!is_foreign(by_node_.at(clips_[move.clip].channels[move.channel].node)))
      out[move.clip] = true;
  return out;
}

/// The wanted clips as the successor plays them, on nodes of its scene; the others are empty.
std::vector<anim::Clip> Carrier::moved_clips(const std::vector<bool>& wanted) const {
  std::vector<anim::Clip> out(clips_.size());
  for (const Move& move : moves_) {
    if (!wanted[move.clip] || move.destination.kind == Destination::Kind::none) continue;
    const anim::Channel& channel = clips_[move.clip].channels[move.channel];
    const auto& match = matches_[by_node_.at(channel.node)];
    if (!match) continue;
    anim::Channel& moved = out[move.clip].channels.emplace_back(channel);
    moved.node = static_cast<int>(match->to.index);
    if (move.destination.kind == Destination::Kind::property)
      moved.attribute = move.destination.attribute;
    if (move.curve) moved.curve = *move.curve;
  }
  return out;
}

std::optional<std::vector<ClipComparison>> Carrier::compare(Diagnostics& diagnostics) const {
  const trace::Span span("compare motion");
  // A rig that is taken apart plays nothing.
  if (old_.commands.empty() || fresh_.commands.empty()) return std::vector<ClipComparison>();
  const std::vector<bool> concerned = concerned_clips();
  const std::vector<anim::Clip> now = moved_clips(concerned);
  const anim::Clip none;
  std::vector<update::ClipPair> pairs = {{&none, &none}};  // what stands without a clip
  std::vector<std::string> names(1);
  for (std::size_t i = 0; i < clips_.size(); ++i) {
    if (!concerned[i]) continue;
    pairs.push_back({&clips_[i], &now[i]});
    names.push_back(clips_[i].name);
  }
  std::vector<int> numbers(fresh_.scene.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  auto comparisons =
      update::compare({&old_.scene, &old_.nodes}, {&fresh_.scene, &numbers}, pairs,
                      joint_pairs(old_, fresh_), old_.skeleton.character.unit, diagnostics);
  if (!comparisons) return std::nullopt;
  std::vector<ClipComparison> out;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    out.push_back({names[i], std::move((*comparisons)[i])});
  return out;
}

}  // namespace rigc::pipeline
