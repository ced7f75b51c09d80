// SPDX-License-Identifier: MIT
// Bake a file. Test: tests/pipeline/bake_test.cpp
#include "pipeline/bake_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/text.h"
#include "base/trace.h"
#include "gltf/clips.h"
#include "gltf/rig.h"
#include "pipeline/build.h"
#include "pipeline/codes.h"
#include "pipeline/locks.h"

namespace rigc::pipeline {
namespace {

/// Shear below this, in sizes of the joint, is rounding.
constexpr double kShearReported = 1e-4;

/// A rig with what baking it needs to know of its file.
struct Bakeable {
  const gltf::Rig* rig;
  std::vector<bake::Standing> standings;
  std::set<int> controls;  ///< glTF nodes that are not bones: what animators key
};

std::optional<std::vector<Bakeable>> look_at_rigs(const gltf::File& file,
                                                  const std::vector<gltf::Rig>& rigs,
                                                  Diagnostics& diagnostics) {
  std::vector<Bakeable> out;
  for (const gltf::Rig& rig : rigs) {
    const auto standings = gltf::standings(file, rig, diagnostics);
    if (!standings) return std::nullopt;
    Bakeable& bakeable = out.emplace_back();
    bakeable.rig = &rig;
    for (const gltf::Standing& s : *standings)
      bakeable.standings.push_back({s.base, s.between, s.local});
    for (scene::NodeId id : rig.scene.nodes()) {
      const bool bone = rig.scene[id].kind == scene::Kind::joint;
      if (!bone && rig.nodes[id.index] >= 0) bakeable.controls.insert(rig.nodes[id.index]);
    }
  }
  return out;
}

std::optional<bake::Options> read_options(const BakeRequest& request, Diagnostics& diagnostics) {
  bake::Options options;
  options.start = request.start;
  options.end = request.end;
  const auto fps = request.fps == "source" ? std::optional<double>(0) : parse_number(request.fps);
  const bool positive = fps && (*fps > 0 || request.fps == "source") && *fps <= 10000;
  if (!positive || (request.start && request.end && *request.start > *request.end)) {
    diagnostics.report(
        codes::kBadRange, Place(request.file),
        positive ? "--start lies after --end"
                 : fmt::format("\"{}\" is no frame rate", printable(request.fps)),
        positive ? "" : "--fps takes a number above 0, or source for the keys' own times");
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

/// Reports joints that a clip animates although the rig drives them, and shear.
void report_clip(const BakeRequest& request, const anim::Clip& clip, const bake::Report& report,
                 std::size_t foreign, Diagnostics& diagnostics) {
  const Place place(request.file, fmt::format("/animations/{}", clip.source_animation));
  if (foreign > 0) {
    diagnostics.report(
        codes::kForeignChannels, place,
        fmt::format("{} channels of clip \"{}\" move joints that the rig drives; the controls win",
                    foreign, printable(clip.name)));
  }
  if (report.shear > kShearReported) {
    diagnostics.report(codes::kShear, place,
                       fmt::format("clip \"{}\": joints are sheared, by up to {:.2g} of their size",
                                   printable(clip.name), report.shear));
  }
}

/// Bakes one clip over every rig whose controls it animates.
std::optional<BakedClip> bake_clip(const BakeRequest& request, bake::Options options,
                                   const anim::Clip& clip, const std::vector<Bakeable>& rigs,
                                   std::vector<gltf::ClipChange>& changes,
                                   Diagnostics& diagnostics) {
  const trace::Span span("bake clip", trace::kStage, "clip", clip.name);
  BakedClip baked{clip.name, true, {}};
  anim::Clip out{clip.name, clip.source_animation, {}};
  std::set<int> controls, driven;
  for (const Bakeable& bakeable : rigs) {
    const bool concerned = std::any_of(
        clip.channels.begin(), clip.channels.end(),
        [&](const anim::Channel& channel) { return bakeable.controls.count(channel.node) != 0; });
    if (!concerned) continue;
    baked.passed_through = false;
    report_locked_keys(request.file, *bakeable.rig, clip, diagnostics);
    options.tolerance = request.tolerance_mm / 1000 * bakeable.rig->skeleton.character.unit;
    options.standings = bakeable.standings;
    options.controls_play = request.keep_rig;
    const auto joints = bake::bake(bakeable.rig->scene, bakeable.rig->nodes, clip, options,
                                   baked.report, diagnostics);
    if (!joints) return std::nullopt;
    out.channels.insert(out.channels.end(), joints->channels.begin(), joints->channels.end());
    controls.insert(bakeable.controls.begin(), bakeable.controls.end());
  }
  if (baked.passed_through) return baked;
  driven.insert(baked.report.driven.begin(), baked.report.driven.end());
  std::vector<int> dropped;
  std::size_t foreign = 0;
  for (const anim::Channel& channel : clip.channels) {
    const bool on_driven = driven.count(channel.node) != 0;
    foreign += on_driven && !channel.baked ? 1 : 0;
    const bool on_control = controls.count(channel.node) != 0 && !request.keep_rig;
    if (on_driven || on_control || channel.baked) dropped.push_back(channel.source_channel);
  }
  report_clip(request, clip, baked.report, foreign, diagnostics);
  // Where the rig stays, the next bake or update must know what it may make again.
  for (anim::Channel& channel : out.channels) channel.baked = request.keep_rig;
  changes.push_back({std::move(out), std::move(dropped)});
  return baked;
}

/// A clip that was not asked for loses what it keyed on controls that are gone.
void leave_out(const anim::Clip& clip, const std::set<int>& gone,
               std::vector<gltf::ClipChange>& changes) {
  std::vector<int> dropped;
  for (const anim::Channel& channel : clip.channels) {
    if (gone.count(channel.node)) dropped.push_back(channel.source_channel);
  }
  if (!dropped.empty())
    changes.push_back({{clip.name, clip.source_animation, {}}, std::move(dropped)});
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
  for (const gltf::Rig& rig : *rigs) check_evaluates(*file, rig, diagnostics);
  const auto clips = gltf::read_clips(*file, diagnostics);
  if (!clips || !diagnostics.ok()) return std::nullopt;
  const auto chosen = choose_clips(request, clips->clips, diagnostics);
  if (!chosen) return std::nullopt;

  const auto bakeable = look_at_rigs(*file, *rigs, diagnostics);
  if (!bakeable) return std::nullopt;

  Baked result;
  gltf::Patch patch(*file);
  std::vector<gltf::ClipChange> changes;
  std::set<int> gone;
  if (!request.keep_rig) gone = gltf::strip_rigs(patch, *file, *rigs);
  for (std::size_t i = 0; i < clips->clips.size(); ++i) {
    if (!chosen->count(i)) {
      leave_out(clips->clips[i], gone, changes);
      continue;
    }
    auto baked = bake_clip(request, *options, clips->clips[i], *bakeable, changes, diagnostics);
    if (!baked) return std::nullopt;
    result.clips.push_back(std::move(*baked));
  }
  gltf::write_clips(patch, *file, changes);
  if (!write_output(patch, *file, out, result.bytes, diagnostics)) return std::nullopt;
  return result;
}

}  // namespace rigc::pipeline
