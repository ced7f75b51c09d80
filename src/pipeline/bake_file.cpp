// SPDX-License-Identifier: MIT
// Bake a file. Test: tests/pipeline/bake_test.cpp
#include "pipeline/bake_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

#include "bake/joints.h"
#include "base/text.h"
#include "base/trace.h"
#include "gltf/clips.h"
#include "gltf/rig.h"
#include "gltf/slim.h"
#include "pipeline/bake_morphs.h"
#include "pipeline/build.h"
#include "pipeline/clip_choice.h"
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
  std::set<int> controls;  ///< glTF nodes that animators key
  std::vector<DrivenMorphs> morphs;
};

std::vector<Bakeable> look_at_rigs(const gltf::File& file, const gltf::Slim& slim,
                                   const std::vector<gltf::Rig>& rigs, Diagnostics& diagnostics) {
  std::vector<Bakeable> out;
  for (const gltf::Rig& rig : rigs) {
    Bakeable& bakeable = out.emplace_back();
    bakeable.rig = &rig;
    bakeable.morphs = find_driven_morphs(file, slim, rig, diagnostics);
    for (const gltf::Standing& s : gltf::standings(slim, rig))
      bakeable.standings.push_back({s.base, s.between, s.local, s.points});
    bakeable.controls = keyable_nodes(rig);
  }
  return out;
}

std::optional<bake::Options> read_options(const BakeRequest& request, Diagnostics& diagnostics) {
  bake::Options options;
  options.start = request.start;
  options.end = request.end;
  options.controls_play = request.keep_rig;
  options.threads = request.threads;
  const auto rate = read_rate(request.file, request.fps, request.start, request.end, diagnostics);
  if (!rate) return std::nullopt;
  options.fps = *rate;
  return options;
}

/// Reports joints that a clip animates although the rig drives them, and shear.
void report_clip(const BakeRequest& request, const anim::Clip& clip, const BakedClip& baked,
                 std::size_t foreign, Diagnostics& diagnostics) {
  const Place place(request.file, fmt::format("/animations/{}", clip.source_animation));
  if (foreign > 0) {
    diagnostics.report(
        codes::kForeignChannels, place,
        fmt::format("{} channels of clip \"{}\" move joints that the rig drives; the controls win",
                    foreign, printable(clip.name)));
  }
  if (baked.shear.relative > kShearReported) {
    diagnostics.report(
        codes::kShear, place,
        fmt::format(
            "clip \"{}\": joints are sheared; \"{}\" most, at {:.3f} seconds: points at the "
            "length of its limb are off by {:.2g} mm",
            printable(clip.name), printable(baked.shear.joint), baked.shear.seconds,
            baked.shear.mm));
  }
}

/// Adds what the bake of one rig says.
void add_report(const bake::Report& report, const gltf::Rig& rig, BakedClip& baked) {
  const double to_mm = 1000 / rig.skeleton.character.unit;
  baked.frames = std::max(baked.frames, report.frames);
  baked.channels += report.channels;
  baked.keys += report.keys;
  baked.reduction_mm = std::max(baked.reduction_mm, report.reduction_error * to_mm);
  baked.shear.relative = std::max(baked.shear.relative, report.shear.relative);
  if (report.shear.distance * to_mm <= baked.shear.mm) return;
  baked.shear.mm = report.shear.distance * to_mm;
  baked.shear.joint = rig.scene[report.shear.joint].name;
  baked.shear.seconds = report.shear.seconds;
}

/// How many channels, not made by a bake, say what the rig says of joints. What it does not drive
/// of a joint, as its scale, is evaluated with the rest.
std::size_t count_foreign(const gltf::Rig& rig, const anim::Clip& clip) {
  std::map<int, scene::NodeId> joints;
  for (const scene::NodeId id : rig.scene.nodes())
    if (rig.scene[id].kind == scene::Kind::joint) joints.emplace(rig.nodes[id.index], id);
  return static_cast<std::size_t>(
      std::count_if(clip.channels.begin(), clip.channels.end(), [&](const anim::Channel& channel) {
        const auto joint = joints.find(channel.node);
        return joint != joints.end() && channel.path <= anim::Path::scale && !channel.baked &&
               bake::is_driven(rig.scene, bake::plug_of(joint->second, channel.path));
      }));
}

/// What baking a clip gives, without anything being written.
struct ClipResult {
  bool good = false;
  std::size_t foreign = 0;  ///< channels that say what the rig says
  BakedClip baked;
  gltf::ClipChange change;             ///< empty where the clip passes through
  float end = 0;                       ///< seconds
  std::optional<anim::Channel> still;  ///< of a driven joint: plays what stands in the file
};

