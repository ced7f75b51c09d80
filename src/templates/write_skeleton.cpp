// SPDX-License-Identifier: MIT
// A tagged skeleton as the joints of a template. Test: tests/templates/write_test.cpp
#include "templates/write_skeleton.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/text.h"
#include "templates/chain.h"
#include "templates/expand.h"

namespace rigc::templates {
namespace {

using math::Affine;
using math::Mat3;

/// Whether a joint `head_neck_1` is a chain `neck` of one joint in the part `head`: its uid was
/// made from these words then, however they were split.
bool is_chain_of_one(const std::string& template_name, const tags::TaggedJoint& joint) {
  constexpr std::size_t kMostWords = 9;
  if (!ends_with(joint.name, "_1")) return false;
  const std::string name = joint.name.substr(0, joint.name.size() - 2);
  const auto words = split(name, '_');
  if (words.size() > kMostWords) return false;
  // Each `_` is one of a name, one between part and joint, or one between two parts.
  for (std::size_t end = 0; end < words.size(); ++end) {
    std::string own;
    for (std::size_t i = end; i < words.size(); ++i)
      own += (own.empty() ? "" : "_") + std::string(words[i]);
    const std::size_t ways = end < 2 ? 1 : std::size_t{1} << (end - 1);
    for (std::size_t way = 0; way < ways; ++way) {
      std::string path;
      for (std::size_t i = 0; i < end; ++i) {
        if (i > 0) path += way >> (i - 1) & 1 ? '/' : '_';
        path += words[i];
      }
      if (uid_of(template_name, path, own) == joint.key.uid) return true;
    }
  }
  return false;
}

class Writer {
 public:
  Writer(const tags::TaggedSkeleton& skeleton, const std::vector<Affine>& known)
      : skeleton_(skeleton), known_(known), fitted_(was_fitted(skeleton)) {}
  std::vector<WrittenJoint> run();

 private:
  bool is_written(const tags::TaggedJoint& joint) const;
  void find_places();
  void find_members();
  int parent_of(std::size_t joint) const;
  void add(std::size_t first);
  math::Trs rest_below(std::size_t joint, int above) const;
  std::string wanted_name(const tags::TaggedJoint& joint, bool chain) const;
  std::string free_name(std::string wanted);
  void pair_sides();

