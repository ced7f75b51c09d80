// SPDX-License-Identifier: MIT
// Matching: bones for the joints that a map names, single joints first, then chains along the
// model's hierarchy. Test: tests/templates/fit_test.cpp
#include "templates/fit_match.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/text.h"
#include "templates/codes.h"

namespace rigc::templates {
namespace {

class Matcher {
 public:
  Matcher(const Expanded& expanded, const tags::ForeignSkeleton& model, const Map& map,
          FitReport& report, Diagnostics& diagnostics)
      : expanded_(expanded),
        model_(model),
        names_(map, model),
        report_(report),
        diagnostics_(diagnostics),
        taken_(model.joints.size(), -1) {
    for (const MapEntry& entry : map.entries)
      entries_.emplace(std::pair(entry.local, entry.label), &entry);
    result_.bones.resize(expanded.joints.size());
  }
  std::optional<Matching> run();

 private:
  const MapEntry* entry_of(const ExpandedJoint& joint) const;
  int take(const std::vector<std::string>& one_of, std::size_t joint, bool* was_taken = nullptr);
  void match_joint(std::size_t index, const MapEntry& entry);
  void match_chain(std::size_t index, const MapEntry& entry);
  std::vector<int> path(int first, int last, std::size_t joint) const;
  void check_missing(std::size_t index);
  void check_hierarchy(std::size_t index);
  void fill_report();

