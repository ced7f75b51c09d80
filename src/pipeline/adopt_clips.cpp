// SPDX-License-Identifier: MIT
// Adopting clips: channels on controls that play otherwise than the original's.
// Test: tests/pipeline/adopt_test.cpp
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <tuple>

#include "base/text.h"
#include "pipeline/adopt_steps.h"
#include "pipeline/codes.h"

namespace rigc::pipeline {
namespace {

using anim::Channel;
using anim::Curve;
using anim::Path;

constexpr std::size_t kLongestName = 63;  // bytes; of Blender
constexpr double kMoment = 1e-4;          // seconds; where a step is, either side may be meant

using Sample = std::array<double, 4>;

Sample sample_at(const Channel& channel, double seconds) {
  Sample out{};
  anim::sample(channel.curve, channel.path == Path::rotation, seconds, out.data());
  return out;
}

bool is_constant(const Channel& channel, const Twin& twin) {
  const Sample first = sample_at(channel, channel.curve.times->front());
  return std::all_of(channel.curve.times->begin(), channel.curve.times->end(), [&](float time) {
    return same_value(twin, channel.path, sample_at(channel, time).data(), first.data());
  });
}

/// Rotations whose neighbours have the nearer signs: programs that interpolate the four numbers one
/// by one keep them so.
Curve aligned(Curve curve) {
  if (curve.interpolation == anim::Interpolation::cubic) return curve;
  for (std::size_t i = 4; i + 4 <= curve.values.size(); i += 4) {
    float dot = 0;
    for (std::size_t k = 0; k < 4; ++k) dot += curve.values[i + k] * curve.values[i + k - 4];
    for (std::size_t k = 0; k < 4 && dot < 0; ++k) curve.values[i + k] = -curve.values[i + k];
  }
  return curve;
}

/// Whether the original's curve gives every key of the edited one. What lies between the frames of
/// another program, and behind its last whole frame, it could not see.
bool plays_the_same(const Channel& edited, const Channel& original, const Twin& twin) {
  const bool rotation = edited.path == Path::rotation;
  const Curve by_numbers = rotation ? aligned(original.curve) : Curve();
  const auto gives = [&](const Sample& wanted, double seconds) {
    if (same_value(twin, edited.path, wanted.data(), sample_at(original, seconds).data()))
      return true;
    if (!rotation) return false;
    double q[4];
    anim::sample(by_numbers, false, seconds, q);
    const math::Quat unit = math::normalised(math::Quat{q[0], q[1], q[2], q[3]});
    return same_value(twin, edited.path, wanted.data(), &unit.x);
  };
  return std::all_of(edited.curve.times->begin(), edited.curve.times->end(), [&](float time) {
    const Sample wanted = sample_at(edited, time);
    return gives(wanted, time) || gives(wanted, time - kMoment) || gives(wanted, time + kMoment);
  });
}

/// What a node has where nothing is keyed.
Sample static_value(const gltf::Slim& slim, int node, Path path) {
  const math::Trs& local = slim.node(node).local;
  if (path == Path::rotation)
    return {local.rotation.x, local.rotation.y, local.rotation.z, local.rotation.w};
  const math::Vec3& v = path == Path::scale ? local.scale : local.translation;
  return {v.x, v.y, v.z, 0};
}

/// The name without the number that a program puts behind the second thing of one name.
std::string without_number(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  const bool numbered = dot != std::string::npos && name.size() - dot == 4 &&
                        std::all_of(name.begin() + static_cast<std::ptrdiff_t>(dot) + 1, name.end(),
                                    [](char c) { return c >= '0' && c <= '9'; });
  return numbered ? name.substr(0, dot) : name;
}

class Adopter {
 public:
  Adopter(const AdoptRequest& request, const Side& edited, const Side& original,
          const std::vector<Twin>& twins, std::set<Target>& keyed, Adopted& report,
          Diagnostics& diagnostics)
      : request_(request),
        edited_(edited),
        original_(original),
        keyed_(keyed),
        report_(report),
        diagnostics_(diagnostics) {
    for (const Twin& twin : twins)
      if (twin.is_control()) controls_.emplace(twin.edited, &twin);
  }

  std::optional<std::vector<gltf::ClipChange>> run();

 private:
  std::optional<std::vector<const anim::Clip*>> choose();
  std::vector<int> original_clips(const std::vector<const anim::Clip*>& clips) const;
  void find_keyed(const std::vector<const anim::Clip*>& clips);
  void adopt(const anim::Clip& clip, int index);
  bool only_holds(const Channel& channel, const Twin& twin) const;

