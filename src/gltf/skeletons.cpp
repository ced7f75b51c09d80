// SPDX-License-Identifier: MIT
// Skeletons of a file, each in the rest pose that was asked for.
// Test: tests/gltf/skeletons_test.cpp
#include "gltf/skeletons.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "base/text.h"
#include "base/trace.h"
#include "gltf/bind.h"
#include "gltf/bones.h"
#include "gltf/clips.h"
#include "gltf/codes.h"
#include "gltf/rig_codes.h"
#include "gltf/rig_json.h"
#include "gltf/slim.h"

namespace rigc::gltf {
namespace {

using math::Affine;

/// Determinants below this are 0: a node scaled by 1e-10 along each axis.
constexpr double kFlat = 1e-30;

/// Local matrices that a clip gives to nodes at a time.
std::map<int, Affine> sample_clip(const Slim& slim, const anim::Clip& clip, double seconds) {
  std::map<int, math::Trs> posed;
  for (const anim::Channel& channel : clip.channels) {
    if (channel.path == anim::Path::attribute || channel.path == anim::Path::weights) continue;
    const math::Trs& local = slim.node(channel.node).local;
    math::Trs& trs = posed.emplace(channel.node, local).first->second;
    double v[4] = {0, 0, 0, 1};
    anim::sample(channel.curve, channel.path == anim::Path::rotation, seconds, v);
    if (channel.path == anim::Path::translation) trs.translation = {v[0], v[1], v[2]};
    if (channel.path == anim::Path::scale) trs.scale = {v[0], v[1], v[2]};
    if (channel.path == anim::Path::rotation)
      trs.rotation = math::normalised(math::Quat{v[0], v[1], v[2], v[3]});
  }
  std::map<int, Affine> result;
  for (const auto& [node, trs] : posed) result[node] = math::compose(trs);
  return result;
}

/// The pose `CLIP@SECONDS`; a clip's name may have an @ of its own.
std::optional<std::map<int, Affine>> clip_pose(const File& file, const Slim& slim,
                                               const std::string& rest, Diagnostics& diagnostics) {
  const std::size_t at = rest.rfind('@');
  const auto seconds = at == std::string::npos ? std::nullopt : parse_number(rest.substr(at + 1));
  if (!seconds || *seconds < 0) {
    diagnostics.report(codes::kRest, Place(file.path),
                       fmt::format("\"{}\" is no rest pose", printable(rest, 80)),
                       "one of bind, nodes, CLIP@SECONDS");
    return std::nullopt;
  }
  const auto clips = read_clips(file, diagnostics);
  if (!clips) return std::nullopt;
  std::vector<std::string> names;
  for (const anim::Clip& clip : clips->clips) {
    if (clip.name == rest.substr(0, at)) return sample_clip(slim, clip, *seconds);
    names.push_back(clip.name);
  }
  diagnostics.report(codes::kRest, Place(file.path),
                     fmt::format("there is no clip \"{}\"", printable(rest.substr(0, at), 80)),
                     suggest(rest.substr(0, at), names));
  return std::nullopt;
}

/// Joints of one skeleton. `placed`: rest matrices that are known; `posed`: local ones that differ
/// from the nodes'.
tags::ForeignSkeleton assemble(const Slim& slim, const Bones& bones,
                               const std::map<int, Affine>& placed,
                               const std::map<int, Affine>& posed,
                               const std::vector<std::pair<std::string, int>>& humanoid) {
  tags::ForeignSkeleton skeleton;
  skeleton.ancestor = bones.ancestor;
  skeleton.ancestor_world = slim.world(bones.ancestor);
  std::map<int, int> index;
  for (int number : bones.nodes) {
    const SlimNode& node = slim.node(number);
    tags::ForeignJoint joint;
    joint.node = number;
    joint.name = node.name;
    joint.local = node.local;
    const auto parent = index.find(node.parent);
    if (parent != index.end()) joint.parent = parent->second;
    const auto bind = placed.find(number);
    if (bind != placed.end()) {
      joint.rest = bind->second;
    } else {
      const auto pose = posed.find(number);
      const Affine& local = pose != posed.end() ? pose->second : node.matrix;
      if (joint.parent >= 0)
        joint.rest = skeleton.joints[static_cast<std::size_t>(joint.parent)].rest * local;
      else if (node.parent == bones.ancestor)
        joint.rest = local;
      else  // a node between, which belongs to another skeleton
        joint.rest = math::inverse(skeleton.ancestor_world) * slim.world(node.parent) * local;
    }
    index[number] = static_cast<int>(skeleton.joints.size());
    skeleton.joints.push_back(std::move(joint));
  }
  for (int skin : bones.skins)
    for (int joint : slim.skins[static_cast<std::size_t>(skin)].joints)
      skeleton.joints[static_cast<std::size_t>(index.at(joint))].in_skin = true;
  if (!humanoid.empty() && index.count(humanoid[0].second) != 0)
    for (const auto& [bone, node] : humanoid) skeleton.humanoid.emplace_back(bone, index.at(node));
  return skeleton;
}

bool is_finite(const Affine& a) {
  for (const math::Vec3& v : {a.linear.x, a.linear.y, a.linear.z, a.origin})
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) return false;
  return true;
}

/// Scale 0 above a skeleton, or its inverse, has no meaning for the rig that would lie in it.
void check_rests(const File& file, const tags::ForeignSkeleton& skeleton,
                 Diagnostics& diagnostics) {
  const double size = std::abs(math::determinant(skeleton.ancestor_world.linear));
  if (!(size > kFlat && std::isfinite(size))) {
    diagnostics.report(
        codes::kRestUndefined, Place(file.path, fmt::format("/nodes/{}", skeleton.ancestor)),
        fmt::format("node {}, which the skeleton hangs under, is scaled {}", skeleton.ancestor,
                    size > 1 ? "beyond all numbers" : "to nothing"));
    return;
  }
  for (const tags::ForeignJoint& joint : skeleton.joints) {
    if (is_finite(joint.rest)) continue;
    diagnostics.report(codes::kRestUndefined,
                       Place(file.path, fmt::format("/nodes/{}", joint.node)),
                       fmt::format("the rest pose of \"{}\" is not finite", printable(joint.name)));
    return;
  }
}

}  // namespace