  const Expanded& expanded_;
  const tags::ForeignSkeleton& model_;
  BoneNames names_;
  FitReport& report_;
  Diagnostics& diagnostics_;
  std::map<std::pair<std::string, std::string>, const MapEntry*> entries_;
  std::vector<int> taken_;  ///< for each bone: the expanded joint that has it, or -1
  Matching result_;
};

const MapEntry* Matcher::entry_of(const ExpandedJoint& joint) const {
  const Identifiers& ids = joint.tagged.ids;
  if (ids.label.empty() && !joint.chain) return nullptr;
  const auto found = entries_.find({ids.local, ids.label});
  return found == entries_.end() ? nullptr : found->second;
}

/// The first of the names that is there and still free; -1.
int Matcher::take(const std::vector<std::string>& one_of, std::size_t joint, bool* was_taken) {
  for (const std::string& name : one_of) {
    const int bone = names_.find(name);
    if (bone < 0) continue;
    int& owner = taken_[static_cast<std::size_t>(bone)];
    if (owner >= 0) {
      if (was_taken) *was_taken = true;
      continue;
    }
    owner = static_cast<int>(joint);
    return bone;
  }
  return -1;
}

void Matcher::match_joint(std::size_t index, const MapEntry& entry) {
  bool was_taken = false;
  const int bone = take(entry.bones.front(), index, &was_taken);
  if (bone >= 0)
    result_.bones[index] = {bone};
  else if (was_taken)
    diagnostics_.report(
        codes::kBoneTwice, entry.span,
        fmt::format("the bone for {} is another joint's already",
                    expanded_.joints[index].tagged.name),
        fmt::format("the map names {}", printable(join(entry.bones.front(), ", "), 200)));
}

/// From `first` down to `last`, without bones of other joints; empty where `last` does not hang
/// below `first`.
std::vector<int> Matcher::path(int first, int last, std::size_t joint) const {
  std::vector<int> bones;
  for (int at = last; at >= 0; at = model_.joints[static_cast<std::size_t>(at)].parent) {
    const int owner = taken_[static_cast<std::size_t>(at)];
    if (owner < 0 || owner == static_cast<int>(joint)) bones.push_back(at);
    if (at != first) continue;
    std::reverse(bones.begin(), bones.end());
    return bones;
  }
  return {};
}

void Matcher::match_chain(std::size_t index, const MapEntry& entry) {
  std::vector<int> found;
  for (const std::vector<std::string>& one_of : entry.bones) {
    // A labelled chain has its bones in one list, like the other names of a single joint.
    const bool listed = !entry.label.empty() && entry.bones.size() == 1;
    if (!listed) {
      if (const int bone = take(one_of, index); bone >= 0) found.push_back(bone);
      continue;
    }
    for (const std::string& name : one_of)
      if (const int bone = take({name}, index); bone >= 0) found.push_back(bone);
  }
  if (found.empty()) return;
  std::vector<int> along = path(found.front(), found.back(), index);
  if (along.empty()) along = found;
  for (const int bone : along) taken_[static_cast<std::size_t>(bone)] = static_cast<int>(index);
  result_.bones[index] = std::move(along);
}

void Matcher::check_missing(std::size_t index) {
  const ExpandedJoint& joint = expanded_.joints[index];
  const std::string& name = joint.tagged.name;
  if (result_.has(index)) return;
  if (joint.helper) return;
  if (joint.tagged.optional) {
    report_.dropped.push_back(name);
    return;
  }
  report_.missing.push_back(name);
  const Identifiers& ids = joint.tagged.ids;
  const std::string handle = ids.label.empty() ? ids.local : ids.local + "." + ids.label;
  const MapEntry* entry = entry_of(joint);
  if (!entry) {
    diagnostics_.report(codes::kNotInMap, joint.tagged.span,
                        fmt::format("the map {} does not say which bone {} ({}) is", report_.map,
                                    name, handle.empty() ? "no group or label" : handle),
                        "add it to the map, or make the joint `optional` or a `helper`");
    return;
  }
  std::vector<std::string> wanted;
  for (const std::vector<std::string>& one_of : entry->bones)
    wanted.insert(wanted.end(), one_of.begin(), one_of.end());
  const std::string first = wanted.empty() ? name : wanted.front();
  diagnostics_.report(codes::kMissingBone, joint.tagged.span,
                      fmt::format("the model has no bone for {} ({})", name, handle),
                      fmt::format("looked for {}; {}", printable(join(wanted, ", "), 200),
                                  suggest(first, names_.names())));
}

/// Warns where a bone does not hang below the bone of the joint above.
void Matcher::check_hierarchy(std::size_t index) {
  if (!result_.has(index)) return;
  int above = expanded_.joints[index].tagged.parent;
  while (above >= 0 && !result_.has(static_cast<std::size_t>(above)))
    above = expanded_.joints[static_cast<std::size_t>(above)].tagged.parent;
  if (above < 0) return;
  const std::vector<int>& upper = result_.bones[static_cast<std::size_t>(above)];
  const int bone = result_.bones[index].front();
  for (int at = bone; at >= 0; at = model_.joints[static_cast<std::size_t>(at)].parent)
    if (std::find(upper.begin(), upper.end(), at) != upper.end()) return;
  const auto name = [&](int joint) {
    return printable(model_.joints[static_cast<std::size_t>(joint)].name, 60);
  };
  diagnostics_.report(
      codes::kHierarchyDiffers, expanded_.joints[index].tagged.span,
      fmt::format("the bone {} does not hang below {}, as {} does below {}", name(bone),
                  name(upper.back()), expanded_.joints[index].tagged.name,
                  expanded_.joints[static_cast<std::size_t>(above)].tagged.name),
      "controls follow the joints' order, the model keeps its own");
}

void Matcher::fill_report() {
  for (std::size_t i = 0; i < expanded_.joints.size(); ++i) {
    for (const int bone : result_.bones[i]) {
      const tags::ForeignJoint& joint = model_.joints[static_cast<std::size_t>(bone)];
      report_.matched.push_back({expanded_.joints[i].tagged.name, joint.name, joint.node});
    }
    if (!result_.has(i) && expanded_.joints[i].helper)
      report_.helpers.push_back(expanded_.joints[i].tagged.name);
  }
  for (std::size_t i = 0; i < model_.joints.size(); ++i)
    if (taken_[i] < 0 && model_.joints[i].in_skin) report_.extra.push_back(model_.joints[i].name);
}

std::optional<Matching> Matcher::run() {
  const std::size_t errors_before = diagnostics_.errors();
  for (const bool chains : {false, true}) {
    for (std::size_t i = 0; i < expanded_.joints.size(); ++i) {
      const ExpandedJoint& joint = expanded_.joints[i];
      const MapEntry* entry = entry_of(joint);
      if (!entry || entry->bones.empty() || joint.chain.has_value() != chains) continue;
      if (chains)
        match_chain(i, *entry);
      else
        match_joint(i, *entry);
    }
  }
  for (std::size_t i = 0; i < expanded_.joints.size(); ++i) {
    check_missing(i);
    check_hierarchy(i);
  }
  fill_report();
  if (diagnostics_.errors() != errors_before) return std::nullopt;
  return std::move(result_);
}

}  // namespace

std::optional<Matching> match(const Expanded& expanded, const tags::ForeignSkeleton& model,
                              const Map& map, FitReport& report, Diagnostics& diagnostics) {
  return Matcher(expanded, model, map, report, diagnostics).run();
}

}  // namespace rigc::templates
