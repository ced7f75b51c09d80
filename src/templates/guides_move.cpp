// SPDX-License-Identifier: MIT
// What guides move: a rigger moves some joints, and others go along. Test:
// tests/templates/guides_test.cpp
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/text.h"
#include "templates/codes.h"
#include "templates/guides.h"

namespace rigc::templates {
namespace {

using math::Vec3;

class Mover {
 public:
  Mover(const Guides& guides, const Expanded* expanded, const tags::TaggedSkeleton& skeleton,
        Fitted fitted, Diagnostics& diagnostics)
      : guides_(guides),
        expanded_(expanded),
        skeleton_(skeleton),
        fitted_(fitted),
        diagnostics_(diagnostics) {}
  std::optional<Moves> run();

 private:
  enum class State : std::uint8_t { unknown, open, known };

  void find_names();
  void find_places();
  void find_rules();
  void find_chain(std::size_t first);
  void read_edits();
  void mirror_edits();
  int index_of(int expanded, bool last) const;
  int limb_base(std::size_t joint) const;
  bool in_same_limb(int a, std::size_t b) const;
  Vec3 way_of(int joint) { return joint < 0 ? Vec3{} : way(static_cast<std::size_t>(joint)); }
  Vec3 way(std::size_t joint);
  Vec3 carried(std::size_t joint);

