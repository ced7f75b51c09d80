// SPDX-License-Identifier: MIT
// Template -> Expanded: parts joined, parameters put in, names, groups, selectors and uids made
// final, joints in order. Chains are still whole, so that place() and fit() can give them any
// count. Test: tests/templates/expand_test.cpp
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "templates/library.h"
#include "templates/template.h"

namespace rigc::templates {

/// One use of a template; instance 0 is the main one.
struct Instance {
  int outer = -1;    ///< the instance that holds the part
  std::string path;  ///< `arm_l/hand`; empty for the main template
  math::Vec3 at;     ///< origin in the outer instance's model space
  math::Quat rotation;
  double size = 1;
  std::optional<int> mirror;  ///< axis of the outer model space
};

struct ExpandedJoint {
  tags::TaggedJoint
      tagged;  ///< rest is not set; of a chain: its first joint; parent indexes Expanded::joints
  Placement placement;         ///< in the instance's model space
  std::optional<Chain> chain;  ///< its count is final
  bool helper = false;
  int toward = -1;    ///< the joint that `orient` aims at; -1: none
  int opposite = -1;  ///< index of the joint on the other side
  int instance = 0;
  std::size_t ordinal_in_template = 0;  ///< index into the joints of the instance's template
};

struct Expanded {
  tags::TaggedSkeleton skeleton;  ///< everything but joints and character
  std::vector<Instance> instances;
  std::vector<ExpandedJoint> joints;  ///< parents first, in document order
};

std::optional<Expanded> expand(const Template& main, Library& library,
                               const catalog::Catalogue& catalogue, Diagnostics& diagnostics);

/// The uid of a joint that has none written: from the template's name, the part's path (empty in
/// the main template) and the joint's name.
std::uint64_t uid_of(const std::string& template_name, const std::string& path,
                     const std::string& joint);

/// `elbow_l` for `elbow_r`, `LeftArm` is not understood; empty where no word names a side.
std::string other_side(std::string_view name);

/// The template's own skeleton, in its own proportions.
std::optional<tags::TaggedSkeleton> place(const Expanded& expanded, Diagnostics& diagnostics);

/// Places of joints by key, in the main template's model space, metres.
using Moves = std::map<JointKey, math::Vec3>;
/// The same with joints put elsewhere. Others are where they are written: `at` in model space,
/// `translate` below their parent. What `orient:` says is done for the places that come out.
std::optional<tags::TaggedSkeleton> place_pinned(const Expanded& expanded, const Moves& pinned,
                                                 Diagnostics& diagnostics);

}  // namespace rigc::templates
