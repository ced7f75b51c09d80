// SPDX-License-Identifier: MIT
// What commands on clips ask for. Test: tests/pipeline/transfer_test.cpp, tests/cli/cli_test.cpp
#include "pipeline/clip_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "pipeline/codes.h"

namespace rigc::pipeline {

std::optional<std::set<std::size_t>> choose_clips(const std::string& file,
                                                  const std::vector<std::string>& wanted,
                                                  const std::vector<anim::Clip>& clips,
                                                  Diagnostics& diagnostics) {
  std::set<std::size_t> chosen;
  std::vector<std::string> names;
  for (const anim::Clip& clip : clips) names.push_back(clip.name);
  for (const std::string& one : wanted) {
    const auto number = parse_integer(one);
    bool found = false;
    for (std::size_t i = 0; i < clips.size(); ++i) {
      if (clips[i].name != one && !(number && *number == static_cast<long long>(i))) continue;
      chosen.insert(i);
      found = true;
    }
    if (found) continue;
    diagnostics.report(codes::kNoSuchClip, Place(file),
                       fmt::format("there is no clip \"{}\"", printable(one)), suggest(one, names));
  }
  if (!diagnostics.ok()) return std::nullopt;
  for (std::size_t i = 0; wanted.empty() && i < clips.size(); ++i) chosen.insert(i);
  return chosen;
}

std::set<int> keyable_nodes(const gltf::Rig& rig) {
  std::set<int> keyable;
  for (const scene::NodeId id : rig.scene.nodes()) {
    const bool bone = rig.scene[id].kind == scene::Kind::joint;
    if (!bone && rig.nodes[id.index] >= 0) keyable.insert(rig.nodes[id.index]);
  }
  return keyable;
}

bool keys_any(const anim::Clip& clip, const std::set<int>& keyable) {
  return std::any_of(clip.channels.begin(), clip.channels.end(),
                     [&](const auto& channel) { return keyable.contains(channel.node); });
}

std::optional<double> read_rate(const std::string& file, const std::string& fps,
                                const std::optional<double>& start,
                                const std::optional<double>& end, Diagnostics& diagnostics) {
  const auto rate = fps == "source" ? std::optional<double>(0) : parse_number(fps);
  const bool usable = rate && (*rate > 0 || fps == "source") && *rate <= 10000;
  if (usable && !(start && end && *start > *end)) return rate;
  diagnostics.report(
      codes::kBadRange, Place(file),
      usable ? "--start lies after --end" : fmt::format("\"{}\" is no frame rate", printable(fps)),
      usable ? "" : "--fps takes a number above 0, or source for the keys' own times");
  return std::nullopt;
}

bool check_tolerance(const std::string& file, double mm, Diagnostics& diagnostics) {
  if (mm >= 0 && std::isfinite(mm)) return true;
  diagnostics.report(codes::kBadRange, Place(file),
                     fmt::format("a tolerance of {} mm is not possible", mm),
                     "--tolerance takes millimetres, 0 or more");
  return false;
}

std::optional<std::vector<bake::Standing>> bake_standings(const gltf::File& file,
                                                          const gltf::Rig& rig,
                                                          Diagnostics& diagnostics) {
  const auto standings = gltf::standings(file, rig, diagnostics);
  if (!standings) return std::nullopt;
  std::vector<bake::Standing> out;
  for (const gltf::Standing& s : *standings) out.push_back({s.base, s.between, s.local, s.points});
  return out;
}

}  // namespace rigc::pipeline
