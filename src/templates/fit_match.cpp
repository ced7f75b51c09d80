// SPDX-License-Identifier: MIT
// Matching: bones for the joints that a map names, single joints first, then chains along the
// model's hierarchy. Test: tests/templates/fit_test.cpp
#include "templates/fit_match.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/text.h"
#include "templates/codes.h"

namespace rigc::templates {
namespace {

/// Who chooses first: a bone that two joints could be is the required one's, and a chain takes what
/// is left between its ends.
enum class Turn { required, optional, chains };

Turn turn_of(const ExpandedJoint& joint) {
  if (joint.chain) return Turn::chains;
  return joint.tagged.optional || joint.helper ? Turn::optional : Turn::required;
}

class Matcher {
 public:
  Matcher(const Expanded& expanded, const tags::ForeignSkeleton& model, const Map& map,
          FitReport& report, Diagnostics& diagnostics, const Bindings* known)
      : expanded_(expanded),
        model_(model),
        names_(map, model),
        report_(report),
        diagnostics_(diagnostics),
        known_(known),
        taken_(model.joints.size(), -1) {
    for (const MapEntry& entry : map.entries)
      entries_.emplace(std::pair(entry.local, entry.label), &entry);
    result_.bones.resize(expanded.joints.size());
    result_.made.resize(expanded.joints.size(), false);
  }
  std::optional<Matching> run();

 private:
  void take_known();
  void take_known(std::size_t index, const JointKey& key, const std::map<int, int>& bones);
  const MapEntry* entry_of(const ExpandedJoint& joint) const;
  int take(const std::vector<std::string>& one_of, std::size_t joint, bool* was_taken = nullptr);
  void match_joint(std::size_t index, const MapEntry& entry);
  void match_chain(std::size_t index, const MapEntry& entry);
  std::vector<int> path(int first, int last, std::size_t joint) const;
  void check_missing(std::size_t index);
  std::string free_below(std::size_t index) const;
  int misplaced_below(std::size_t index) const;
  void check_hierarchy();
  bool lies_between(std::size_t bone, std::size_t upper, std::size_t lower) const;
  void find_twists();
  void fill_report();
  std::string bone_name(int bone) const;

