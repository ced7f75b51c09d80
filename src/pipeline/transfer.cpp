// SPDX-License-Identifier: MIT
// Transfer a file. Test: tests/pipeline/transfer_test.cpp
#include "pipeline/transfer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "base/trace.h"
#include "gltf/clips.h"
#include "gltf/rig.h"
#include "pipeline/build.h"
#include "pipeline/clip_choice.h"
#include "pipeline/codes.h"
#include "pipeline/locks.h"
#include "pipeline/transfer_codes.h"

namespace rigc::pipeline {
namespace {

/// Deviations above these are reported: parts of the character's height, degrees.
constexpr double kFar = 1e-4;
constexpr double kTurned = 0.1;

/// A rig, and what a transfer onto it needs to know.
struct Target {
  const gltf::Rig* rig;
  std::vector<bake::Standing> standings;
  std::vector<bake::Switch> found;
  std::vector<bake::SwitchValue> switches;  ///< what the request makes of them
};

std::optional<std::vector<Target>> look_at_rigs(const gltf::File& file,
                                                const std::vector<gltf::Rig>& rigs,
                                                Diagnostics& diagnostics) {
  std::vector<Target> targets;
  for (const gltf::Rig& rig : rigs) {
    auto standings = bake_standings(file, rig, diagnostics);
    if (!standings) return std::nullopt;
    auto found = bake::find_switches(rig.scene, diagnostics);
    targets.push_back({&rig, std::move(*standings), std::move(found), {}});
  }
  if (!diagnostics.ok()) return std::nullopt;
  return targets;
}

/// `arm_l=ik`.
struct Limb {
  std::string group;
  bool ik = false;
};

std::optional<Limb> parse_limb(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) return std::nullopt;
  const std::string kind = text.substr(equals + 1);
  if (kind != "ik" && kind != "fk") return std::nullopt;
  return Limb{text.substr(0, equals), kind == "ik"};
}

/// Later requests count more than earlier ones.
bool choose_switches(const TransferRequest& request, std::vector<Target>& targets,
                     Diagnostics& diagnostics) {
  std::vector<std::string> groups;
  for (Target& target : targets) {
    for (const bake::Switch& one : target.found) {
      target.switches.push_back({one.attribute, one.fk});
      groups.push_back(one.group);
    }
  }
  for (const std::string& text : request.limbs) {
    const auto limb = parse_limb(text);
    bool used = limb && limb->group == "all";
    for (Target& target : targets) {
      for (std::size_t i = 0; limb && i < target.found.size(); ++i) {
        const bake::Switch& one = target.found[i];
        if (limb->group != "all" && limb->group != one.group) continue;
        target.switches[i].value = limb->ik ? one.ik : one.fk;
        used = true;
      }
    }
    if (used) continue;
    diagnostics.report(
        codes::kNoSuchLimb, Place(request.file),
        limb ? fmt::format("no limb of group \"{}\" has a switch", printable(limb->group))
             : fmt::format("\"{}\" is not GROUP=ik or GROUP=fk", printable(text)),
        limb ? suggest(limb->group, groups) : "");
  }
  return diagnostics.ok();
}

std::vector<TransferredLimb> limbs_of(const std::vector<Target>& targets) {
  std::vector<TransferredLimb> limbs;
  for (const Target& target : targets)
    for (std::size_t i = 0; i < target.found.size(); ++i)
      limbs.push_back({target.found[i].group, target.switches[i].value == target.found[i].ik});
  return limbs;
}

}  // namespace

Off off_of(const gltf::Rig& rig, const bake::Deviation& deviation) {
  Off off;
  const tags::Character& character = rig.skeleton.character;
  off.mm = deviation.distance / character.unit * 1000;
  off.percent = deviation.distance / character.height * 100;
  off.degrees = math::degrees(deviation.angle);
  off.seconds = deviation.farthest_at;
  off.turned_seconds = deviation.most_turned_at;
  if (deviation.farthest.valid()) off.joint = rig.scene[deviation.farthest].name;
  if (deviation.most_turned.valid()) off.turned_joint = rig.scene[deviation.most_turned].name;
  return off;
}

