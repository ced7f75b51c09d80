// SPDX-License-Identifier: MIT
// Detection: every map is tried on the skeleton as the fit would use it.
// Test: tests/templates/map_detect_test.cpp
#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "base/trace.h"
#include "templates/codes.h"
#include "templates/fit_match.h"

namespace rigc::templates {
namespace {

bool has_required(const Map& map, const tags::ForeignSkeleton& skeleton) {
  const auto there = [&](const std::string& pattern) {
    if (map.names == Map::Names::humanoid)
      return std::any_of(skeleton.humanoid.begin(), skeleton.humanoid.end(),
                         [&](const auto& bone) { return fits_pattern(bone.first, pattern); });
    return std::any_of(
        skeleton.joints.begin(), skeleton.joints.end(),
        [&](const tags::ForeignJoint& joint) { return fits_pattern(joint.name, pattern); });
  };
  for (const std::vector<std::string>& one_of : map.required)
    if (std::none_of(one_of.begin(), one_of.end(), there)) return false;
  return true;
}

/// Nothing where no bone matches, or one matches twice.
std::optional<MapTrial> try_map(const Map& map, const Expanded& expanded,
                                const tags::ForeignSkeleton& skeleton) {
  Diagnostics unheard;
  FitReport report;
  const bool fits = match(expanded, skeleton, map, report, unheard).has_value();
  if (report.matched.empty() || (!fits && report.missing.empty())) return std::nullopt;
  MapTrial trial;
  trial.map = &map;
  for (const FitReport::Match& found : report.matched)
    trial.matched.emplace_back(found.joint, found.node);
  for (const ExpandedJoint& joint : expanded.joints)
    trial.required += joint.tagged.optional || joint.helper ? 0 : 1;
  trial.missing = std::move(report.missing);
  return trial;
}

/// The humanoid table is the model's own word; names as they are say more than words.
int rank(Map::Names names) {
  return names == Map::Names::humanoid ? 0 : names == Map::Names::bones ? 1 : 2;
}

bool better(const MapTrial& a, const MapTrial& b) {
  if (a.missing.size() != b.missing.size()) return a.missing.size() < b.missing.size();
  const bool a_table = a.map->names == Map::Names::humanoid;
  const bool b_table = b.map->names == Map::Names::humanoid;
  if (a_table != b_table) return a_table;
  if (a.matched.size() != b.matched.size()) return a.matched.size() > b.matched.size();
  return rank(a.map->names) < rank(b.map->names);
}

std::string nearest_map(const MapTrial& trial) {
  constexpr std::size_t kMostNames = 12;
  std::vector<std::string> missing = trial.missing;
  if (missing.size() > kMostNames) {
    const std::size_t more = missing.size() - kMostNames;
    missing.resize(kMostNames);
    missing.push_back(fmt::format("{} more", more));
  }
  return fmt::format("{} comes nearest with {} of {} required joints; it finds no {}",
                     trial.map->name, trial.required - trial.missing.size(), trial.required,
                     join(missing, ", "));
}

}  // namespace

std::vector<MapTrial> try_maps(const std::vector<Map>& maps, const Expanded& expanded,
                               const tags::ForeignSkeleton& skeleton) {
  std::vector<MapTrial> trials;
  for (const Map& map : maps) {
    if (!has_required(map, skeleton)) continue;
    if (auto trial = try_map(map, expanded, skeleton)) trials.push_back(*std::move(trial));
  }
  std::stable_sort(trials.begin(), trials.end(), better);
  return trials;
}

std::optional<Map> detect_map(const Expanded& expanded, const tags::ForeignSkeleton& skeleton,
                              const std::vector<std::string>& template_folders,
                              Diagnostics& diagnostics) {
  const trace::Span span("match bones");
  const std::size_t errors_before = diagnostics.errors();
  const std::vector<Map> maps = all_maps(template_folders, diagnostics);
  if (diagnostics.errors() != errors_before) return std::nullopt;
  const std::vector<MapTrial> trials = try_maps(maps, expanded, skeleton);
  if (!trials.empty() && trials.front().missing.empty()) return *trials.front().map;
  std::vector<std::string> names;
  for (const Map& map : maps) names.push_back(map.name);
  std::string hint = trials.empty() ? "" : nearest_map(trials.front()) + "\n";
  hint += "`rigc map MODEL -o map.yaml` writes a first guess to edit; then add `--map map.yaml`";
  diagnostics.report(codes::kNoMapFits, Place(),
                     fmt::format("none of the maps fits the model's skeleton ({})",
                                 names.empty() ? "there are none" : join(names, ", ")),
                     hint);
  return std::nullopt;
}

}  // namespace rigc::templates
