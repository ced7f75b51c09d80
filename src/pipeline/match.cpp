// SPDX-License-Identifier: MIT
// Match a file. Test: tests/cli/match_test.cpp
#include "pipeline/match.h"

#include <fmt/format.h>

#include <algorithm>

#include "bake/rounded.h"
#include "base/text.h"
#include "base/trace.h"
#include "gltf/clips.h"
#include "gltf/rig.h"
#include "pipeline/build.h"
#include "pipeline/clip_choice.h"
#include "pipeline/codes.h"
#include "pipeline/match_codes.h"
#include "selector/selector.h"
#include "traversal/resolve.h"

namespace rigc::pipeline {
namespace {

/// Deviations above these are reported: parts of the character's height, degrees.
constexpr double kFar = 1e-4;
constexpr double kTurned = 0.1;

/// A limb of one of the rigs, or a control that changes its space.
struct Target {
  const gltf::Rig* rig;
  std::string name;
  bake::MatchLimb limb;
  std::optional<bake::SpaceSwitch> spaces;
  std::size_t space = 0;  ///< number of the one to follow
  std::set<int> keyable;  ///< nodes of its rig
};

struct Range {
  std::optional<double> start, end;
};

void refuse(const MatchRequest& request, std::string message, Diagnostics& diagnostics) {
  diagnostics.report(codes::kMatchRequest, Place(request.file), std::move(message));
}

/// `0.5:2`, `:2`, `0.5:` or nothing.
std::optional<Range> read_range(const MatchRequest& request, Diagnostics& diagnostics) {
  if (request.range.empty()) return Range{};
  const std::size_t colon = request.range.find(':');
  Range range;
  bool usable = colon != std::string::npos;
  const auto read = [&](const std::string& text, std::optional<double>& value) {
    if (text.empty()) return;
    value = parse_number(text);
    usable = usable && value && *value >= 0 && *value < 1e9;
  };
  if (usable) {
    read(request.range.substr(0, colon), range.start);
    read(request.range.substr(colon + 1), range.end);
  }
  if (usable && !(range.start && range.end && *range.start > *range.end)) return range;
  refuse(request, fmt::format("\"{}\" is no range of seconds", printable(request.range)),
         diagnostics);
  return std::nullopt;
}

std::vector<Target> choose_limbs(const MatchRequest& request, const std::vector<gltf::Rig>& rigs,
                                 Diagnostics& diagnostics) {
  std::vector<Target> all, chosen;
  std::vector<std::string> names;
  for (const gltf::Rig& rig : rigs)
    for (bake::MatchLimb& limb : bake::find_match_limbs(rig.scene)) {
      names.push_back(limb.name);
      all.push_back({&rig, limb.name, std::move(limb), {}, 0, {}});
    }
  const auto is_named = [](const std::string& name, const Target& target) {
    return name == "all" || name == target.limb.name;
  };
  for (const std::string& name : request.limbs) {
    if (std::any_of(all.begin(), all.end(), [&](const Target& t) { return is_named(name, t); }))
      continue;
    diagnostics.report(codes::kNoMatchLimb, Place(request.file),
                       fmt::format("there is no limb \"{}\" with FK and IK", printable(name)),
                       suggest(name, names));
  }
  for (Target& target : all)
    if (std::any_of(request.limbs.begin(), request.limbs.end(),
                    [&](const std::string& name) { return is_named(name, target); }))
      chosen.push_back(std::move(target));
  return chosen;
}

/// Controls that a text means: by the name of a node, or by a selector.
std::vector<Target> controls_of(const std::string& text, const std::vector<gltf::Rig>& rigs,
                                Diagnostics& diagnostics) {
  std::vector<Target> found;
  const auto add = [&](const gltf::Rig& rig, scene::NodeId id) {
    const scene::Node& node = rig.scene[id];
    if (node.kind != scene::Kind::control) return;
    found.push_back({&rig, node.name, {}, bake::find_spaces(rig.scene, id), 0, {}});
  };
  for (const gltf::Rig& rig : rigs)
    for (const scene::NodeId id : rig.scene.nodes())
      if (rig.scene[id].name == text) add(rig, id);
  if (!found.empty()) return found;
  const Span span{diagnostics.sources().add("--control", text), 1, 1,
                  static_cast<std::uint32_t>(text.size())};
  Diagnostics quiet;
  const auto selector = selector::parse(text, span, quiet);
  for (const gltf::Rig& rig : rigs) {
    if (!selector || rig.scene.size() == 0) continue;
    traversal::Index index;
    for (const scene::NodeId id : rig.scene.nodes()) index.added(rig.scene, id);
    const traversal::Context context{rig.scene, index, rig.skeleton.global, scene::NodeId{0}, {}};
    if (const auto nodes = traversal::resolve(*selector, context, quiet))
      for (const scene::NodeId id : nodes->nodes) add(rig, id);
  }
  return found;
}

std::vector<Target> choose_controls(const MatchRequest& request, const std::vector<gltf::Rig>& rigs,
                                    Diagnostics& diagnostics) {
  std::vector<Target> chosen;
  const auto refuse_space = [&](std::string message, std::string hint = {}) {
    diagnostics.report(codes::kNoMatchSpace, Place(request.file), std::move(message),
                       std::move(hint));
  };
  for (const std::string& text : request.controls) {
    std::vector<Target> found = controls_of(text, rigs, diagnostics);
    if (found.size() != 1) {
      refuse_space(fmt::format("\"{}\" is {} controls, not one", printable(text), found.size()));
      continue;
    }
    Target& target = found.front();
    if (!target.spaces) {
      refuse_space(fmt::format("control \"{}\" has no spaces", printable(target.name)));
      continue;
    }
    const std::vector<std::string>& names = target.spaces->spaces;
    const auto at = std::find(names.begin(), names.end(), request.space);
    target.space = static_cast<std::size_t>(at - names.begin());
    if (at == names.end())
      refuse_space(fmt::format("control \"{}\" has no space \"{}\"", printable(target.name),
                               printable(request.space)),
                   "it can follow " + join(names, ", "));
    chosen.push_back(std::move(target));
  }
  return chosen;
}

void report_off(const MatchRequest& request, const anim::Clip& clip, const MatchedLimb& limb,
                Diagnostics& diagnostics) {
  const Off& off = limb.at_keys;
  if (off.percent <= kFar * 100 && off.degrees <= kTurned) return;
  diagnostics.report(
      codes::kNotMatched, Place(request.file, fmt::format("/animations/{}", clip.source_animation)),
      fmt::format("clip \"{}\": {} is up to {} mm away (\"{}\") and turned by {} degrees (\"{}\")",
                  printable(clip.name), printable(limb.limb), short_number(off.mm),
                  printable(off.joint), short_number(off.degrees), printable(off.turned_joint)));
}

/// Channels of a clip that another has not: by their curves.
std::vector<anim::Channel> changed_channels(const anim::Clip& before, const anim::Clip& after) {
  std::vector<anim::Channel> changed;
  for (std::size_t i = 0; i < after.channels.size(); ++i) {
    const bool same = i < before.channels.size() &&
                      before.channels[i].curve.times == after.channels[i].curve.times;
    if (!same) changed.push_back(after.channels[i]);
  }
  return changed;
}

/// The part of a range that a clip has; nothing where it has none.
std::optional<Range> range_in(const MatchRequest& request, const Range& range,
                              const anim::Clip& clip, Diagnostics& diagnostics) {
  const double last = anim::last_time(clip);
  const Place place(request.file, fmt::format("/animations/{}", clip.source_animation));
  if (range.start && bake::rounded(*range.start) > last) {
    diagnostics.report(codes::kMatchRequest, place,
                       fmt::format("clip \"{}\" ends at {:.3g} seconds, before the range begins",
                                   printable(clip.name), last));
    return std::nullopt;
  }
  if (!range.end || bake::rounded(*range.end) <= last) return range;
  diagnostics.report(codes::kRangeClipped, place,
                     fmt::format("clip \"{}\" ends at {:.3g} seconds, before the range does",
                                 printable(clip.name), last));
  return Range{range.start, {}};
}

/// Targets of the rigs that a clip keys. With keys on another rig, a bake would make that one's
/// joints again too.
std::vector<Target> keyed_targets(const anim::Clip& clip, const std::vector<Target>& targets) {
  std::vector<Target> keyed;
  for (const Target& target : targets)
    if (keys_any(clip, target.keyable)) keyed.push_back(target);
  return keyed;
}

std::optional<anim::Clip> match_target(const MatchRequest& request, const Target& target,
                                       const bake::MatchTiming& when, const anim::Clip& now,
                                       const anim::Clip& timing, bake::MatchReport& report,
                                       Diagnostics& diagnostics) {
  const gltf::Rig& rig = *target.rig;
  bake::MatchTask task{rig.scene, rig.nodes, now, timing, when, 0, {}, {}, request.threads};
  task.tolerance = request.tolerance_mm / 1000 * rig.skeleton.character.unit;
  if (target.spaces) task.controls = {target.spaces->control};
  task.solve = [&](const bake::MatchOptions& options) {
    return target.spaces
               ? bake::solve_space(rig.scene, rig.nodes, now, *target.spaces, target.space, options,
                                   diagnostics)
               : bake::solve_match(rig.scene, rig.nodes, now, target.limb, options, diagnostics);
  };
  bake::MatchOptions options;
  options.to_ik = request.to == "ik";
  return bake::match_keys(task, options, report, diagnostics);
}

/// One limb after another: each sees the keys of those before.
std::optional<MatchedClip> match_clip(const MatchRequest& request, const Range& wanted, double fps,
                                      const anim::Clip& clip, const std::vector<Target>& targets,
                                      std::vector<gltf::ClipChange>& changes,
                                      Diagnostics& diagnostics) {
  const trace::Span span("match clip", trace::kStage, "clip", clip.name);
  MatchedClip out;
  out.name = clip.name;
  out.passed_through = targets.empty();
  if (out.passed_through) return out;
  const auto range = range_in(request, wanted, clip, diagnostics);
  if (!range) return std::nullopt;
  anim::Clip now = clip;
  const bake::MatchTiming when{fps, range->start, range->end};
  for (const Target& target : targets) {
    bake::MatchReport report;
    auto matched = match_target(request, target, when, now, clip, report, diagnostics);
    if (!matched) return std::nullopt;
    now = std::move(*matched);
    out.limbs.push_back({target.name, report, off_of(*target.rig, report.at_keys),
                         off_of(*target.rig, report.between)});
    report_off(request, clip, out.limbs.back(), diagnostics);
  }
  changes.push_back({{clip.name, clip.source_animation, changed_channels(clip, now)}, {}});
  return out;
}

/// Clips that are named must key what is matched, and of all at least one.
bool check_keyed(const MatchRequest& request, const std::vector<anim::Clip>& clips,
                 const std::set<std::size_t>& chosen, const std::vector<Target>& targets,
                 Diagnostics& diagnostics) {
  std::vector<const anim::Clip*> unkeyed;
  for (const std::size_t i : chosen)
    if (keyed_targets(clips[i], targets).empty()) unkeyed.push_back(&clips[i]);
  if (request.clips.empty() && unkeyed.size() < chosen.size()) return true;
  for (const anim::Clip* clip : unkeyed)
    diagnostics.report(codes::kNothingToMatch,
                       Place(request.file, fmt::format("/animations/{}", clip->source_animation)),
                       fmt::format("clip \"{}\" keys no control", printable(clip->name)),
                       "`rigc transfer` gives its motion to the controls");
  return diagnostics.ok();
}

bool check_request(const MatchRequest& request, Diagnostics& diagnostics) {
  const bool of_spaces = !request.space.empty() || !request.controls.empty();
  if (of_spaces && (request.space.empty() || request.controls.empty()))
    refuse(request, "--control and --space go together", diagnostics);
  else if (of_spaces && (!request.to.empty() || !request.limbs.empty()))
    refuse(request, "--space goes without --to and --limb", diagnostics);
  else if (!of_spaces && request.to.empty())
    refuse(request, "there is neither --to nor --space", diagnostics);
  else if (!of_spaces && request.to != "ik" && request.to != "fk")
    refuse(request, fmt::format("\"{}\" is neither ik nor fk", printable(request.to)), diagnostics);
  return diagnostics.ok();
}

}  // namespace

std::optional<MatchedFile> match_file(const MatchRequest& request, const std::string& out,
                                      Diagnostics& diagnostics) {
  const auto rate = read_rate(request.file, request.fps, {}, {}, diagnostics);
  const auto range = read_range(request, diagnostics);
  if (!rate || !range || !check_request(request, diagnostics) ||
      !check_tolerance(request.file, request.tolerance_mm, diagnostics) ||
      !check_output_name(out, diagnostics))
    return std::nullopt;
  const auto file = gltf::open(request.file, diagnostics);
  if (!file) return std::nullopt;
  const auto rigs = gltf::read_rigs(*file, diagnostics);
  if (!rigs) return std::nullopt;
  for (const gltf::Rig& rig : *rigs) check_evaluates(*file, rig, diagnostics);
  const auto clips = gltf::read_clips(*file, diagnostics);
  if (!clips || !diagnostics.ok()) return std::nullopt;
  if (clips->clips.empty()) refuse(request, "the file has no clip to match in", diagnostics);
  const auto chosen = choose_clips(request.file, request.clips, clips->clips, diagnostics);
  std::vector<Target> targets = request.space.empty()
                                    ? choose_limbs(request, *rigs, diagnostics)
                                    : choose_controls(request, *rigs, diagnostics);
  for (Target& target : targets) target.keyable = keyable_nodes(*target.rig);
  if (!chosen || !diagnostics.ok() ||
      !check_keyed(request, clips->clips, *chosen, targets, diagnostics))
    return std::nullopt;

  MatchedFile result;
  std::vector<gltf::ClipChange> changes;
  for (const std::size_t i : *chosen) {
    const anim::Clip& clip = clips->clips[i];
    auto one = match_clip(request, *range, *rate, clip, keyed_targets(clip, targets), changes,
                          diagnostics);
    if (!one) return std::nullopt;
    result.clips.push_back(std::move(*one));
  }
  if (!diagnostics.ok()) return std::nullopt;
  gltf::Patch patch(*file);
  gltf::write_clips(patch, *file, changes);
  if (!write_output(patch, *file, out, result.bytes, diagnostics)) return std::nullopt;
  return result;
}

}  // namespace rigc::pipeline