  const Expanded& expanded_;
  const tags::ForeignSkeleton& model_;
  BoneNames names_;
  FitReport& report_;
  Diagnostics& diagnostics_;
  const Bindings* known_;
  std::map<std::pair<std::string, std::string>, const MapEntry*> entries_;
  std::vector<int> taken_;  ///< for each bone: the expanded joint that has it, or -1
  std::set<int> twists_;
  Matching result_;
};

std::string Matcher::bone_name(int bone) const {
  const tags::ForeignJoint& joint = model_.joints[static_cast<std::size_t>(bone)];
  return joint.name.empty() ? fmt::format("node {}", joint.node) : printable(joint.name, 60);
}

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

/// The bones of a joint, or of a chain's joints, that had this key.
void Matcher::take_known(std::size_t index, const JointKey& key, const std::map<int, int>& bones) {
  if (result_.has(index) || result_.made[index]) return;
  JointKey at = key;
  for (;; ++at.ordinal) {
    const auto node = known_->nodes.find(at);
    const auto bone = node == known_->nodes.end() ? bones.end() : bones.find(node->second);
    if (bone == bones.end() || taken_[static_cast<std::size_t>(bone->second)] >= 0) break;
    taken_[static_cast<std::size_t>(bone->second)] = static_cast<int>(index);
    result_.bones[index].push_back(bone->second);
    if (!expanded_.joints[index].chain) break;
  }
  if (!result_.has(index) && known_->made.count(key)) result_.made[index] = true;
}

void Matcher::take_known() {
  std::map<int, int> bones;
  for (std::size_t i = 0; i < model_.joints.size(); ++i)
    bones.emplace(model_.joints[i].node, static_cast<int>(i));
  for (std::size_t i = 0; i < expanded_.joints.size(); ++i)
    take_known(i, expanded_.joints[i].tagged.key, bones);
  for (std::size_t i = 0; i < expanded_.joints.size(); ++i) {
    const std::vector<JointKey>& was = expanded_.joints[i].tagged.was;
    for (auto key = was.rbegin(); key != was.rend(); ++key) take_known(i, *key, bones);
  }
}

void Matcher::match_joint(std::size_t index, const MapEntry& entry) {
  bool was_taken = false;
  const int bone = take(entry.bones.front(), index, &was_taken);
  if (bone >= 0)
    result_.bones[index] = {bone};
  else if (was_taken && entry.bones.front().size() == 1)
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
  if (result_.has(index) || result_.made[index]) return;
  const MapEntry* entry = entry_of(joint);
  const bool absent = known_ || (entry && entry->absent);
  if (joint.helper || (absent && !joint.tagged.optional)) {
    result_.made[index] = true;
    report_.helpers.push_back(name);
    return;
  }
  if (joint.tagged.optional) {
    report_.dropped.push_back(name);
    return;
  }
  report_.missing.push_back(name);
  const Identifiers& ids = joint.tagged.ids;
  const std::string handle = ids.label.empty() ? ids.local : ids.local + "." + ids.label;
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
  std::string hint = fmt::format("looked for {}", printable(join(wanted, ", "), 200));
  for (const std::string& more : {suggest(first, names_.names()), free_below(index)})
    if (!more.empty()) hint += "; " + more;
  diagnostics_.report(
      codes::kMissingBone, joint.tagged.span,
      fmt::format("the model has no bone for {} ({})", name, handle),
      hint + "; `rigc map` writes a map to edit: a bone there, or ~ where the model has none");
}

/// Candidates: bones that nobody matched, directly below the bone of the joint above.
std::string Matcher::free_below(std::size_t index) const {
  int above = expanded_.joints[index].tagged.parent;
  while (above >= 0 && !result_.has(static_cast<std::size_t>(above)))
    above = expanded_.joints[static_cast<std::size_t>(above)].tagged.parent;
  if (above < 0) return {};
  const int upper = result_.bones[static_cast<std::size_t>(above)].back();
  std::vector<std::string> names;
  for (std::size_t i = 0; i < model_.joints.size(); ++i)
    if (taken_[i] < 0 && model_.joints[i].parent == upper)
      names.push_back(bone_name(static_cast<int>(i)));
  if (names.empty()) return {};
  return fmt::format("free below {}: {}", bone_name(upper), printable(join(names, ", "), 200));
}

/// The joint whose bone should be above this joint's bone, but is not; -1.
int Matcher::misplaced_below(std::size_t index) const {
  if (!result_.has(index)) return -1;
  int above = expanded_.joints[index].tagged.parent;
  while (above >= 0 && !result_.has(static_cast<std::size_t>(above)))
    above = expanded_.joints[static_cast<std::size_t>(above)].tagged.parent;
  if (above < 0) return -1;
  const std::vector<int>& upper = result_.bones[static_cast<std::size_t>(above)];
  const int bone = result_.bones[index].front();
  for (int at = bone; at >= 0; at = model_.joints[static_cast<std::size_t>(at)].parent)
    if (std::find(upper.begin(), upper.end(), at) != upper.end()) return -1;
  return above;
}

/// Warns once where bones do not hang below those of the joints above.
void Matcher::check_hierarchy() {
  std::vector<std::string> texts;
  Span first;
  for (std::size_t i = 0; i < expanded_.joints.size(); ++i) {
    const int above = misplaced_below(i);
    if (above < 0) continue;
    if (texts.empty()) first = expanded_.joints[i].tagged.span;
    const std::vector<int>& upper = result_.bones[static_cast<std::size_t>(above)];
    texts.push_back(fmt::format("{} ({}) not below {}", bone_name(result_.bones[i].front()),
                                expanded_.joints[i].tagged.name, bone_name(upper.back())));
  }
  if (texts.empty()) return;
  const std::size_t shown = std::min<std::size_t>(texts.size(), 4);
  const std::vector<std::string> some(texts.begin(), texts.begin() + static_cast<long>(shown));
  diagnostics_.report(
      codes::kHierarchyDiffers, first,
      fmt::format("{} bone{} hang otherwise than the template's joints: {}{}", texts.size(),
                  texts.size() == 1 ? "" : "s", join(some, ", "),
                  texts.size() > shown ? ", ..." : ""),
      "their controls follow the template's order; such a bone is moved as well as turned");
}

/// Bones that nobody matched between two joints of a limb, or beside them on the line: they roll
/// and twist with the upper joint.
void Matcher::find_twists() {
  for (std::size_t i = 0; i < expanded_.joints.size(); ++i) {
    const tags::TaggedJoint& joint = expanded_.joints[i].tagged;
    if (!result_.has(i) || joint.parent < 0 || misplaced_below(i) >= 0) continue;
    const auto above = static_cast<std::size_t>(joint.parent);
    const bool limb = result_.has(above) && !joint.ids.label.empty() &&
                      expanded_.joints[above].tagged.ids.local == joint.ids.local;
    if (!limb) continue;
    const int upper = result_.bones[above].back(), lower = result_.bones[i].front();
    for (int at = model_.joints[static_cast<std::size_t>(lower)].parent; at >= 0 && at != upper;
         at = model_.joints[static_cast<std::size_t>(at)].parent)
      twists_.insert(at);
    for (std::size_t bone = 0; bone < model_.joints.size(); ++bone)
      if (taken_[bone] < 0 && model_.joints[bone].parent == upper &&
          lies_between(bone, static_cast<std::size_t>(upper), static_cast<std::size_t>(lower)))
        twists_.insert(static_cast<int>(bone));
  }
  for (const int bone : twists_)
    report_.twists.push_back(model_.joints[static_cast<std::size_t>(bone)].name);
}

/// Whether a bone lies on the line from one bone to another, within a tenth of its length.
bool Matcher::lies_between(std::size_t bone, std::size_t upper, std::size_t lower) const {
  const math::Vec3 from = model_.joints[upper].rest.origin;
  const math::Vec3 along = model_.joints[lower].rest.origin - from;
  const math::Vec3 offset = model_.joints[bone].rest.origin - from;
  const double reach = length(along);
  const double share = reach > 0 ? dot(offset, along) / (reach * reach) : -1;
  return share > -0.05 && share < 0.95 && length(offset - along * share) < 0.1 * reach;
}

void Matcher::fill_report() {
  for (std::size_t i = 0; i < expanded_.joints.size(); ++i) {
    for (const int bone : result_.bones[i]) {
      const tags::ForeignJoint& joint = model_.joints[static_cast<std::size_t>(bone)];
      report_.matched.push_back({expanded_.joints[i].tagged.name, joint.name, joint.node});
    }
  }
  find_twists();
  for (std::size_t i = 0; i < model_.joints.size(); ++i)
    if (taken_[i] < 0 && model_.joints[i].in_skin && !twists_.count(static_cast<int>(i)))
      report_.extra.push_back(bone_name(static_cast<int>(i)));
}

std::optional<Matching> Matcher::run() {
  const std::size_t errors_before = diagnostics_.errors();
  if (known_) take_known();
  for (const Turn turn : {Turn::required, Turn::optional, Turn::chains}) {
    for (std::size_t i = 0; i < expanded_.joints.size(); ++i) {
      const MapEntry* entry = entry_of(expanded_.joints[i]);
      if (!entry || entry->bones.empty() || turn_of(expanded_.joints[i]) != turn) continue;
      if (result_.has(i) || result_.made[i]) continue;
      if (turn == Turn::chains)
        match_chain(i, *entry);
      else
        match_joint(i, *entry);
    }
  }
  for (std::size_t i = 0; i < expanded_.joints.size(); ++i) check_missing(i);
  check_hierarchy();
  fill_report();
  if (diagnostics_.errors() != errors_before) return std::nullopt;
  return std::move(result_);
}

}  // namespace

std::optional<Matching> match(const Expanded& expanded, const tags::ForeignSkeleton& model,
                              const Map& map, FitReport& report, Diagnostics& diagnostics,
                              const Bindings* known) {
  return Matcher(expanded, model, map, report, diagnostics, known).run();
}

}  // namespace rigc::templates
