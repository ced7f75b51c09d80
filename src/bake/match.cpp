// SPDX-License-Identifier: MIT
// Which limbs can be matched, at which times, and the keys of what was.
// Test: tests/bake/match_test.cpp
#include "bake/match.h"

#include <algorithm>

#include "bake/frames.h"
#include "bake/key_edit.h"
#include "bake/said.h"
#include "eval/clip_inputs.h"

namespace rigc::bake {
namespace {

using scene::NodeId;
using scene::Plug;
namespace at = scene::match;
namespace transform = scene::transform;

/// Numbers that are kept for a frame, at most: worlds, what the solver reads, keys.
constexpr std::size_t kWidth = 256;

/// Fills a limb from its node; false where a connection is missing.
bool read_limb(const scene::Scene& scene, NodeId node, MatchLimb& limb) {
  SaidReader said(scene, node);
  limb.name = said.text(at::kLimb);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto element = static_cast<std::int32_t>(i);
    limb.joints[i] = said.transform({at::kJoints, element});
    limb.fk[i] = said.transform({at::kFk, element});
  }
  limb.ik = said.transform({at::kIk});
  limb.pole = said.transform({at::kPole});
  limb.solver = said.plug({at::kSolver}).node;
  limb.mode = said.attribute({at::kSwitch});
  std::int32_t element = 0;
  for (const std::string& word : said.words(at::kMeanings))
    limb.by.emplace(word, said.attribute({at::kNumbers, element++}));
  const std::size_t held = scene[node].attributes[at::kHeld].size();
  for (std::size_t i = 0; i < held; ++i)
    limb.held.push_back(said.transform({at::kHeld, static_cast<std::int32_t>(i)}));
  return said.complete() && scene[limb.solver].kind == scene::Kind::ik_two_bone;
}

anim::Path path_of(const Plug& plug) {
  if (plug.attribute == transform::kTranslate) return anim::Path::translation;
  if (plug.attribute == transform::kRotation) return anim::Path::rotation;
  return anim::Path::attribute;
}

std::vector<double> numbers_of(const scene::Value& value) {
  if (const auto* number = std::get_if<double>(&value)) return {*number};
  if (const auto* v = std::get_if<math::Vec3>(&value)) return {v->x, v->y, v->z};
  const auto& q = std::get<math::Quat>(value);
  return {q.x, q.y, q.z, q.w};
}

}  // namespace

std::vector<MatchLimb> find_match_limbs(const scene::Scene& scene) {
  std::vector<MatchLimb> limbs;
  for (const NodeId id : scene.nodes()) {
    if (scene[id].kind != scene::Kind::match) continue;
    MatchLimb limb;
    if (read_limb(scene, id, limb)) limbs.push_back(std::move(limb));
  }
  return limbs;
}

std::optional<std::vector<double>> match_times(const scene::Scene& scene,
                                               const std::vector<int>& nodes,
                                               const anim::Clip& clip, const MatchTiming& when,
                                               Diagnostics& diagnostics) {
  anim::Clip keys;
  for (const eval::ClipInput& input : eval::clip_inputs(scene, nodes, clip)) {
    keys.channels.emplace_back().curve = *input.curve;
    if (when.steps) keys.channels.back().curve.interpolation = anim::Interpolation::linear;
  }
  Options options;
  options.fps = when.fps;
  options.start = when.start;
  options.end = when.end;
  return frame_times(clip, keys, options, kWidth, diagnostics);
}

anim::Clip with_keys(const scene::Scene& scene, const std::vector<int>& nodes,
                     const anim::Clip& clip, const Matched& matched, const MatchOptions& options,
                     MatchReport& report) {
  anim::Clip out = clip;
  for (const Matched::Values& values : matched.values) {
    const Plug& plug = values.plug;
    const int node = nodes[plug.node.index];
    const anim::Path path = path_of(plug);
    const std::string name =
        path == anim::Path::attribute
            ? scene[plug.node].user[plug.attribute - scene::kUserAttributes].name
            : std::string();
    const auto found = std::find_if(out.channels.begin(), out.channels.end(), [&](const auto& c) {
      return c.node == node && c.path == path && c.attribute == name && !c.baked;
    });
    const std::vector<double> rest = numbers_of(scene.value(plug));
    const bool exists = found != out.channels.end();
    KeyEdit edit{exists ? &found->curve : nullptr,
                 path == anim::Path::rotation,
                 rest,
                 options.times,
                 values.numbers,
                 options.opens,
                 options.closes,
                 options.steps};
    const anim::Curve curve = edited(edit);
    ++report.channels;
    report.keys += curve.times->size();
    anim::Channel& channel = exists ? *found : out.channels.emplace_back();
    channel.node = node;
    channel.path = path;
    channel.attribute = name;
    channel.curve = curve;
  }
  return out;
}

}  // namespace rigc::bake
