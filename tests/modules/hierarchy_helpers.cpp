// SPDX-License-Identifier: MIT
// What models do to the hierarchy of a skeleton.
#include "modules/hierarchy_helpers.h"

#include <doctest/doctest.h>

#include "support/skeletons.h"

namespace rigc::test {
namespace {

using math::Affine;

int index_of(const tags::TaggedSkeleton& skeleton, const std::string& name) {
  if (name.empty()) return -1;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    if (skeleton.joints[j].name == name) return static_cast<int>(j);
  }
  FAIL("no joint " << name);
  return -1;
}

tags::TaggedJoint& joint_at(tags::TaggedSkeleton& skeleton, int index) {
  return skeleton.joints[static_cast<std::size_t>(index)];
}

bool is_below(const tags::TaggedSkeleton& skeleton, int joint, int above) {
  while (joint >= 0 && joint != above)
    joint = skeleton.joints[static_cast<std::size_t>(joint)].parent;
  return joint >= 0;
}

Affine times(const Affine& a, double scale) {
  return {{a.linear.x * scale, a.linear.y * scale, a.linear.z * scale}, a.origin};
}

}  // namespace

void rehang(tags::TaggedSkeleton& skeleton, const std::string& joint, const std::string& parent) {
  const int at = index_of(skeleton, joint), under = index_of(skeleton, parent);
  REQUIRE(under < at);
  const std::vector<Affine> places = worlds(skeleton);
  tags::TaggedJoint& moved = joint_at(skeleton, at);
  const int was = moved.parent;
  moved.parent = under;
  if (was >= 0 && !is_below(skeleton, at, was)) {
    moved.template_parent = joint_at(skeleton, was).key;
  }
  set_worlds(skeleton, places);
}

void flatten(tags::TaggedSkeleton& skeleton, const std::string& parent) {
  for (std::size_t j = 1; j < skeleton.joints.size(); ++j) {
    const std::string name = skeleton.joints[j].name;
    rehang(skeleton, name, parent);
  }
}

void put_between(tags::TaggedSkeleton& skeleton, const std::string& joint, double scale) {
  const int at = index_of(skeleton, joint);
  std::vector<Affine> places = worlds(skeleton);
  const tags::TaggedJoint& below = joint_at(skeleton, at);
  REQUIRE(below.parent >= 0);
  const Affine& upper = places[static_cast<std::size_t>(below.parent)];
  const Affine& lower = places[static_cast<std::size_t>(at)];

  Random random(hash64(joint));
  tags::TaggedJoint rider;
  rider.name = joint + "_twist_" + std::to_string(skeleton.joints.size());
  rider.key.uid = hash64(rider.name);
  rider.ids.global = skeleton.global;
  rider.parent = below.parent;
  Affine place = times(upper * math::rotation(random.rotation()), scale);
  place.origin =
      math::lerp(upper.origin, lower.origin, 0.4) + random.vector(0.02 * skeleton.character.height);
  for (tags::TaggedJoint& other : skeleton.joints) other.parent += other.parent >= at ? 1 : 0;
  skeleton.joints.insert(skeleton.joints.begin() + at, rider);
  places.insert(places.begin() + at, place);
  joint_at(skeleton, at + 1).parent = at;
  set_worlds(skeleton, places);
}

void scale_below(tags::TaggedSkeleton& skeleton, const std::string& joint, double scale) {
  const int above = index_of(skeleton, joint);
  std::vector<Affine> places = worlds(skeleton);
  for (std::size_t j = 0; j < places.size(); ++j) {
    if (is_below(skeleton, static_cast<int>(j), above)) places[j] = times(places[j], scale);
  }
  set_worlds(skeleton, places);
}

}  // namespace rigc::test
