// SPDX-License-Identifier: MIT
// Keys on what a rig has locked. Test: tests/pipeline/locks_test.cpp
#include "pipeline/locks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/text.h"
#include "eval/limits.h"
#include "pipeline/codes.h"
#include "scene/access.h"

namespace rigc::pipeline {
namespace {

using scene::NodeId;
namespace transform = scene::transform;

// Keys are 32-bit floats, and exporters take them from and to matrices.
constexpr double kRounding = 1e-5;

bool differs(double a, double b) {
  return std::abs(a - b) > kRounding * std::max({1.0, std::abs(a), std::abs(b)});
}

/// Numbers of the n-th key; of a cubic curve without its tangents.
const float* key_at(const anim::Curve& curve, std::size_t n) {
  const bool cubic = curve.interpolation == anim::Interpolation::cubic;
  const auto width = static_cast<std::size_t>(curve.width);
  return curve.values.data() + (cubic ? 3 * n + 1 : n) * width;
}

/// The two signs of a quaternion are one rotation.
bool differs(const math::Quat& a, const math::Quat& b) {
  const math::Quat c = math::dot(a, b) < 0 ? -b : b;
  return std::max({std::abs(a.x - c.x), std::abs(a.y - c.y), std::abs(a.z - c.z),
                   std::abs(a.w - c.w)}) > kRounding;
}

/// Locked components that a key would change, as bits from x on.
unsigned changed_by(const float* key, const eval::Limit& lock) {
  const bool rotation = lock.attribute == transform::kRotation;
  bool turned = false;
  if (rotation) {
    const math::Quat value = math::normalised(math::Quat{key[0], key[1], key[2], key[3]});
    turned = differs(value, math::limit_rotation(value, lock.space));
  }
  unsigned bits = 0;
  for (unsigned i = 0; i < 3; ++i) {
    const double held = lock.space.min[i];
    if (held != lock.space.max[i]) continue;
    if (rotation ? turned : differs(key[i], held)) bits |= 1u << i;
  }
  return bits;
}

/// Adds the names of what a channel would change.
void add_transform(const anim::Channel& channel, const std::vector<eval::Limit>& limits,
                   NodeId control, std::set<std::string_view>& names) {
  static constexpr std::pair<anim::Path, std::uint16_t> kPaths[] = {
      {anim::Path::translation, transform::kTranslate},
      {anim::Path::rotation, transform::kRotation},
      {anim::Path::scale, transform::kScale}};
  for (unsigned p = 0; p < 3; ++p) {
    if (kPaths[p].first != channel.path) continue;
    for (const eval::Limit& limit : limits) {
      if (limit.by != control || limit.attribute != kPaths[p].second) continue;
      unsigned bits = 0;
      for (std::size_t k = 0; k < channel.curve.times->size(); ++k)
        bits |= changed_by(key_at(channel.curve, k), limit);
      for (unsigned i = 0; i < 3; ++i)
        if (bits & 1u << i) names.insert(scene::component_name(3 * p + i));
    }
  }
}

void add_attribute(const anim::Channel& channel, const scene::Node& control,
                   std::set<std::string_view>& names) {
  for (const scene::UserAttribute& attribute : control.user) {
    if (attribute.name != channel.attribute || attribute.keyable) continue;
    for (std::size_t k = 0; k < channel.curve.times->size(); ++k)
      if (differs(*key_at(channel.curve, k), attribute.value)) names.insert(attribute.name);
  }
}

}  // namespace

void report_locked_keys(const std::string& file, const gltf::Rig& rig, const anim::Clip& clip,
                        Diagnostics& diagnostics) {
  Diagnostics ignored;  // whoever evaluates the rig reports what is wrong with it
  const eval::Limits limits(rig.scene, ignored);
  std::map<int, NodeId> controls;
  for (NodeId id : rig.scene.nodes()) {
    const bool control = rig.scene[id].kind == scene::Kind::control;
    if (control && rig.nodes[id.index] >= 0) controls.emplace(rig.nodes[id.index], id);
  }
  std::map<NodeId, std::set<std::string_view>> keyed;
  for (const anim::Channel& channel : clip.channels) {
    const auto found = controls.find(channel.node);
    if (found == controls.end() || !channel.curve.times) continue;
    const NodeId id = found->second;
    if (channel.path == anim::Path::attribute)
      add_attribute(channel, rig.scene[id], keyed[id]);
    else if (const auto* of_control = limits.of(id))
      add_transform(channel, *of_control, id, keyed[id]);
  }
  for (const auto& [id, names] : keyed) {
    if (names.empty()) continue;
    const std::vector<std::string> list(names.begin(), names.end());
    diagnostics.report(codes::kLockedKeys,
                       Place(file, fmt::format("/animations/{}", clip.source_animation)),
                       fmt::format("clip \"{}\" keys {} of \"{}\", which {} locked",
                                   printable(clip.name), join(list, ", "),
                                   printable(rig.scene[id].name), list.size() > 1 ? "are" : "is"));
  }
}

}  // namespace rigc::pipeline
