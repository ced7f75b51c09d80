// SPDX-License-Identifier: MIT
// Joints by uid, and their placements. Test: tests/update/skeleton_test.cpp
#include "update/skeleton.h"

#include <algorithm>
#include <map>

#include "tags/fitted.h"

namespace rigc::update {
namespace {

using math::Affine;
using math::Vec3;
using tags::TaggedJoint;
using tags::TaggedSkeleton;

class Finder {
 public:
  explicit Finder(const TaggedSkeleton& old) : taken_(old.joints.size(), false) {
    for (std::size_t i = 0; i < old.joints.size(); ++i) by_key_.emplace(old.joints[i].key, i);
    for (std::size_t i = 0; i < old.joints.size(); ++i)
      for (const JointKey& was : old.joints[i].was) by_was_.emplace(was, i);
  }

  int take(const JointKey& key) { return take(by_key_, key); }
  int take_by_was(const TaggedJoint& joint) {
    for (auto was = joint.was.rbegin(); was != joint.was.rend(); ++was)
      if (const int found = take(by_key_, *was); found >= 0) return found;
    return take(by_was_, joint.key);
  }

 private:
  int take(const std::map<JointKey, std::size_t>& joints, const JointKey& key) {
    const auto found = joints.find(key);
    if (found == joints.end() || taken_[found->second]) return -1;
    taken_[found->second] = true;
    return static_cast<int>(found->second);
  }

  std::vector<bool> taken_;
  std::map<JointKey, std::size_t> by_key_, by_was_;
};

/// Joints of one chain, first to last.
using Run = std::vector<std::size_t>;

/// Chains are joints of one uid that hang under one another.
std::map<std::uint64_t, Run> chains(const TaggedSkeleton& skeleton) {
  std::map<std::uint64_t, Run> out;
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i)
    out[skeleton.joints[i].key.uid].push_back(i);
  return out;
}

class Keeper {
 public:
  Keeper(TaggedSkeleton& fresh, const TaggedSkeleton& old)
      : fresh_(fresh), old_(old), from_(counterparts(fresh, old)) {
    for (const TaggedJoint& joint : old.joints) {
      const Affine local = math::compose(joint.rest);
      old_worlds_.push_back(
          joint.parent < 0 ? local : old_worlds_[static_cast<std::size_t>(joint.parent)] * local);
    }
  }

  void run() {
    spread_chains();
    same_.assign(fresh_.joints.size(), false);
    for (std::size_t i = 0; i < fresh_.joints.size(); ++i) place(i);
    fresh_.character = old_.character;
  }

 private:
  const Affine& old_world(int joint) const { return old_worlds_[static_cast<std::size_t>(joint)]; }

  void place(std::size_t index) {
    TaggedJoint& joint = fresh_.joints[index];
    const bool root = joint.parent < 0;
    const auto parent = static_cast<std::size_t>(root ? 0 : joint.parent);
    const int from = from_[index];
    const auto spread = spread_.find(index);
    const bool keeps = spread == spread_.end() && from >= 0;
    const int before = keeps ? old_.joints[static_cast<std::size_t>(from)].parent : -1;
    if (keeps && (root ? before < 0 : same_[parent] && before == from_[parent])) {
      joint.rest = old_.joints[static_cast<std::size_t>(from)].rest;
    } else if (from >= 0 || spread != spread_.end()) {
      const Affine& world = spread != spread_.end() ? spread->second : old_world(from);
      const Affine below = root ? world : math::inverse(worlds_[parent]) * world;
      // The template's own numbers, where they say the same: they come back as they were.
      if (!near(math::compose(joint.rest), below)) joint.rest = math::decompose(below);
    }
    const Affine local = math::compose(joint.rest);
    worlds_.push_back(root ? local : worlds_[parent] * local);
    same_[index] = keeps && near(worlds_.back(), old_world(from));
  }

  /// The same but for rounding.
  bool near(const Affine& a, const Affine& b) const {
    const auto within = [](const Vec3& p, const Vec3& q, double size) {
      return math::length(p - q) <= 1e-12 * size;
    };
    const double size = std::max(old_.character.height, math::length(b.origin));
    return within(a.origin, b.origin, size) &&
           within(a.linear.x, b.linear.x, math::length(b.linear.x)) &&
           within(a.linear.y, b.linear.y, math::length(b.linear.y)) &&
           within(a.linear.z, b.linear.z, math::length(b.linear.z));
  }

  /// Worlds of the joints of chains that have become longer or shorter.
  void spread_chains() {
    const auto before = chains(old_);
    for (const auto& [uid, run] : chains(fresh_)) {
      const auto found = before.find(old_uid(run, uid));
      if (found == before.end() || found->second.size() == run.size()) continue;
      if (found->second.size() < 2 || run.size() < 2) continue;
      spread(run, found->second);
    }
  }

  std::uint64_t old_uid(const Run& run, std::uint64_t uid) const {
    const int from = from_[run.front()];
    return from < 0 ? uid : old_.joints[static_cast<std::size_t>(from)].key.uid;
  }

  void spread(const Run& run, const Run& before) {
    std::vector<double> lengths = {0};
    for (std::size_t i = 1; i < before.size(); ++i)
      lengths.push_back(lengths.back() +
                        math::length(position(before[i]) - position(before[i - 1])));
    std::size_t at = 0;
    for (std::size_t k = 0; k < run.size(); ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(run.size() - 1);
      const double wanted = share * lengths.back();
      while (at + 2 < lengths.size() && lengths[at + 1] <= wanted) ++at;
      const double segment = lengths[at + 1] - lengths[at];
      const double t = segment > 0 ? (wanted - lengths[at]) / segment : 0;
      const bool last = k + 1 == run.size();
      Affine world = old_worlds_[last ? before.back() : before[at]];
      if (!last) world.origin = math::lerp(position(before[at]), position(before[at + 1]), t);
      spread_[run[k]] = world;
    }
  }

  Vec3 position(std::size_t joint) const { return old_worlds_[joint].origin; }

  TaggedSkeleton& fresh_;
  const TaggedSkeleton& old_;
  std::vector<int> from_;
  std::vector<Affine> old_worlds_, worlds_;
  std::vector<bool> same_;  ///< by joint of `fresh`: it stands where it stood
  std::map<std::size_t, Affine> spread_;
};

}  // namespace

std::vector<int> counterparts(const TaggedSkeleton& fresh, const TaggedSkeleton& old) {
  Finder finder(old);
  std::vector<int> out;
  for (const TaggedJoint& joint : fresh.joints) out.push_back(finder.take(joint.key));
  for (std::size_t i = 0; i < fresh.joints.size(); ++i)
    if (out[i] < 0) out[i] = finder.take_by_was(fresh.joints[i]);
  return out;
}

void keep_placements(TaggedSkeleton& fresh, const TaggedSkeleton& old) {
  const std::vector<int> from = counterparts(fresh, old);
  bool guided = false;
  for (std::size_t i = 0; i < fresh.joints.size(); ++i) {
    if (from[i] < 0) continue;
    const tags::Guiding& guide = old.joints[static_cast<std::size_t>(from[i])].guide;
    fresh.joints[i].guide.moved = guide.moved;
    guided = guided || guide.fitted || guide.moved;
  }
  TaggedSkeleton fitted = fresh;
  Keeper(fresh, old).run();
  if (!guided) return;
  const TaggedSkeleton before = tags::as_fitted(old);
  Keeper(fitted, before).run();
  tags::note_fitted(fresh, fitted);
}

}  // namespace rigc::update