/// Time of the last key of a channel that is left or new; below 0 where there is none.
double end_of(const anim::Clip& clip, const gltf::ClipChange& change) {
  double end = -1;
  const auto look_at = [&](const anim::Channel& channel) {
    end = std::max(end, static_cast<double>(channel.curve.times->back()));
  };
  const std::set<int> dropped(change.dropped_channels.begin(), change.dropped_channels.end());
  for (const anim::Channel& channel : clip.channels)
    if (!dropped.contains(channel.source_channel)) look_at(channel);
  for (const anim::Channel& channel : change.clip.channels) look_at(channel);
  return end;
}

/// A channel with one key that says what stands in the file.
anim::Channel standing_channel(const Bakeable& bakeable, int node, float seconds) {
  const std::vector<int>& nodes = bakeable.rig->nodes;
  const auto id =
      static_cast<std::size_t>(std::find(nodes.begin(), nodes.end(), node) - nodes.begin());
  const math::Quat& q = bakeable.standings[id].local.rotation;
  anim::Channel channel;
  channel.node = node;
  channel.path = anim::Path::rotation;
  channel.curve.width = 4;
  channel.curve.times = std::make_shared<const std::vector<float>>(1, seconds);
  for (const double number : {q.x, q.y, q.z, q.w})
    channel.curve.values.push_back(static_cast<float>(number));
  return channel;
}

/// A last key that holds the value before it.
void hold_until(float seconds, anim::Curve& curve) {
  std::vector<float> times = *curve.times;
  const std::vector<float> last(curve.values.end() - curve.width, curve.values.end());
  times.push_back(seconds);
  curve.values.insert(curve.values.end(), last.begin(), last.end());
  curve.times = std::make_shared<const std::vector<float>>(std::move(times));
}

/// Bakes one clip over every rig whose controls it animates.
class ClipBaker {
 public:
  ClipBaker(const BakeRequest& request, const bake::Options& options, const gltf::File& file,
            const gltf::Slim& slim, const std::vector<Bakeable>& rigs)
      : request_(request), options_(options), file_(file), slim_(slim), rigs_(rigs) {}

  ClipResult bake(const anim::Clip& clip, Diagnostics& diagnostics) const {
    const trace::Span span("bake clip", trace::kStage, "clip", clip.name);
    ClipResult result;
    result.baked.name = clip.name;
    anim::Clip& out = result.change.clip;
    out = {clip.name, clip.source_animation, {}};
    std::set<int> controls, driven;
    for (const Bakeable& bakeable : rigs_) {
      if (!keys_any(clip, bakeable.controls)) continue;
      result.baked.passed_through = false;
      report_locked_keys(request_.file, *bakeable.rig, clip, diagnostics);
      if (!bake_rig(bakeable, clip, result, driven, diagnostics)) return {};
      controls.insert(bakeable.controls.begin(), bakeable.controls.end());
    }
    result.good = true;
    if (result.baked.passed_through) return result;
    drop_channels(clip, controls, driven, result.change);
    keep_length(clip, result);
    report_clip(request_, clip, result.baked, result.foreign, diagnostics);
    // Where the rig stays, the next bake or update must know what it may make again.
    for (anim::Channel& channel : out.channels) channel.baked = request_.keep_rig;
    return result;
  }

 private:
  bool bake_rig(const Bakeable& bakeable, const anim::Clip& clip, ClipResult& result,
                std::set<int>& driven, Diagnostics& diagnostics) const {
    const gltf::Rig& rig = *bakeable.rig;
    bake::Options options = options_;
    options.tolerance = request_.tolerance_mm / 1000 * rig.skeleton.character.unit;
    options.standings = bakeable.standings;
    bake::Report report;
    auto joints = bake::bake(rig.scene, rig.nodes, clip, options, report, diagnostics);
    if (!joints) return false;
    std::vector<anim::Channel>& channels = result.change.clip.channels;
    std::move(joints->channels.begin(), joints->channels.end(), std::back_inserter(channels));
    auto morphs = bake_morphs(file_, slim_, rig, bakeable.morphs, clip, report.times, diagnostics);
    if (!morphs) return false;
    report.channels += morphs->size();
    for (const anim::Channel& channel : *morphs) report.keys += channel.curve.times->size();
    std::move(morphs->begin(), morphs->end(), std::back_inserter(channels));
    driven.insert(report.driven.begin(), report.driven.end());
    if (!report.driven.empty() && !result.still)
      result.still = standing_channel(bakeable, report.driven.front(), report.times.front());
    result.end = report.times.back();
    result.foreign += count_foreign(rig, clip);
    add_report(report, rig, result.baked);
    return true;
  }

