// SPDX-License-Identifier: MIT
// Weights of morph targets in a bake. Test: tests/pipeline/morphs_test.cpp
#include "pipeline/bake_morphs.h"

#include <fmt/format.h>

#include <algorithm>

#include "bake/clip_frames.h"
#include "base/text.h"
#include "pipeline/codes.h"

namespace rigc::pipeline {
namespace {

using scene::Plug;

/// A target that the rig names, and its weight: what is connected there, else its value.
struct Named {
  std::string target;
  Plug weight;
};

std::vector<Named> named_targets(const scene::Scene& scene) {
  std::vector<Named> out;
  for (const scene::NodeId id : scene.nodes()) {
    if (scene[id].kind != scene::Kind::morph) continue;
    const auto names = std::get<std::string>(scene.value({id, scene::morph::kTargets}));
    std::int32_t index = 0;
    for (std::size_t at = 0; at <= names.size(); ++index) {
      const std::size_t end = std::min(names.find('\n', at), names.size());
      const Plug weight{id, scene::morph::kWeights, index};
      if (const auto source = scene.source(weight))
        out.push_back({names.substr(at, end - at), *source});
      at = end + 1;
    }
  }
  return out;
}

std::set<int> joints_of(const gltf::Rig& rig) {
  std::set<int> out;
  for (const scene::NodeId id : rig.scene.nodes()) {
    const int node = id.index < rig.nodes.size() ? rig.nodes[id.index] : -1;
    if (rig.scene[id].kind == scene::Kind::joint && node >= 0) out.insert(node);
  }
  for (const tags::TaggedJoint& joint : rig.skeleton.joints)
    if (joint.foreign_node >= 0) out.insert(joint.foreign_node);
  return out;
}

bool differs(const std::vector<float>& values, const std::vector<float>& weights) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i] != weights[i % weights.size()]) return true;
  return false;
}

/// One key where the weights never change.
void shorten(anim::Curve& curve) {
  const std::vector<float> first(curve.values.begin(), curve.values.begin() + curve.width);
  if (differs(curve.values, first)) return;
  curve.values = first;
  curve.times = std::make_shared<const std::vector<float>>(1, curve.times->front());
}

}  // namespace

std::vector<DrivenMorphs> find_driven_morphs(const gltf::File& file, const gltf::Slim& slim,
                                             const gltf::Rig& rig, Diagnostics& diagnostics,
                                             const gltf::Rig* before) {
  std::vector<DrivenMorphs> out;
  const std::vector<Named> named = named_targets(rig.scene);
  if (named.empty()) return out;
  std::vector<bool> found(named.size());
  std::set<int> joints = joints_of(rig);
  if (before) joints.merge(joints_of(*before));
  for (gltf::MorphedNode& mesh : gltf::find_morphed(file, slim, joints)) {
    DrivenMorphs morphs{std::move(mesh), {}};
    for (std::size_t i = 0; i < named.size(); ++i) {
      const auto& targets = morphs.mesh.targets;
      const auto at = std::find(targets.begin(), targets.end(), named[i].target);
      if (at == targets.end()) continue;
      found[i] = true;
      morphs.driven.push_back({static_cast<std::size_t>(at - targets.begin()), named[i].weight});
    }
    if (!morphs.driven.empty()) out.push_back(std::move(morphs));
  }
  for (std::size_t i = 0; i < named.size(); ++i) {
    if (found[i]) continue;
    diagnostics.report(codes::kNoMorphTarget, Place(file.path),
                       fmt::format("no mesh that rig \"{}\" moves has a morph target \"{}\"",
                                   printable(rig.skeleton.global), printable(named[i].target)));
  }
  return out;
}

void report_missing_morphs(const gltf::File& model, const gltf::Rig& rig, Diagnostics& diagnostics,
                           const gltf::Rig* before) {
  if (named_targets(rig.scene).empty()) return;
  const auto slim = gltf::read_slim(model, diagnostics, false);
  if (slim) find_driven_morphs(model, *slim, rig, diagnostics, before);
}

std::optional<std::vector<anim::Channel>> bake_morphs(const gltf::File& file,
                                                      const gltf::Slim& slim, const gltf::Rig& rig,
                                                      const std::vector<DrivenMorphs>& morphs,
                                                      const anim::Clip& clip,
                                                      const std::vector<float>& times,
                                                      Diagnostics& diagnostics) {
  std::vector<Plug> plugs;
  for (const DrivenMorphs& each : morphs)
    for (const auto& driven : each.driven) plugs.push_back(driven.weight);
  std::vector<anim::Channel> out;
  if (plugs.empty()) return out;
  const std::vector<double> seconds(times.begin(), times.end());
  bake::ClipFrames frames(rig.scene, seconds, diagnostics);
  frames.sample(rig.nodes, clip);
  const auto numbers = frames.evaluate(plugs);
  if (!numbers) return std::nullopt;
  const auto all = std::make_shared<const std::vector<float>>(times);
  std::size_t row = 0;
  for (const DrivenMorphs& each : morphs) {
    const std::size_t width = each.mesh.weights.size();
    const auto before = gltf::read_weights_curve(file, slim, clip.source_animation, each.mesh.node,
                                                 width, diagnostics);
    if (!before) return std::nullopt;
    const bool keyed = before->times != nullptr;
    std::vector<float> values;
    std::vector<double> sampled(each.mesh.weights.begin(), each.mesh.weights.end());
    for (std::size_t f = 0; f < times.size(); ++f) {
      if (keyed) anim::sample(*before, false, static_cast<double>(times[f]), sampled.data());
      for (const double weight : sampled) values.push_back(static_cast<float>(weight));
      for (const auto& driven : each.driven) values[f * width + driven.target] = 0;
      for (std::size_t i = 0; i < each.driven.size(); ++i)
        values[f * width + each.driven[i].target] += static_cast<float>((*numbers)[row + i][f]);
    }
    row += each.driven.size();
    if (!keyed && !differs(values, each.mesh.weights)) continue;
    anim::Channel& channel = out.emplace_back();
    channel.node = each.mesh.node;
    channel.path = anim::Path::weights;
    channel.curve = {anim::Interpolation::linear, static_cast<int>(width), all, std::move(values)};
    shorten(channel.curve);
  }
  return out;
}

}  // namespace rigc::pipeline
