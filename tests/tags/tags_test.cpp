// SPDX-License-Identifier: MIT
// Tagged skeletons: look-ups and the dump.
#include "tags/tags.h"

#include <doctest/doctest.h>

#include "tags/dump.h"

using namespace rigc;
using namespace rigc::tags;

namespace {

TaggedSkeleton two_joints() {
  TaggedSkeleton skeleton;
  skeleton.name = skeleton.global = "case";
  TaggedJoint a;
  a.name = "a";
  a.key = {1, 0};
  a.ids = {"case", "g", "l"};
  a.rest.translation = {1, 0, 0};
  a.rest.rotation = math::from_euler_degrees({0, 0, 90});
  CommandTag command;
  command.module = command.id = "control";
  command.with.push_back({"size", {}, Literal::of(0.5)});
  a.commands.push_back(command);
  TaggedJoint b = a;
  b.name = "b";
  b.key = {1, 1};
  b.parent = 0;
  skeleton.joints = {a, b};
  return skeleton;
}

}  // namespace

TEST_CASE("tags skeleton: worlds, keys and arguments") {
  const TaggedSkeleton skeleton = two_joints();
  CHECK(length(skeleton.world(1).origin - math::Vec3{1, 1, 0}) < 1e-12);
  CHECK(skeleton.find({1, 1}) == 1);
  CHECK(skeleton.find({2, 0}) == -1);
  CHECK(skeleton.joints[0].commands[0].find("size")->number == 0.5);
  CHECK(skeleton.joints[0].commands[0].find("color") == nullptr);
}

TEST_CASE("tags dump: every change of content shows") {
  const TaggedSkeleton skeleton = two_joints();
  const std::string text = dump(skeleton);
  CHECK(text == dump(two_joints()));
  const auto differs = [&](auto change) {
    TaggedSkeleton other = two_joints();
    change(other);
    return dump(other) != text;
  };
  CHECK(differs([](TaggedSkeleton& s) { s.joints[1].rest.translation.x = 2; }));
  CHECK(differs([](TaggedSkeleton& s) { s.joints[1].commands[0].on = false; }));
  CHECK(
      differs([](TaggedSkeleton& s) { s.joints[1].commands[0].with[0].value = Literal::of(1.0); }));
  CHECK(differs([](TaggedSkeleton& s) { s.joints[1].key.ordinal = 2; }));
  CHECK(differs([](TaggedSkeleton& s) { s.joints[1].mirror.opposite = {5, 0}; }));
  CHECK(differs([](TaggedSkeleton& s) { s.joints[1].template_parent = {5, 0}; }));
  CHECK(differs([](TaggedSkeleton& s) { s.joints[1].ids.label = "other"; }));
  CHECK(differs([](TaggedSkeleton& s) { s.character.unit = 2; }));
}
