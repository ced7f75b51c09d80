// SPDX-License-Identifier: MIT
// Skeletons that guides moved: where they were fitted is not lost, whoever moves them then.
#include "tags/fitted.h"

#include <doctest/doctest.h>

using namespace rigc;
using namespace rigc::tags;
using math::Vec3;

namespace {

/// Three joints, one above the other, a metre each.
TaggedSkeleton tower() {
  TaggedSkeleton skeleton;
  for (int i = 0; i < 3; ++i) {
    TaggedJoint joint;
    joint.key.uid = static_cast<std::uint64_t>(i + 1);
    joint.parent = i - 1;
    joint.rest.translation = {0, 1, 0};
    skeleton.joints.push_back(joint);
  }
  return skeleton;
}

/// The middle one a metre to the left, by guides; the last stays where it is.
TaggedSkeleton bent() {
  TaggedSkeleton skeleton = tower();
  skeleton.joints[1].rest.translation = {1, 1, 0};
  skeleton.joints[1].guide.moved = Vec3{1, 0, 0};
  skeleton.joints[2].rest.translation = {-1, 1, 0};
  note_fitted(skeleton, tower());
  return skeleton;
}

}  // namespace

TEST_CASE("tags fitted: what guides moved says where it was") {
  const TaggedSkeleton skeleton = bent();
  CHECK_FALSE(skeleton.joints[0].guide.fitted);
  REQUIRE(skeleton.joints[1].guide.fitted);
  CHECK(skeleton.joints[2].guide.fitted);
  const TaggedSkeleton before = as_fitted(skeleton);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(before.joints[i].rest == tower().joints[i].rest);
    CHECK_FALSE(before.joints[i].guide.fitted);
  }
  CHECK(before.joints[1].guide.moved);
}

TEST_CASE("tags fitted: rounding is no move") {
  TaggedSkeleton skeleton = tower();
  skeleton.joints[1].rest.translation.y = 1 + 1e-15;
  note_fitted(skeleton, tower());
  CHECK_FALSE(skeleton.joints[1].guide.fitted);
  CHECK(skeleton.joints[1].rest == tower().joints[1].rest);
}

TEST_CASE("tags fitted: a joint that somebody places is fitted there, whatever it hangs on") {
  TaggedSkeleton skeleton = bent();
  skeleton.joints[2].rest.translation = {-1, 1, 0.5};
  settle(skeleton, {skeleton.joints[2].key});
  CHECK(as_fitted(skeleton).world(2).origin == skeleton.world(2).origin);
  CHECK(as_fitted(skeleton).world(1).origin == tower().world(1).origin);
  settle(skeleton, {skeleton.joints[1].key});
  CHECK_FALSE(skeleton.joints[1].guide.moved);
  CHECK_FALSE(skeleton.joints[1].guide.fitted);
}