  const Guides& guides_;
  const Expanded* expanded_;
  const tags::TaggedSkeleton& skeleton_;
  Fitted fitted_;
  Diagnostics& diagnostics_;
  struct Rule {
    int first = -1, second = -1;  ///< joints that take it along
    double share = 0;
  };
  std::map<std::string, int> names_;        ///< every name of a joint; -1: of several
  std::vector<Vec3> now_, base_;            ///< by joint: where it stands, where it was fitted
  std::vector<Rule> rules_;                 ///< by joint
  std::vector<std::optional<Vec3>> edits_;  ///< by joint: how far it was moved
  std::vector<Vec3> ways_;                  ///< by joint: how far it goes
  std::vector<State> states_;
};

void Mover::find_names() {
  const auto add = [&](const std::string& name, std::size_t joint) {
    const auto [other, fresh] = names_.emplace(name, static_cast<int>(joint));
    if (!fresh && other->second != static_cast<int>(joint)) other->second = -1;
  };
  std::map<std::string, int> counts;
  const std::vector<std::string> own = guide_names(skeleton_, expanded_);
  for (std::size_t i = 0; i < skeleton_.joints.size(); ++i) {
    const tags::TaggedJoint& joint = skeleton_.joints[i];
    const int number = joint.ids.local.empty() ? 0 : counts[joint.ids.local]++;
    if (own[i].empty()) continue;
    add(to_text(joint.key), i);
    add(own[i], i);
    if (!joint.ids.local.empty()) add(fmt::format("{}[{}]", joint.ids.local, number), i);
  }
}

void Mover::find_places() {
  for (std::size_t i = 0; i < skeleton_.joints.size(); ++i)
    now_.push_back(to_template(skeleton_.character, skeleton_.world(i).origin));
  base_ = now_;
}

/// In the skeleton: the last or first joint of a chain; -1 where the fit left it out.
int Mover::index_of(int expanded, bool last) const {
  JointKey key = expanded_->joints[static_cast<std::size_t>(expanded)].tagged.key;
  int found = skeleton_.find(key);
  while (last && found >= 0) {
    ++key.ordinal;
    const int next = skeleton_.find(key);
    if (next < 0) break;
    found = next;
  }
  return found;
}

/// The joints of a chain between its first and its last.
void Mover::find_chain(std::size_t first) {
  std::vector<std::size_t> chain{first};
  JointKey key = skeleton_.joints[first].key;
  for (;;) {
    ++key.ordinal;
    const int next = skeleton_.find(key);
    if (next < 0) break;
    chain.push_back(static_cast<std::size_t>(next));
  }
  for (std::size_t i = 1; i + 1 < chain.size(); ++i)
    rules_[chain[i]] = {static_cast<int>(first), static_cast<int>(chain.back()),
                        static_cast<double>(i) / static_cast<double>(chain.size() - 1)};
}

void Mover::find_rules() {
  rules_.resize(skeleton_.joints.size());
  for (std::size_t i = 0; i < skeleton_.joints.size(); ++i)
    if (skeleton_.joints[i].key.ordinal == 0) find_chain(i);
  if (!expanded_) return;
  for (const ExpandedJoint& joint : expanded_->joints) {
    const int own = skeleton_.find(joint.tagged.key);
    if (own < 0 || joint.between[0] < 0) continue;
    const Rule rule{index_of(joint.between[0], true), index_of(joint.between[1], false),
                    joint.share};
    if (rule.first >= 0 && rule.second >= 0) rules_[static_cast<std::size_t>(own)] = rule;
  }
}

void Mover::read_edits() {
  edits_.resize(skeleton_.joints.size());
  std::set<int> seen;
  std::vector<std::string> known;
  for (const auto& [name, joint] : names_)
    if (joint >= 0 && !parse_joint_key(name)) known.push_back(name);
  for (const Guide& guide : guides_.joints) {
    const auto found = names_.find(guide.name);
    if (found == names_.end() || found->second < 0) {
      if (!guide.moved()) continue;  // it lies over a template or a model that had the joint
      diagnostics_.report(codes::kUnknownGuide, guide.span,
                          fmt::format("there is no joint \"{}\"", printable(guide.name, 60)),
                          suggest(guide.name, known));
      continue;
    }
    const auto joint = static_cast<std::size_t>(found->second);
    if (!seen.insert(found->second).second) {
      diagnostics_.report(
          codes::kGuideTwice, guide.span,
          fmt::format("{} is another name of a joint above", printable(guide.name, 60)),
          "keep one of them");
      continue;
    }
    const bool of_model = skeleton_.joints[joint].foreign_node >= 0;
    if (fitted_ == Fitted::by_guides && guide.fitted && !of_model &&
        !is_same_place(*guide.fitted, now_[joint]))
      base_[joint] = *guide.fitted;
    if (!guide.moved() || is_same_place(guide.at, base_[joint])) continue;
    if (of_model)
      diagnostics_.report(codes::kGuideOfModel, guide.span,
                          fmt::format("{} is the model's own joint", printable(guide.name, 60)),
                          "take the line away: the joint stays where the model has it");
    else
      edits_[joint] = guide.at - base_[joint];
  }
}

/// Gives edits of one side to the other, where that has none of its own.
void Mover::mirror_edits() {
  if (guides_.mirror == Guides::Mirror::none) return;
  std::vector<std::optional<Vec3>> both = edits_;
  for (std::size_t i = 0; i < edits_.size(); ++i) {
    const tags::Mirror& mirror = skeleton_.joints[i].mirror;
    const int other = mirror.opposite.uid != 0 ? skeleton_.find(mirror.opposite) : -1;
    if (!edits_[i] || other < 0) continue;
    const auto opposite = static_cast<std::size_t>(other);
    const bool left = base_[i].x > base_[opposite].x;
    const bool wanted = guides_.mirror == Guides::Mirror::both ||
                        left == (guides_.mirror == Guides::Mirror::left_to_right);
    if (!wanted || edits_[opposite] || skeleton_.joints[opposite].foreign_node >= 0) continue;
    both[opposite] = Vec3{-edits_[i]->x, edits_[i]->y, edits_[i]->z};
  }
  edits_ = std::move(both);
}

bool Mover::in_same_limb(int a, std::size_t b) const {
  return a >= 0 &&
         skeleton_.joints[static_cast<std::size_t>(a)].ids.local == skeleton_.joints[b].ids.local;
}

/// The first joint of a limb, which owns it: the topmost that hangs together with `joint` in its
/// local group. Each finger of a hand has its own.
int Mover::limb_base(std::size_t joint) const {
  std::size_t at = joint;
  while (in_same_limb(skeleton_.joints[at].parent, joint))
    at = static_cast<std::size_t>(skeleton_.joints[at].parent);
  return static_cast<int>(at);
}

/// How far a joint goes that nobody moved.
Vec3 Mover::carried(std::size_t joint) {
  const Rule& rule = rules_[joint];
  if (rule.first >= 0) {
    const Vec3 first = way_of(rule.first);
    const Vec3 second = way_of(rule.second);
    return lerp(first, second, rule.share);
  }
  const tags::TaggedJoint& tagged = skeleton_.joints[joint];
  if (tagged.ids.local.empty()) return way_of(tagged.parent);
  const int base = limb_base(joint);
  return way_of(base == static_cast<int>(joint) ? tagged.parent : base);
}

Vec3 Mover::way(std::size_t joint) {
  State& state = states_[joint];
  if (state != State::unknown) return ways_[joint];  // of one that is open: none so far
  state = State::open;
  if (skeleton_.joints[joint].foreign_node < 0)
    ways_[joint] = edits_[joint] ? *edits_[joint] : carried(joint);
  state = State::known;
  return ways_[joint];
}

std::optional<Moves> Mover::run() {
  const std::size_t errors_before = diagnostics_.errors();
  find_names();
  find_places();
  find_rules();
  read_edits();
  if (diagnostics_.errors() != errors_before) return std::nullopt;
  mirror_edits();
  const std::size_t count = skeleton_.joints.size();
  ways_.resize(count);
  states_.resize(count, State::unknown);
  Moves moves;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 to = base_[i] + way(i);
    if (!is_same_place(to, now_[i])) moves.emplace(skeleton_.joints[i].key, to);
  }
  return moves;
}

}  // namespace

