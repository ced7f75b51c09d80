// SPDX-License-Identifier: MIT
// Skeletons before guides. Test: tests/tags/fitted_test.cpp
#include "tags/fitted.h"

#include <algorithm>
#include <cmath>

namespace rigc::tags {
namespace {

/// The same but for rounding.
bool near(const math::Trs& a, const math::Trs& b) {
  constexpr double kRounding = 1e-12;
  const double turn =
      std::max({std::abs(a.rotation.x - b.rotation.x), std::abs(a.rotation.y - b.rotation.y),
                std::abs(a.rotation.z - b.rotation.z), std::abs(a.rotation.w - b.rotation.w)});
  return math::length(a.translation - b.translation) <= kRounding * math::length(b.translation) &&
         math::length(a.scale - b.scale) <= kRounding * math::length(b.scale) && turn <= kRounding;
}

}  // namespace

TaggedSkeleton as_fitted(TaggedSkeleton skeleton) {
  for (TaggedJoint& joint : skeleton.joints) {
    if (joint.guide.fitted) joint.rest = *joint.guide.fitted;
    joint.guide.fitted.reset();
  }
  return skeleton;
}

void note_fitted(TaggedSkeleton& skeleton, const TaggedSkeleton& fitted) {
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
    TaggedJoint& joint = skeleton.joints[i];
    const math::Trs& rest = fitted.joints[i].rest;
    joint.guide.fitted.reset();
    if (near(joint.rest, rest))
      joint.rest = rest;
    else
      joint.guide.fitted = rest;
  }
}

void settle(TaggedSkeleton& skeleton, const std::set<JointKey>& joints) {
  TaggedSkeleton fitted = as_fitted(skeleton);
  std::vector<math::Affine> now, before;  // by joint: where it stands, where it was fitted
  const auto below = [](const std::vector<math::Affine>& worlds, const TaggedJoint& joint) {
    const math::Affine local = math::compose(joint.rest);
    return joint.parent < 0 ? local : worlds[static_cast<std::size_t>(joint.parent)] * local;
  };
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
    TaggedJoint &joint = skeleton.joints[i], &base = fitted.joints[i];
    now.push_back(below(now, joint));
    if (joints.contains(joint.key)) {
      joint.guide.moved.reset();
      base.rest = joint.rest;
      const auto above = static_cast<std::size_t>(joint.parent < 0 ? 0 : joint.parent);
      if (joint.parent >= 0 && !(now[above] == before[above]))
        base.rest = math::decompose(inverse(before[above]) * now[i]);
    }
    before.push_back(below(before, base));
  }
  note_fitted(skeleton, fitted);
}

}  // namespace rigc::tags
