// SPDX-License-Identifier: MIT
// Moved joints in a skeleton: placed by their template, or turned with their bones. Test:
// tests/templates/guides_test.cpp
#include <algorithm>
#include <set>

#include "templates/chain.h"
#include "templates/guides.h"

namespace rigc::templates {
namespace {

using math::Affine;
using math::Mat3;
using math::Vec3;

/// Cosine of the angle within which an axis of a joint lies along its bone.
constexpr double kAlong = 0.9999;
/// Sine of the angle by which a bone and the direction beside it differ at least.
constexpr double kBesideUp = 1e-4;

JointKey whole(JointKey key) {
  key.ordinal = 0;
  return key;
}

/// Joints, chains as one, whose `orient:` gives another orientation after the moves.
std::set<JointKey> turned_joints(const Expanded& expanded, const Moves& moves) {
  std::set<JointKey> moved, turned;
  for (const auto& [key, at] : moves) moved.insert(whole(key));
  const auto is_moved = [&](int joint) {
    return joint >= 0 && moved.count(expanded.joints[static_cast<std::size_t>(joint)].tagged.key);
  };
  const auto turn = [&](const ExpandedJoint& joint) {
    if (joint.placement.orient) turned.insert(joint.tagged.key);
  };
  for (const ExpandedJoint& joint : expanded.joints) {
    const bool self = moved.count(joint.tagged.key) != 0;
    if (self || is_moved(joint.toward)) turn(joint);
    if (self && joint.tagged.parent >= 0)
      turn(expanded.joints[static_cast<std::size_t>(joint.tagged.parent)]);
  }
  return turned;
}

}  // namespace

std::optional<tags::TaggedSkeleton> place(const Expanded& expanded,
                                          const tags::TaggedSkeleton& placed, const Moves& moves,
                                          Diagnostics& diagnostics) {
  const std::set<JointKey> turned = turned_joints(expanded, moves);
  // What hangs on what moves or turns is told its place, so that only what guides say goes along.
  Moves pinned = moves;
  std::vector<bool> below(placed.joints.size(), false);
  for (std::size_t i = 0; i < placed.joints.size(); ++i) {
    const tags::TaggedJoint& joint = placed.joints[i];
    if (joint.parent >= 0) {
      const auto parent = static_cast<std::size_t>(joint.parent);
      const JointKey& above = placed.joints[parent].key;
      below[i] = below[parent] || moves.count(above) != 0 || turned.count(whole(above)) != 0;
    }
    if (below[i]) pinned.emplace(joint.key, placed.world(i).origin);
  }
  return place_pinned(expanded, pinned, diagnostics);
}

namespace {

/// Turns the joints of a skeleton with their bones.
class Turner {
 public:
  Turner(tags::TaggedSkeleton& skeleton, const Moves& moves)
      : skeleton_(skeleton), moves_(moves), child_(skeleton.joints.size(), -1) {
    for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
      before_.push_back(skeleton.world(i));
      const int parent = skeleton.joints[i].parent;
      if (parent >= 0 && child_[static_cast<std::size_t>(parent)] < 0)
        child_[static_cast<std::size_t>(parent)] = static_cast<int>(i);
    }
  }
  void run();

 private:
  Vec3 moved_to(std::size_t joint) const;
  std::optional<Mat3> turn_of_bone(std::size_t joint) const;
  std::optional<Mat3> turn_of_aim(std::size_t joint) const;

  tags::TaggedSkeleton& skeleton_;
  const Moves& moves_;
  std::vector<Affine> before_;  ///< by joint
  std::vector<int> child_;      ///< by joint: the first
};

Vec3 Turner::moved_to(std::size_t joint) const {
  const auto found = moves_.find(skeleton_.joints[joint].key);
  return found == moves_.end() ? before_[joint].origin : to_rig(skeleton_.character, found->second);
}

/// How a joint turns that has an axis along its bone; the axis across stays as near as it can.
/// Nothing for others.
std::optional<Mat3> Turner::turn_of_bone(std::size_t joint) const {
  if (child_[joint] < 0 || skeleton_.joints[joint].foreign_node >= 0) return std::nullopt;
  const auto child = static_cast<std::size_t>(child_[joint]);
  const Vec3 was = before_[child].origin - before_[joint].origin;
  const Vec3 is = moved_to(child) - moved_to(joint);
  const double least = 1e-9 * skeleton_.character.height;
  if (!(length(was) > least) || !(length(is) > least)) return std::nullopt;
  const Mat3 axes = math::orthonormal(before_[joint].linear);
  const Vec3 along = normalised(was);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 axis = i == 0 ? axes.x : i == 1 ? axes.y : axes.z;
    const double cosine = dot(axis, along);
    if (cosine < kAlong && cosine > -kAlong) continue;
    if (was == is) return Mat3{};
    const Vec3 across = i == 2 ? axes.x : axes.z;
    return math::frame(normalised(is), across) * transposed(math::frame(along, across));
  }
  return std::nullopt;
}

/// How a joint turns whose template says what it aims at.
std::optional<Mat3> Turner::turn_of_aim(std::size_t joint) const {
  const tags::Guiding& guide = skeleton_.joints[joint].guide;
  const int at = guide.toward.uid != 0 ? skeleton_.find(guide.toward) : -1;
  if (at < 0) return std::nullopt;
  const auto target = static_cast<std::size_t>(at);
  const Vec3 was = before_[target].origin - before_[joint].origin;
  const Vec3 is = moved_to(target) - moved_to(joint);
  if (was == is) return Mat3{};
  const auto aims = [&](Vec3 bone) {
    const double size = length(bone);
    return size > 1e-9 * skeleton_.character.height &&
           length(cross(bone, guide.up)) > kBesideUp * size * length(guide.up);
  };
  if (!aims(was) || !aims(is)) return std::nullopt;
  return math::frame(normalised(is), guide.up) * transposed(math::frame(normalised(was), guide.up));
}

void Turner::run() {
  std::vector<Mat3> turns(before_.size());
  std::vector<Affine> after = before_;
  std::vector<bool> changed(before_.size(), false);
  for (std::size_t i = 0; i < before_.size(); ++i) {
    tags::TaggedJoint& joint = skeleton_.joints[i];
    const int parent = joint.parent;
    const auto above = static_cast<std::size_t>(std::max(parent, 0));
    const Mat3 carried = parent >= 0 && joint.foreign_node < 0 ? turns[above] : Mat3{};
    const auto own = skeleton_.aims ? turn_of_aim(i) : turn_of_bone(i);
    turns[i] = own.value_or(carried);
    const Vec3 to = moved_to(i);
    changed[i] = !(turns[i] == Mat3{}) || !(to == before_[i].origin);
    if (!changed[i] && (parent < 0 || !changed[above])) continue;
    after[i] = {turns[i] * before_[i].linear, to};
    joint.rest = tidy(decompose(parent < 0 ? after[i] : inverse(after[above]) * after[i]));
  }
}

}  // namespace

void move_joints(tags::TaggedSkeleton& skeleton, const Moves& moves) {
  if (!moves.empty()) Turner(skeleton, moves).run();
}

}  // namespace rigc::templates