std::optional<std::vector<tags::ForeignSkeleton>> read_skeletons(const File& file,
                                                                 const std::string& rest,
                                                                 Diagnostics& diagnostics) {
  const trace::Span span("read skeletons");
  const auto slim = read_slim(file, diagnostics, false);
  if (!slim) return std::nullopt;
  std::map<int, Affine> posed;
  if (rest != "bind" && rest != "nodes") {
    auto pose = clip_pose(file, *slim, rest, diagnostics);
    if (!pose) return std::nullopt;
    posed = *std::move(pose);
  }
  const auto humanoid = read_humanoid(file);
  const std::size_t errors = diagnostics.errors();
  const BindContext context = bind_context(*slim);
  std::vector<tags::ForeignSkeleton> result;
  for (const Bones& bones : find_bones(*slim, humanoid)) {
    if (bones.nodes.size() > kMostJoints) {
      diagnostics.report(codes::kRigTooLarge,
                         Place(file.path, fmt::format("/nodes/{}", bones.nodes.front())),
                         fmt::format("the skeleton has {} nodes; at most {} are rigged",
                                     bones.nodes.size(), kMostJoints));
      continue;
    }
    std::vector<std::string> notes;
    std::map<int, Affine> placed;
    if (rest == "bind") {
      auto bind = read_bind(file, *slim, context, bones, notes, diagnostics);
      if (!bind) continue;
      placed = *std::move(bind);
    }
    tags::ForeignSkeleton skeleton = assemble(*slim, bones, placed, posed, humanoid);
    skeleton.file = file.path;
    skeleton.notes = std::move(notes);
    check_rests(file, skeleton, diagnostics);
    result.push_back(std::move(skeleton));
  }
  if (diagnostics.errors() != errors) return std::nullopt;
  return result;
}

}  // namespace rigc::gltf
