// SPDX-License-Identifier: MIT
// Look-ups in tagged skeletons. Test: tests/tags/tags_test.cpp
#include "tags/tags.h"

namespace rigc::tags {

const Literal* CommandTag::find(std::string_view argument) const {
  for (const Argument& candidate : with)
    if (candidate.name == argument) return &candidate.value;
  return nullptr;
}

math::Affine TaggedSkeleton::world(std::size_t joint) const {
  math::Affine result = math::compose(joints[joint].rest);
  for (int at = joints[joint].parent; at >= 0; at = joints[static_cast<std::size_t>(at)].parent)
    result = math::compose(joints[static_cast<std::size_t>(at)].rest) * result;
  return result;
}

int TaggedSkeleton::find(const JointKey& key) const {
  for (std::size_t i = 0; i < joints.size(); ++i)
    if (joints[i].key == key) return static_cast<int>(i);
  return -1;
}

}  // namespace rigc::tags