Vec3 to_template(const tags::Character& character, Vec3 rig) {
  const Vec3 metres{dot(character.left, rig), dot(character.up, rig), dot(character.forward, rig)};
  return metres * (1 / character.unit);
}

Vec3 to_rig(const tags::Character& character, Vec3 metres) {
  return (character.left * metres.x + character.up * metres.y + character.forward * metres.z) *
         character.unit;
}

std::vector<std::string> guide_names(const tags::TaggedSkeleton& skeleton,
                                     const Expanded* expanded) {
  std::map<JointKey, std::string> handles;
  if (expanded)
    for (const ExpandedJoint& joint : expanded->joints)
      handles.emplace(joint.tagged.key, joint.tagged.name);
  std::map<std::pair<std::string, std::string>, int> labels;
  for (const tags::TaggedJoint& joint : skeleton.joints)
    if (!joint.ids.label.empty()) ++labels[{joint.ids.local, joint.ids.label}];
  std::map<std::string, int> counts;
  std::vector<std::string> out;
  for (const tags::TaggedJoint& joint : skeleton.joints) {
    const Identifiers& ids = joint.ids;
    const int number = ids.local.empty() ? 0 : counts[ids.local]++;
    const auto handle = handles.find(joint.key);
    if (!ids.local.empty() && !ids.label.empty() && labels[{ids.local, ids.label}] == 1)
      out.push_back(ids.local + "." + ids.label);
    else if (!ids.local.empty())
      out.push_back(fmt::format("{}[{}]", ids.local, number));
    else if (handle != handles.end())
      out.push_back(handle->second);
    else
      out.push_back(joint.foreign_node >= 0 ? "" : to_text(joint.key));
  }
  return out;
}

std::optional<Moves> find_moves(const Guides& guides, const Expanded* expanded,
                                const tags::TaggedSkeleton& skeleton, Fitted fitted,
                                Diagnostics& diagnostics) {
  return Mover(guides, expanded, skeleton, fitted, diagnostics).run();
}

}  // namespace rigc::templates
