// SPDX-License-Identifier: MIT
// Check of clips on controls: attributes that are not there, that a connection decides, or that
// limits hold back. Test: tests/pipeline/check_test.cpp
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/text.h"
#include "eval/limits.h"
#include "pipeline/check_kinds.h"
#include "pipeline/codes.h"
#include "scene/access.h"

namespace rigc::pipeline {
namespace {

using scene::NodeId;
namespace transform = scene::transform;

// Keys are 32-bit floats, and exporters take them from and to matrices.
constexpr double kRounding = 1e-5;

struct TransformPath {
  anim::Path path;
  std::uint16_t attribute;
  const char* name;
  unsigned bits;
};
constexpr TransformPath kPaths[] = {
    {anim::Path::translation, transform::kTranslate, "translate", scene::kTranslateBits},
    {anim::Path::rotation, transform::kRotation, "rotate", scene::kRotateBits},
    {anim::Path::scale, transform::kScale, "scale", scene::kScaleBits}};

bool differs(double a, double b) {
  return std::abs(a - b) > kRounding * std::max({1.0, std::abs(a), std::abs(b)});
}

class ClipCheck {
 public:
  ClipCheck(const std::string& path, const gltf::Rig& rig, Diagnostics& diagnostics)
      : path_(path), rig_(rig), limits_(rig.scene, ignored_), diagnostics_(diagnostics) {
    for (NodeId id : rig.scene.nodes())
      if (rig.nodes[id.index] >= 0) nodes_.emplace(rig.nodes[id.index], id);
  }
  void check(const anim::Clip& clip) {
    clip_ = &clip;
    for (const anim::Channel& channel : clip.channels) {
      const auto found = nodes_.find(channel.node);
      if (found != nodes_.end() && channel.curve.times) check(channel, found->second);
    }
  }

 private:
  void check(const anim::Channel& channel, NodeId id);
  void check_attribute(const anim::Channel& channel, NodeId id);
  void check_transform(const anim::Channel& channel, NodeId id, const TransformPath& path);
  void check_bounds(const anim::Channel& channel, NodeId id, const TransformPath& path);
  template <class Outside>
  void report_outside(const anim::Channel& channel, NodeId id, const std::string& what,
                      Outside outside);
  void report(const Code& code, const anim::Channel& channel, NodeId id, const std::string& text,
              std::string hint = {}) {
    diagnostics_.report(code,
                        Place(path_, fmt::format("/animations/{}/channels/{}",
                                                 clip_->source_animation, channel.source_channel)),
                        fmt::format("clip \"{}\": {} of \"{}\"", printable(clip_->name), text,
                                    printable(rig_.scene[id].name)),
                        std::move(hint));
  }

  const std::string& path_;
  const gltf::Rig& rig_;
  Diagnostics ignored_;  // whoever evaluates the rig reports its limits
  eval::Limits limits_;
  Diagnostics& diagnostics_;
  std::map<int, NodeId> nodes_;  // by glTF node
  const anim::Clip* clip_ = nullptr;
};

void ClipCheck::check(const anim::Channel& channel, NodeId id) {
  const scene::Node& node = rig_.scene[id];
  if (channel.path == anim::Path::weights || channel.baked) return;
  if (channel.path == anim::Path::attribute) return check_attribute(channel, id);
  for (const TransformPath& path : kPaths) {
    if (path.path != channel.path) continue;
    if (node.kind == scene::Kind::control)
      check_transform(channel, id, path);
    else if (!node.is_skeleton() && node.kind != scene::Kind::joint)
      report(codes::kNotAControl, channel, id, fmt::format("keys {}", path.name),
             "it is a node between the controls that the rig places; key the controls");
  }
}

void ClipCheck::check_attribute(const anim::Channel& channel, NodeId id) {
  const auto& user = rig_.scene[id].user;
  const auto found = std::find_if(user.begin(), user.end(), [&](const auto& attribute) {
    return attribute.name == channel.attribute;
  });
  if (found == user.end()) {
    std::vector<std::string> names;
    for (const scene::UserAttribute& attribute : user) names.push_back(attribute.name);
    return report(codes::kNoAttributeKeyed, channel, id,
                  fmt::format("keys \"{}\", which is no attribute", printable(channel.attribute)),
                  suggest(channel.attribute, names));
  }
  const auto index = static_cast<std::uint16_t>(scene::kUserAttributes + (found - user.begin()));
  if (rig_.scene.source({id, index}))
    return report(codes::kDrivenKeyed, channel, id,
                  fmt::format("keys \"{}\", which a connection decides,", found->name));
  report_outside(channel, id, found->name, [&](const double* key) {
    return (found->min && *key < *found->min && differs(*key, *found->min)) ||
           (found->max && *key > *found->max && differs(*key, *found->max));
  });
}

void ClipCheck::check_transform(const anim::Channel& channel, NodeId id,
                                const TransformPath& path) {
  const unsigned locked = scene::bits_at(rig_.scene, id, scene::control::kLocked) & path.bits;
  const unsigned keyable = scene::keyable_bits(rig_.scene, id) & path.bits;
  if (scene::driven_bits(rig_.scene, id) & path.bits)
    report(codes::kDrivenKeyed, channel, id,
           fmt::format("keys {}, which a connection decides,", path.name));
  else if (keyable == 0 && locked == 0)
    report(codes::kDrivenKeyed, channel, id,
           fmt::format("keys {}, which the rig does not offer", path.name),
           fmt::format("`{}: on` in the control's `with:` offers it", path.name));
  check_bounds(channel, id, path);
}

void ClipCheck::check_bounds(const anim::Channel& channel, NodeId id, const TransformPath& path) {
  const std::vector<eval::Limit>* limits = limits_.of(id);
  if (!limits) return;
  report_outside(channel, id, path.name, [&](const double* key) {
    return std::any_of(limits->begin(), limits->end(), [&](const eval::Limit& limit) {
      if (limit.by == id || limit.attribute != path.attribute) return false;
      if (path.path == anim::Path::rotation) {
        const math::Quat value = math::normalised(math::Quat{key[0], key[1], key[2], key[3]});
        return 1 - std::abs(dot(value, math::limit_rotation(value, limit.space))) > kRounding;
      }
      const math::Vec3 value{key[0], key[1], key[2]};
      const math::Vec3 held = math::limit_vector(value, limit.space);
      return differs(value.x, held.x) || differs(value.y, held.y) || differs(value.z, held.z);
    });
  });
}

/// Counts the keys that lie outside.
template <class Outside>
void ClipCheck::report_outside(const anim::Channel& channel, NodeId id, const std::string& what,
                               Outside outside) {
  std::size_t count = 0;
  float first = 0;
  for (const float time : *channel.curve.times) {
    double key[4] = {};
    anim::sample(channel.curve, channel.path == anim::Path::rotation, time, key);
    if (!outside(key)) continue;
    if (count++ == 0) first = time;
  }
  if (count == 0) return;
  report(codes::kOutsideLimits, channel, id,
         fmt::format("{} of {} keys are outside of the limits of {}, first at {} s,", count,
                     channel.curve.times->size(), what, first));
}

}  // namespace

void check_clips(const std::string& path, const gltf::Rig& rig,
                 const std::vector<anim::Clip>& clips, Diagnostics& diagnostics) {
  ClipCheck check(path, rig, diagnostics);
  for (const anim::Clip& clip : clips) check.check(clip);
}

}  // namespace rigc::pipeline
