// SPDX-License-Identifier: MIT
// Finds the roll and twist joints of a model. Test: tests/modules/twist_joints_test.cpp
#include "modules/limbs/bone_riders.h"

#include <algorithm>

#include "modules/steps.h"

namespace rigc::modules {
namespace {

/// How far from its bone's line a joint of the model may lie, in lengths of the bone.
constexpr double kNear = 0.05;

bool is_tagged(const Builder& b, NodeId joint) {
  const Identifiers& ids = b.scene()[joint].ids;
  return !ids.local.empty() || !ids.label.empty();
}

}  // namespace

bool lies_above(const Builder& b, NodeId above, NodeId joint) {
  for (NodeId at = joint; at.valid(); at = b.scene()[at].parent)
    if (at == above) return true;
  return false;
}

std::vector<Rider> riders_on(const Builder& b, NodeId start, NodeId end) {
  std::vector<Rider> out;
  const math::Vec3 origin = position(b, start), bone = position(b, end) - origin;
  const double length = math::length(bone);
  if (!(length > 0)) return out;
  const auto add = [&](NodeId joint) {
    if (b.scene()[joint].kind != scene::Kind::joint || !b.scene()[joint].is_skeleton()) return;
    if (joint == end || is_tagged(b, joint)) return;
    const math::Vec3 offset = position(b, joint) - origin;
    const double fraction = math::dot(offset, bone) / (length * length);
    const double away = math::length(offset - bone * fraction) / length;
    if (away <= kNear && fraction > -kNear && fraction < 1 + kNear)
      out.push_back({joint, std::clamp(fraction, 0.0, 1.0)});
  };
  if (lies_above(b, start, end))
    for (NodeId at = b.scene()[end].parent; at != start; at = b.scene()[at].parent) add(at);
  for (const NodeId child : b.scene()[start].children)
    if (!lies_above(b, child, end)) add(child);
  std::stable_sort(out.begin(), out.end(),
                   [](const Rider& a, const Rider& c) { return a.fraction < c.fraction; });
  return out;
}

}  // namespace rigc::modules
