// SPDX-License-Identifier: MIT
// Skeletons of several main templates apart and together again.
#include "tags/mains.h"

#include <doctest/doctest.h>

#include "tags/dump.h"

using namespace rigc;
using namespace rigc::tags;

namespace {

TaggedJoint joint(const std::string& name, int parent, int template_index, math::Vec3 at) {
  TaggedJoint out;
  out.name = name;
  out.key = {hash64(name), 0};
  out.parent = parent;
  out.template_index = template_index;
  out.ids = {"hero", name, name};
  out.rest.translation = at;
  return out;
}

JointKey key(const std::string& name) { return {hash64(name), 0}; }

/// Body with a part, an arm with a part under its chest, a watch under the arm's hand.
TaggedSkeleton skeleton() {
  TaggedSkeleton out;
  out.name = "body";
  out.global = "hero";
  out.templates = {{"body", 1, "body.yaml", "", false},
                   {"spine", 1, "parts/spine", "", false},
                   {"arm_rig", 3, "arm.yaml", "", true},
                   {"arm", 2, "parts/arm", "", false},
                   {"watch", 1, "watch.yaml", "", true}};
  out.joints = {joint("hips", -1, 0, {0, 1, 0}), joint("chest", 0, 1, {0, 0.5, 0}),
                joint("base", 1, 2, {0.5, 0, 0}), joint("hand", 2, 3, {0.25, 0, 0}),
                joint("dial", 3, 4, {0, 0, 0.125})};
  out.joints[1].was = {key("thorax")};
  out.features = {{"ikfk", "limb", "", "", true, {}}};
  return out;
}

}  // namespace

TEST_CASE("mains: a skeleton of one main template is itself") {
  TaggedSkeleton one = skeleton();
  one.joints.resize(2);
  one.templates.resize(2);
  CHECK(main_count(one) == 1);
  const auto mains = split_mains(one);
  REQUIRE(mains.size() == 1);
  CHECK(dump(mains[0].skeleton) == dump(one));
  CHECK(dump(join_mains(mains)) == dump(one));
}

TEST_CASE("mains: each has its joints, its templates, and its roots in rig space") {
  const auto mains = split_mains(skeleton());
  REQUIRE(mains.size() == 3);
  CHECK(main_count(skeleton()) == 3);
  const TaggedSkeleton& arm = mains[1].skeleton;
  CHECK(arm.name == "arm_rig");
  CHECK(arm.global == "hero");
  REQUIRE(arm.joints.size() == 2);
  CHECK(arm.joints[0].parent == -1);
  CHECK(arm.joints[0].rest.translation == math::Vec3{0.5, 1.5, 0});
  CHECK(arm.joints[0].template_index == 0);
  CHECK(arm.joints[1].parent == 0);
  CHECK(arm.joints[1].template_index == 1);
  CHECK(arm.templates[1].name == "arm");
  CHECK(!arm.templates[0].main);
  REQUIRE(mains[1].attached.size() == 1);
  CHECK(mains[1].attached[0].first == key("base"));
  CHECK(mains[1].attached[0].second == std::vector<JointKey>{key("chest"), key("hips")});
  REQUIRE(mains[2].attached.size() == 1);
  CHECK(mains[2].attached[0].second.front() == key("hand"));
  CHECK(mains[0].attached.empty());
}

TEST_CASE("mains: together again they are what they were") {
  CHECK(dump(join_mains(split_mains(skeleton()))) == dump(skeleton()));
}

TEST_CASE("mains: a root follows its joint through a rename, else the next one above") {
  auto mains = split_mains(skeleton());
  TaggedSkeleton& body = mains[0].skeleton;
  body.joints[1].key = key("ribs");
  body.joints[1].was = {key("chest")};
  CHECK(join_mains(mains).joints[2].parent == 1);
  body.joints.resize(1);
  const TaggedSkeleton lower = join_mains(mains);
  CHECK(lower.joints[1].name == "base");
  CHECK(lower.joints[1].parent == 0);
  CHECK(lower.world(1).origin == math::Vec3{0.5, 1.5, 0});
  body.joints[0].key = key("other");
  CHECK(join_mains(mains).joints[1].parent == -1);
}

TEST_CASE("mains: declarations are united by name") {
  auto mains = split_mains(skeleton());
  mains[1].skeleton.features = {{"ikfk", "other", "", "", false, {}}, {"fk", "", "", "", true, {}}};
  mains[1].skeleton.module_pins = {{"control", 2}};
  const TaggedSkeleton both = join_mains(mains);
  REQUIRE(both.features.size() == 2);
  CHECK(both.features[0].kind == "limb");
  CHECK(both.module_pins.size() == 1);
}