  /// A clip in which nothing moves, or nothing to the end, stays as long as it was.
  void keep_length(const anim::Clip& clip, ClipResult& result) const {
    std::vector<anim::Channel>& channels = result.change.clip.channels;
    if (!result.still || end_of(clip, result.change) >= static_cast<double>(result.end)) return;
    if (channels.empty()) {
      channels.push_back(*result.still);
      ++result.baked.channels;
      ++result.baked.keys;
    }
    if (channels.front().curve.times->back() >= result.end) return;
    hold_until(result.end, channels.front().curve);
    ++result.baked.keys;
  }

  void drop_channels(const anim::Clip& clip, const std::set<int>& controls,
                     const std::set<int>& driven, gltf::ClipChange& change) const {
    for (const anim::Channel& channel : clip.channels) {
      const bool on_driven = driven.count(channel.node) != 0;
      const bool on_control = controls.count(channel.node) != 0 && !request_.keep_rig;
      if (on_driven || on_control || channel.baked)
        change.dropped_channels.push_back(channel.source_channel);
    }
  }

  const BakeRequest& request_;
  const bake::Options& options_;
  const gltf::File& file_;
  const gltf::Slim& slim_;
  const std::vector<Bakeable>& rigs_;
};

/// Bakes the chosen clips, over threads. Diagnostics come in the order of the clips.
std::vector<ClipResult> bake_clips(const ClipBaker& baker, const std::vector<anim::Clip>& clips,
                                   const std::set<std::size_t>& chosen, Threads* threads,
                                   Diagnostics& diagnostics) {
  const std::vector<std::size_t> list(chosen.begin(), chosen.end());
  std::vector<ClipResult> results(clips.size());
  std::vector<Diagnostics> reported(list.size(), Diagnostics(diagnostics.sources()));
  Threads alone(1);
  (threads ? *threads : alone).for_each(list.size(), [&](std::size_t i) {
    Diagnostics own(diagnostics.sources());
    results[list[i]] = baker.bake(clips[list[i]], own);
    reported[i] = std::move(own);
  });
  for (const Diagnostics& one : reported) diagnostics.append(one);
  return results;
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
  const auto slim = gltf::read_slim(*file, diagnostics);
  if (!slim) return std::nullopt;
  const auto rigs = gltf::read_rigs(*file, diagnostics, gltf::Origins::templates, &*slim);
  if (!rigs) return std::nullopt;
  Baked result;
  if (rigs->empty()) {
    if (request.skip_without_rig) return result;
    diagnostics.report(codes::kNoRig, Place(request.file), "the file has no rig to bake");
    return std::nullopt;
  }
  result.has_rig = true;
  for (const gltf::Rig& rig : *rigs) check_evaluates(*file, rig, diagnostics);
  const auto clips = gltf::read_clips(*file, diagnostics, &*slim);
  if (!clips || !diagnostics.ok()) return std::nullopt;
  const auto chosen = choose_clips(request.file, request.clips, clips->clips, diagnostics);
  if (!chosen) return std::nullopt;

  const std::vector<Bakeable> bakeable = look_at_rigs(*file, *slim, *rigs, diagnostics);
  const ClipBaker baker(request, *options, *file, *slim, bakeable);
  std::vector<ClipResult> baked =
      bake_clips(baker, clips->clips, *chosen, request.threads, diagnostics);
  gltf::Patch patch(*file);
  std::vector<gltf::ClipChange> changes;
  std::set<int> gone;
  if (!request.keep_rig) gone = gltf::strip_rigs(patch, *file, *rigs);
  for (std::size_t i = 0; i < clips->clips.size(); ++i) {
    if (!chosen->count(i)) {
      leave_out(clips->clips[i], gone, changes);
      continue;
    }
    if (!baked[i].good) return std::nullopt;
    if (!baked[i].baked.passed_through) changes.push_back(std::move(baked[i].change));
    result.clips.push_back(std::move(baked[i].baked));
  }
  gltf::write_clips(patch, *file, changes);
  if (!write_output(patch, *file, out, result.bytes, diagnostics)) return std::nullopt;
  return result;
}

}  // namespace rigc::pipeline
