// SPDX-License-Identifier: MIT
// A skeleton that was joined from several (`rigc merge --into`): one for each main template, and
// back. So each is updated from its own template. Test: tests/tags/mains_test.cpp
#pragma once

#include <utility>
#include <vector>

#include "tags/tags.h"

namespace rigc::tags {

/// The part of a skeleton that comes from one main template and its parts.
struct Main {
  /// Its joints and templates, with the rig's global group, features, shapes, pins and character.
  /// Roots rest in rig space.
  TaggedSkeleton skeleton;
  /// Of each root that hangs under a joint of another main: its key, and the keys of the joints
  /// above it, nearest first.
  std::vector<std::pair<JointKey, std::vector<JointKey>>> attached;
};

/// How many main templates there are; at least one.
std::size_t main_count(const TaggedSkeleton& skeleton);

/// In the order of their templates. A skeleton with one main template gives itself.
std::vector<Main> split_mains(const TaggedSkeleton& skeleton);

/// The first one's name and character, the joints of all. A root hangs under the first of the
/// joints above it that is there, by its key or an earlier one, and keeps its place in rig space;
/// without any it remains a root. Declarations are united by name, the earlier ones first.
TaggedSkeleton join_mains(const std::vector<Main>& mains);

}  // namespace rigc::tags
