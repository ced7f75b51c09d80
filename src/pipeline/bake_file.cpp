// SPDX-License-Identifier: MIT
// Bake a file. Test: tests/pipeline/bake_test.cpp
#include "pipeline/bake_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/text.h"
#include "gltf/clips.h"
#include "gltf/rig.h"
#include "pipeline/build.h"
#include "pipeline/codes.h"

namespace rigc::pipeline {
namespace {

/// glTF nodes of a rig, apart: what animators key, and what the rig drives.
struct RigNodes {
  std::set<int> controls;
  std::set<int> driven;
};

RigNodes nodes_of(const gltf::Rig& rig) {
  RigNodes nodes;
  for (scene::NodeId id : rig.scene.nodes()) {
    const int node = rig.nodes[id.index];
    if (node < 0) continue;
    (rig.scene[id].is_skeleton() ? nodes.driven : nodes.controls).insert(node);
  }
  return nodes;
}

std::optional<bake::Options> read_options(const BakeRequest& request, Diagnostics& diagnostics) {
  bake::Options options;
  options.start = request.start;
  options.end = request.end;
  const auto fps = request.fps == "source" ? std::optional<double>(0) : parse_number(request.fps);
  const bool positive = fps && (*fps > 0 || request.fps == "source") && *fps <= 10000;
  if (!positive || (request.start && request.end && *request.start > *request.end)) {
    diagnostics.report(codes::kBadRange, Place(request.file),
                       positive ? "--start lies after --end"
                                : fmt::format("\"{}\" is no frame rate", printable(request.fps)),
                       "--fps takes a number above 0, or source for the keys' own times");
    return std::nullopt;
  }
  options.fps = *fps;
  return options;
}

/// The clips that the request names; all of them where it names none.
std::optional<std::set<std::size_t>> choose_clips(const BakeRequest& request,
                                                  const std::vector<anim::Clip>& clips,
                                                  Diagnostics& diagnostics) {
  std::set<std::size_t> chosen;
  std::vector<std::string> names;
  for (const anim::Clip& clip : clips) names.push_back(clip.name);
  for (const std::string& wanted : request.clips) {
    const auto number = parse_integer(wanted);
    bool found = false;
    for (std::size_t i = 0; i < clips.size(); ++i) {
      if (clips[i].name != wanted && !(number && *number == static_cast<long long>(i))) continue;
      chosen.insert(i);
      found = true;
    }
    if (found) continue;
    diagnostics.report(codes::kNoSuchClip, Place(request.file),
                       fmt::format("there is no clip \"{}\"", printable(wanted)),
                       suggest(wanted, names));
  }
  if (!diagnostics.ok()) return std::nullopt;
  for (std::size_t i = 0; request.clips.empty() && i < clips.size(); ++i) chosen.insert(i);
  return chosen;
}

/// Bakes one clip over every rig whose controls it animates.
std::optional<BakedClip> bake_clip(const BakeRequest& request, const bake::Options& base,
                                   const anim::Clip& clip, const std::vector<gltf::Rig>& rigs,
                                   const gltf::File& file, gltf::Patch& patch,
                                   Diagnostics& diagnostics) {
  BakedClip baked{clip.name, true, {}};
  anim::Clip out{clip.name, clip.source_animation, {}};
  std::vector<int> dropped;
  std::size_t foreign = 0;
  for (const gltf::Rig& rig : rigs) {
    const RigNodes nodes = nodes_of(rig);
    const auto on_control = [&](const anim::Channel& c) {
      return nodes.controls.count(c.node) != 0;
    };
    if (std::none_of(clip.channels.begin(), clip.channels.end(), on_control)) continue;
    baked.passed_through = false;
    bake::Options options = base;
    options.tolerance = request.tolerance_mm / 1000 * rig.skeleton.character.unit;
    const auto joints = bake::bake(rig.scene, rig.nodes, clip, options, baked.report, diagnostics);
    if (!joints) return std::nullopt;
    out.channels.insert(out.channels.end(), joints->channels.begin(), joints->channels.end());
    for (const anim::Channel& channel : clip.channels) {
      const bool driven = nodes.driven.count(channel.node) != 0;
      foreign += driven ? 1 : 0;
      if (driven || (on_control(channel) && !request.keep_rig))
        dropped.push_back(channel.source_channel);
    }
  }
  if (baked.passed_through) return baked;
  if (foreign > 0) {
    diagnostics.report(
        codes::kForeignChannels,
        Place(file.path, fmt::format("/animations/{}", clip.source_animation)),
        fmt::format("{} channels of clip \"{}\" move joints that the rig drives; the controls win",
                    foreign, printable(clip.name)));
  }
  if (baked.report.shear > 1e-4) {
    diagnostics.report(codes::kShear,
                       Place(file.path, fmt::format("/animations/{}", clip.source_animation)),
                       fmt::format("clip \"{}\": joints are sheared, by up to {:.2g} of their size",
                                   printable(clip.name), baked.report.shear));
  }
  gltf::write_clip(patch, file, out, dropped);
  return baked;
}

}  // namespace

std::optional<Baked> bake_file(const BakeRequest& request, const std::string& out,
                               Diagnostics& diagnostics) {
  const auto options = read_options(request, diagnostics);
  if (!options || !check_output_name(out, diagnostics)) return std::nullopt;
  const auto file = gltf::open(request.file, diagnostics);
  if (!file) return std::nullopt;
  const auto rigs = gltf::read_rigs(*file, diagnostics);
  if (!rigs) return std::nullopt;
  if (rigs->empty()) {
    diagnostics.report(codes::kNoRig, Place(request.file), "the file has no rig to bake");
    return std::nullopt;
  }
  const auto clips = gltf::read_clips(*file, diagnostics);
  if (!clips) return std::nullopt;
  const auto chosen = choose_clips(request, clips->clips, diagnostics);
  if (!chosen) return std::nullopt;

  Baked result;
  gltf::Patch patch(*file);
  for (std::size_t i : *chosen) {
    auto baked = bake_clip(request, *options, clips->clips[i], *rigs, *file, patch, diagnostics);
    if (!baked) return std::nullopt;
    result.clips.push_back(std::move(*baked));
  }
  if (!request.keep_rig) {
    for (const gltf::Rig& rig : *rigs) gltf::strip_rig(patch, *file, rig);
  }
  if (!write_output(patch, *file, out, result.bytes, diagnostics)) return std::nullopt;
  return result;
}

}  // namespace rigc::pipeline
