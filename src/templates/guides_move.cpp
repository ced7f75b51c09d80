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
  Mover(const Guides& guides, const Expanded* expanded, const tags::TaggedSkeleton& fitted,
        Diagnostics& diagnostics)
      : guides_(guides), expanded_(expanded), skeleton_(fitted), diagnostics_(diagnostics) {}
  std::optional<Guided> run();

 private:
  enum class State : std::uint8_t { unknown, open, known };
  /// What the file says of a joint.
  enum class Said : std::uint8_t { nothing, back, moved };

  void find_names();
  void find_rules();
  void find_chain(std::size_t first);
  int last_of_chain(int joint) const;
  void read_file();
  void read_guide(const Guide& guide, std::size_t joint);
  void mirror_file();
  void add_earlier();
  Vec3 mirrored(Vec3 way) const;
  bool is_same(Vec3 a, Vec3 b) const;
  int limb_base(std::size_t joint) const;
  bool in_same_limb(int a, std::size_t b) const;
  Vec3 way_of(int joint) { return joint < 0 ? Vec3{} : way(static_cast<std::size_t>(joint)); }
  Vec3 way(std::size_t joint);
  Vec3 carried(std::size_t joint);

  const Guides& guides_;
  const Expanded* expanded_;
  const tags::TaggedSkeleton& skeleton_;
  Diagnostics& diagnostics_;
  struct Rule {
    int first = -1, second = -1;  ///< joints that take it along
    double share = 0;
  };
  std::vector<std::string> own_names_;
  std::map<std::string, int> names_;        ///< every name of a joint; -1: of several
  std::vector<Vec3> base_;                  ///< by joint: where it was fitted, in the rig's space
  std::vector<Rule> rules_;                 ///< by joint
  std::vector<Said> said_;                  ///< by joint
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
  own_names_ = guide_names(skeleton_, expanded_);
  for (std::size_t i = 0; i < skeleton_.joints.size(); ++i) {
    const tags::TaggedJoint& joint = skeleton_.joints[i];
    const int number = joint.ids.local.empty() ? 0 : counts[joint.ids.local]++;
    if (own_names_[i].empty()) continue;
    add(to_text(joint.key), i);
    add(own_names_[i], i);
    if (!joint.ids.local.empty()) add(fmt::format("{}[{}]", joint.ids.local, number), i);
  }
}

/// The last joint of a chain; any other is its own.
int Mover::last_of_chain(int joint) const {
  JointKey key = skeleton_.joints[static_cast<std::size_t>(joint)].key;
  for (;;) {
    ++key.ordinal;
    const int next = skeleton_.find(key);
    if (next < 0) return joint;
    joint = next;
  }
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
  for (std::size_t i = 0; i < skeleton_.joints.size(); ++i) {
    const tags::Guiding& guide = skeleton_.joints[i].guide;
    if (guide.between[0].uid == 0) continue;
    const int first = skeleton_.find(guide.between[0]), second = skeleton_.find(guide.between[1]);
    if (first >= 0 && second >= 0) rules_[i] = {last_of_chain(first), second, guide.share};
  }
}

bool Mover::is_same(Vec3 a, Vec3 b) const {
  return is_same_place(to_template(skeleton_.character, a), to_template(skeleton_.character, b));
}

void Mover::read_guide(const Guide& guide, std::size_t joint) {
  const bool of_model = skeleton_.joints[joint].foreign_node >= 0;
  const Vec3 at = to_rig(skeleton_.character, guide.at);
  const bool stays = is_same(at, base_[joint]);
  if (!guide.moved() || (stays && (guide.fitted || of_model))) {
    said_[joint] = Said::back;
  } else if (of_model) {
    diagnostics_.report(codes::kGuideOfModel, guide.span,
                        fmt::format("{} is the model's own joint", printable(guide.name, 60)),
                        "take the line away: the joint stays where the model has it");
  } else {
    said_[joint] = Said::moved;
    edits_[joint] = stays ? Vec3{} : at - base_[joint];
  }
}

void Mover::read_file() {
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
    } else if (!seen.insert(found->second).second) {
      diagnostics_.report(
          codes::kGuideTwice, guide.span,
          fmt::format("{} is another name of a joint above", printable(guide.name, 60)),
          "keep one of them");
    } else {
      read_guide(guide, static_cast<std::size_t>(found->second));
    }
  }
}

/// To the other side of the character.
Vec3 Mover::mirrored(Vec3 way) const {
  const Vec3 left = skeleton_.character.left;
  return way - left * (2 * dot(left, way));
}

/// What is said of one side is said of the other, where nothing else is.
void Mover::mirror_file() {
  if (guides_.mirror == Guides::Mirror::none) return;
  const std::vector<Said> said = said_;
  for (std::size_t i = 0; i < said.size(); ++i) {
    const tags::Mirror& mirror = skeleton_.joints[i].mirror;
    const int other = mirror.opposite.uid != 0 ? skeleton_.find(mirror.opposite) : -1;
    if (said[i] == Said::nothing || other < 0) continue;
    const auto opposite = static_cast<std::size_t>(other);
    const Vec3 left = skeleton_.character.left;
    const bool is_left = dot(left, base_[i]) > dot(left, base_[opposite]);
    const bool wanted = guides_.mirror == Guides::Mirror::both ||
                        is_left == (guides_.mirror == Guides::Mirror::left_to_right);
    if (!wanted || said[opposite] >= said[i] || skeleton_.joints[opposite].foreign_node >= 0)
      continue;
    said_[opposite] = said[i];
    if (edits_[i]) edits_[opposite] = mirrored(*edits_[i]);
  }
}

/// What the file does not mention is as it was.
void Mover::add_earlier() {
  for (std::size_t i = 0; i < edits_.size(); ++i) {
    const tags::TaggedJoint& joint = skeleton_.joints[i];
    if (said_[i] == Said::nothing && joint.foreign_node < 0) edits_[i] = joint.guide.moved;
  }
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

std::optional<Guided> Mover::run() {
  const std::size_t errors_before = diagnostics_.errors();
  const std::size_t count = skeleton_.joints.size();
  for (std::size_t i = 0; i < count; ++i) base_.push_back(skeleton_.world(i).origin);
  edits_.resize(count);
  said_.resize(count, Said::nothing);
  find_names();
  find_rules();
  read_file();
  if (diagnostics_.errors() != errors_before) return std::nullopt;
  mirror_file();
  add_earlier();
  ways_.resize(count);
  states_.resize(count, State::unknown);
  Guided out;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 to = base_[i] + way(i);
    const tags::TaggedJoint& joint = skeleton_.joints[i];
    if (!is_same(to, base_[i])) out.places.emplace(joint.key, to_template(skeleton_.character, to));
    if (joint.guide.moved && !edits_[i]) out.put_back.push_back(own_names_[i]);
  }
  out.moved = std::move(edits_);
  return out;
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

std::optional<Guided> find_moves(const Guides& guides, const Expanded* expanded,
                                 const tags::TaggedSkeleton& fitted, Diagnostics& diagnostics) {
  return Mover(guides, expanded, fitted, diagnostics).run();
}

}  // namespace rigc::templates