  const tags::TaggedSkeleton& skeleton_;
  const std::vector<Affine>& known_;
  const bool fitted_;
  std::vector<Affine> places_;                                 ///< by joint, template space
  std::map<std::uint64_t, std::vector<std::size_t>> members_;  ///< by uid, in order
  std::map<std::uint64_t, int> written_;                       ///< by uid
  std::map<JointKey, int> by_key_;
  std::set<std::string> names_;
  std::vector<WrittenJoint> out_;
};

/// A bone of the model that only hangs between or below the template's joints says nothing.
bool Writer::is_written(const tags::TaggedJoint& joint) const {
  return joint.foreign_node < 0 || !joint.ids.local.empty() || !joint.ids.label.empty() ||
         !joint.commands.empty();
}

/// A template has metres, Y up, and faces +Z; a model has what it has. Bones may be scaled, and
/// their lengths are in their places already.
void Writer::find_places() {
  const tags::Character& character = skeleton_.character;
  const Mat3 axes{character.left, character.up, character.forward};
  const Mat3 from_rig = math::inverse(axes);
  const Mat3 turn = math::transposed(
      math::orthonormal({character.left, character.up, cross(character.left, character.up)}));
  std::vector<Affine> worlds = known_;
  for (std::size_t i = 0; i < skeleton_.joints.size(); ++i) {
    const tags::TaggedJoint& joint = skeleton_.joints[i];
    const Affine own = math::compose(joint.rest);
    if (known_.empty())
      worlds.push_back(joint.parent < 0 ? own
                                        : worlds[static_cast<std::size_t>(joint.parent)] * own);
    Affine place = worlds[i];
    if (fitted_) {
      place.origin = from_rig * place.origin * (1 / character.unit);
      place.linear = turn * math::orthonormal(place.linear);
    }
    places_.push_back(place);
  }
}

void Writer::find_members() {
  for (std::size_t i = 0; i < skeleton_.joints.size(); ++i) {
    if (!is_written(skeleton_.joints[i])) continue;
    members_[skeleton_.joints[i].key.uid].push_back(i);
    by_key_.emplace(skeleton_.joints[i].key, static_cast<int>(i));
  }
  for (auto& [uid, joints] : members_)
    std::stable_sort(joints.begin(), joints.end(), [&](std::size_t a, std::size_t b) {
      return skeleton_.joints[a].key.ordinal < skeleton_.joints[b].key.ordinal;
    });
}

/// The joint that it hangs under in the template; -1: none.
int Writer::parent_of(std::size_t index) const {
  const tags::TaggedJoint& joint = skeleton_.joints[index];
  if (joint.template_parent.uid != 0) {
    const auto found = by_key_.find(joint.template_parent);
    if (found != by_key_.end()) return found->second;
  }
  int above = joint.parent;
  while (above >= 0 && !is_written(skeleton_.joints[static_cast<std::size_t>(above)]))
    above = skeleton_.joints[static_cast<std::size_t>(above)].parent;
  return above;
}

math::Trs Writer::rest_below(std::size_t joint, int above) const {
  if (!fitted_ && skeleton_.joints[joint].parent == above) return skeleton_.joints[joint].rest;
  const Affine place = above < 0
                           ? places_[joint]
                           : inverse(places_[static_cast<std::size_t>(above)]) * places_[joint];
  return tidy(math::decompose(place));
}

std::string Writer::wanted_name(const tags::TaggedJoint& joint, bool chain) const {
  std::string name = joint.name;
  if (joint.foreign_node >= 0) {  // the bone's
    const Identifiers& ids = joint.ids;
    const bool both = !ids.local.empty() && !ids.label.empty();
    name = both ? ids.local + "_" + ids.label : ids.local + ids.label;
    for (const std::string& own : {ids.label, ids.local})  // the template's name, if it is this
      if (uid_of(skeleton_.name, "", own) == joint.key.uid) name = own;
  } else if (chain && ends_with(name, "_1")) {
    name.resize(name.size() - 2);
  }
  for (char& c : name)
    if (!is_name(std::string("a") + c)) c = '_';
  return is_name(name) ? name : "joint_" + name.substr(0, 200);
}

std::string Writer::free_name(std::string wanted) {
  std::string name = wanted;
  for (int i = 2; !names_.insert(name).second; ++i) name = fmt::format("{}_{}", wanted, i);
  return name;
}

void Writer::add(std::size_t first) {
  const tags::TaggedJoint& joint = skeleton_.joints[first];
  const std::vector<std::size_t>& members = members_[joint.key.uid];
  WrittenJoint written;
  written.source = &joint;
  // Of a chain that found one bone, the missing label tells.
  written.chain = members.size() > 1 || (joint.foreign_node >= 0 && joint.ids.label.empty()) ||
                  (joint.foreign_node < 0 && is_chain_of_one(skeleton_.name, joint));
  written.name = free_name(wanted_name(joint, written.chain));
  written.helper = fitted_ && joint.foreign_node < 0;
  const int above = parent_of(first);
  int anchor = -1;  // of a chain, children hang on the last joint
  if (above >= 0) {
    const std::uint64_t uid = skeleton_.joints[static_cast<std::size_t>(above)].key.uid;
    const auto found = written_.find(uid);
    if (found != written_.end()) {
      written.parent = found->second;
      anchor = static_cast<int>(members_[uid].back());
    }
  }
  written.rest = rest_below(first, anchor);
  for (std::size_t i = 1; i < members.size(); ++i)
    written.steps.push_back(rest_below(members[i], static_cast<int>(members[i - 1])));
  written.end = places_[members.back()].origin;
  written_.emplace(joint.key.uid, static_cast<int>(out_.size()));
  out_.push_back(std::move(written));
}

void Writer::pair_sides() {
  std::map<std::string, int> by_name;
  for (std::size_t i = 0; i < out_.size(); ++i) {
    by_name.emplace(out_[i].name, static_cast<int>(i));
    const auto found = written_.find(out_[i].source->mirror.opposite.uid);
    if (found != written_.end()) out_[i].opposite = found->second;
  }
  const auto said = [&](std::size_t i) {
    const auto found = by_name.find(other_side(out_[i].name));
    return found == by_name.end() ? -1 : found->second;
  };
  for (std::size_t i = 0; i < out_.size(); ++i) {
    const int other = said(i);
    const bool mutual =
        other < 0 || out_[static_cast<std::size_t>(other)].opposite == static_cast<int>(i);
    out_[i].opposite_by_name = other == out_[i].opposite && mutual;
  }
}

/// Parents first, where the model has the order of the template turned round, too. Of a circle,
/// which only a hostile file has, one joint becomes a root.
std::vector<WrittenJoint> Writer::run() {
  find_places();
  find_members();
  std::vector<bool> seen(skeleton_.joints.size(), false);
  for (std::size_t start = 0; start < skeleton_.joints.size(); ++start) {
    if (!is_written(skeleton_.joints[start])) continue;
    std::vector<std::size_t> way;
    for (int at = static_cast<int>(start); at >= 0;) {
      const auto first = members_[skeleton_.joints[static_cast<std::size_t>(at)].key.uid].front();
      if (seen[first]) break;
      seen[first] = true;
      way.push_back(first);
      at = parent_of(first);
    }
    for (; !way.empty(); way.pop_back()) add(way.back());
  }
  pair_sides();
  return std::move(out_);
}

}  // namespace

bool was_fitted(const tags::TaggedSkeleton& skeleton) {
  return std::any_of(skeleton.joints.begin(), skeleton.joints.end(),
                     [](const tags::TaggedJoint& joint) { return joint.foreign_node >= 0; });
}

std::vector<WrittenJoint> written_joints(const tags::TaggedSkeleton& skeleton,
                                         const std::vector<Affine>& worlds) {
  return Writer(skeleton, worlds).run();
}

}  // namespace rigc::templates