  const AdoptRequest& request_;
  const Side& edited_;
  const Side& original_;
  std::set<Target>& keyed_;
  Adopted& report_;
  Diagnostics& diagnostics_;
  std::map<int, const Twin*> controls_;  ///< by node of the edited file
  std::vector<gltf::ClipChange> changes_;
};

std::optional<std::vector<const anim::Clip*>> Adopter::choose() {
  std::vector<const anim::Clip*> chosen;
  std::vector<std::string> names;
  for (const anim::Clip& clip : edited_.clips.clips) {
    names.push_back(clip.name);
    const bool wanted = request_.clips.empty() ||
                        std::count(request_.clips.begin(), request_.clips.end(), clip.name) != 0;
    if (wanted) chosen.push_back(&clip);
  }
  bool good = true;
  for (const std::string& wanted : request_.clips) {
    if (std::count(names.begin(), names.end(), wanted) != 0) continue;
    good = false;
    diagnostics_.report(codes::kNoSuchClip, Place(request_.edited),
                        fmt::format("there is no clip \"{}\"", printable(wanted)),
                        suggest(wanted, names));
  }
  if (!good) return std::nullopt;
  return chosen;
}

/// The clips of the original that the names mean: by the whole name, then as other programs change
/// names. Each is meant once; -1: none.
std::vector<int> Adopter::original_clips(const std::vector<const anim::Clip*>& clips) const {
  std::map<std::string, std::vector<int>> whole, changed;  // not yet meant, the last one first
  const auto changed_name = [](const std::string& name) {
    return without_number(name).substr(0, kLongestName);
  };
  for (std::size_t i = original_.clips.clips.size(); i-- > 0;)
    whole[original_.clips.clips[i].name].push_back(static_cast<int>(i));
  const auto take = [](std::map<std::string, std::vector<int>>& names, const std::string& name) {
    std::vector<int>& left = names[name];
    const int found = left.empty() ? -1 : left.back();
    if (!left.empty()) left.pop_back();
    return found;
  };
  std::vector<int> out;
  for (const anim::Clip* clip : clips) out.push_back(take(whole, clip->name));
  for (auto name = whole.rbegin(); name != whole.rend(); ++name)
    if (!name->first.empty())
      for (const int clip : name->second) changed[changed_name(name->first)].push_back(clip);
  for (std::size_t i = 0; i < clips.size(); ++i)
    if (out[i] < 0 && !clips[i]->name.empty()) out[i] = take(changed, changed_name(clips[i]->name));
  return out;
}

/// Transforms that some clip moves. A value that stands still in all clips is no animation.
void Adopter::find_keyed(const std::vector<const anim::Clip*>& clips) {
  for (const anim::Clip& clip : original_.clips.clips)
    for (const Channel& channel : clip.channels) keyed_.emplace(channel.node, channel.path);
  for (const anim::Clip* clip : clips) {
    for (const Channel& channel : clip->channels) {
      const auto twin = controls_.find(channel.node);
      if (twin == controls_.end() || channel.path == Path::attribute) continue;
      if (!is_constant(channel, *twin->second))
        keyed_.emplace(twin->second->original, channel.path);
    }
  }
}

/// Whether a channel says no more than what its control has unkeyed: before the edit, or, if
/// nothing moves it, after.
bool Adopter::only_holds(const Channel& channel, const Twin& twin) const {
  if (channel.path == Path::attribute || !is_constant(channel, twin)) return false;
  const Sample value = sample_at(channel, channel.curve.times->front());
  const Sample before = static_value(original_.slim, twin.original, channel.path);
  if (same_value(twin, channel.path, value.data(), before.data())) return true;
  const Sample after = static_value(edited_.slim, twin.edited, channel.path);
  return keyed_.count({twin.original, channel.path}) == 0 &&
         same_value(twin, channel.path, value.data(), after.data());
}

/// The channels of a clip by what they drive.
std::map<std::tuple<int, Path, std::string>, const Channel*> by_target(const anim::Clip* clip) {
  std::map<std::tuple<int, Path, std::string>, const Channel*> out;
  if (clip)
    for (const Channel& channel : clip->channels)
      out.emplace(std::tuple(channel.node, channel.path, channel.attribute), &channel);
  return out;
}

void Adopter::adopt(const anim::Clip& clip, int index) {
  AdoptedClip& report = report_.clips.emplace_back();
  report.fresh = index < 0;
  const anim::Clip* there =
      index < 0 ? nullptr : &original_.clips.clips[static_cast<std::size_t>(index)];
  report.name = there ? there->name : clip.name;
  anim::Clip out{report.name, index, {}};
  auto left = by_target(there);
  for (const Channel& channel : clip.channels) {
    const auto found = controls_.find(channel.node);
    if (found == controls_.end()) {
      ++report.not_controls;
      continue;
    }
    const Twin& twin = *found->second;
    const auto target = left.find({twin.original, channel.path, channel.attribute});
    const Channel* before = target == left.end() ? nullptr : target->second;
    if (before) left.erase(target);
    if (before && plays_the_same(channel, *before, twin)) {
      ++report.same;
    } else if (!before && only_holds(channel, twin)) {
      ++report.at_rest;
    } else {
      ++(before ? report.changed : report.added);
      if (channel.path != Path::attribute) keyed_.emplace(twin.original, channel.path);
      out.channels.push_back(channel);
      out.channels.back().node = twin.original;
    }
  }
  std::set<int> controls;
  for (const auto& [edited, twin] : controls_) controls.insert(twin->original);
  for (const auto& [target, channel] : left) report.kept += controls.count(channel->node);
  if (out.channels.empty())
    report.fresh = false;
  else
    changes_.push_back({std::move(out), {}});
}

std::optional<std::vector<gltf::ClipChange>> Adopter::run() {
  const auto clips = choose();
  if (!clips) return std::nullopt;
  find_keyed(*clips);
  const std::vector<int> indices = original_clips(*clips);
  for (std::size_t i = 0; i < clips->size(); ++i) adopt(*(*clips)[i], indices[i]);
  return std::move(changes_);
}

}  // namespace

std::optional<std::vector<gltf::ClipChange>> adopt_clips(const AdoptRequest& request,
                                                         const Side& edited, const Side& original,
                                                         const std::vector<Twin>& twins,
                                                         std::set<Target>& keyed, Adopted& report,
                                                         Diagnostics& diagnostics) {
  return Adopter(request, edited, original, twins, keyed, report, diagnostics).run();
}

}  // namespace rigc::pipeline