namespace {

void keep_larger(Off& off, const Off& other) {
  if (other.percent > off.percent || off.joint.empty()) {
    off.mm = other.mm;
    off.percent = other.percent;
    off.joint = other.joint;
    off.seconds = other.seconds;
  }
  if (other.degrees > off.degrees || off.turned_joint.empty()) {
    off.degrees = other.degrees;
    off.turned_joint = other.turned_joint;
    off.turned_seconds = other.turned_seconds;
  }
}

void report_off(const TransferRequest& request, const anim::Clip& clip, const Off& off,
                Diagnostics& diagnostics) {
  std::string what;
  if (off.percent > kFar * 100)
    what = fmt::format("\"{}\" is up to {} mm ({} % of height) away", printable(off.joint),
                       short_number(off.mm), short_number(off.percent));
  if (off.degrees > kTurned)
    what += fmt::format("{}\"{}\" is turned by up to {} degrees", what.empty() ? "" : ", ",
                        printable(off.turned_joint), short_number(off.degrees));
  if (what.empty()) return;
  diagnostics.report(request.strict ? codes::kNotReachedStrictly : codes::kNotReached,
                     Place(request.file, fmt::format("/animations/{}", clip.source_animation)),
                     fmt::format("clip \"{}\": joint {}", printable(clip.name), what));
}

void report_replaced(const TransferRequest& request, const gltf::Rig& rig, const anim::Clip& clip,
                     const std::vector<scene::NodeId>& controls, Diagnostics& diagnostics) {
  if (controls.empty()) return;
  const std::string& first = rig.scene[controls.front()].name;
  diagnostics.report(codes::kReplacedKeys,
                     Place(request.file, fmt::format("/animations/{}", clip.source_animation)),
                     fmt::format("clip \"{}\": keys on {} control{}, \"{}\" first, are replaced",
                                 printable(clip.name), controls.size(),
                                 controls.size() == 1 ? "" : "s", printable(first)));
}

void add_report(const bake::TransferReport& one, bake::TransferReport& sum) {
  sum.joints += one.joints;
  sum.frames = std::max(sum.frames, one.frames);
  sum.inserted = std::max(sum.inserted, one.inserted);
  sum.controls += one.controls;
  sum.channels += one.channels;
  sum.keys += one.keys;
}

/// One clip onto every rig whose joints it animates.
std::optional<TransferredClip> transfer_clip(const TransferRequest& request,
                                             const bake::TransferOptions& wanted,
                                             const anim::Clip& clip,
                                             const std::vector<Target>& targets,
                                             std::vector<gltf::ClipChange>& changes,
                                             Diagnostics& diagnostics) {
  const trace::Span span("transfer clip", trace::kStage, "clip", clip.name);
  TransferredClip out;
  out.name = clip.name;
  gltf::ClipChange change{{clip.name, clip.source_animation, {}}, {}};
  for (const Target& target : targets) {
    bake::TransferOptions options = wanted;
    options.standings = target.standings;
    options.switches = target.switches;
    options.tolerance = request.tolerance_mm / 1000 * target.rig->skeleton.character.unit;
    bake::TransferReport report;
    auto one =
        bake::transfer(target.rig->scene, target.rig->nodes, clip, options, report, diagnostics);
    if (!one) return std::nullopt;
    if (report.joints == 0) continue;
    add_report(report, out.report);
    for (const scene::NodeId id : report.kept) out.kept.push_back(target.rig->scene[id].name);
    for (const scene::NodeId id : report.untouched)
      out.untouched.push_back(target.rig->scene[id].name);
    keep_larger(out.at_keys, off_of(*target.rig, report.at_keys));
    keep_larger(out.between, off_of(*target.rig, report.between));
    report_replaced(request, *target.rig, clip, report.replaced, diagnostics);
    report_locked_keys(request.file, *target.rig, one->clip, diagnostics);
    auto& channels = change.clip.channels;
    channels.insert(channels.end(), one->clip.channels.begin(), one->clip.channels.end());
    change.dropped_channels.insert(change.dropped_channels.end(), one->dropped.begin(),
                                   one->dropped.end());
  }
  out.passed_through = out.report.joints == 0;
  if (out.passed_through) return out;
  report_off(request, clip, out.at_keys, diagnostics);
  changes.push_back(std::move(change));
  return out;
}

}  // namespace

std::string short_number(double x) {
  return std::abs(x) < 100 ? fmt::format("{:.2g}", x) : fmt::format("{:.0f}", x);
}

std::optional<TransferredFile> transfer_file(const TransferRequest& request, const std::string& out,
                                             Diagnostics& diagnostics) {
  const auto rate = read_rate(request.file, request.fps, request.start, request.end, diagnostics);
  if (!rate || !check_tolerance(request.file, request.tolerance_mm, diagnostics) ||
      !check_output_name(out, diagnostics))
    return std::nullopt;
  const auto file = gltf::open(request.file, diagnostics);
  if (!file) return std::nullopt;
  const auto rigs = gltf::read_rigs(*file, diagnostics);
  if (!rigs) return std::nullopt;
  if (rigs->empty()) {
    diagnostics.report(codes::kNoRig, Place(request.file),
                       "the file has no rig to transfer clips to");
    return std::nullopt;
  }
  for (const gltf::Rig& rig : *rigs) check_evaluates(*file, rig, diagnostics);
  const auto clips = gltf::read_clips(*file, diagnostics);
  if (!clips || !diagnostics.ok()) return std::nullopt;
  const auto chosen = choose_clips(request.file, request.clips, clips->clips, diagnostics);
  if (!chosen) return std::nullopt;
  auto targets = look_at_rigs(*file, *rigs, diagnostics);
  if (!targets || !choose_switches(request, *targets, diagnostics)) return std::nullopt;

  bake::TransferOptions options;
  options.fps = *rate;
  options.start = request.start;
  options.end = request.end;
  options.threads = request.threads;
  TransferredFile result;
  result.limbs = limbs_of(*targets);
  std::vector<gltf::ClipChange> changes;
  for (const std::size_t i : *chosen) {
    auto one = transfer_clip(request, options, clips->clips[i], *targets, changes, diagnostics);
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
