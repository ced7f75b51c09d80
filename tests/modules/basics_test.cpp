// SPDX-License-Identifier: MIT
// transform, joint, parent: plain nodes and where they hang.
#include <doctest/doctest.h>

#include "modules/bodies_helpers.h"
#include "support/models.h"

using namespace rigc;
using math::Vec3;

TEST_CASE("modules basics: a transform rests at its offset and hangs where it is told") {
  const test::Rig rig(
      test::body({{"root", "{command: root, with: {}}"},
                  {"hips", "{command: control, with: {}}"},
                  {"head",
                   "{command: transform, id: free, with: {offset: [0, 0.1, 0.2]}}\n"
                   "{command: transform, id: hung, with: {parent: torso.hips/control}}\n"
                   "{command: transform, id: following, with: {follow: .}}"}}));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  const std::string made = "head.head/transform#";
  CHECK(test::distance(rig.rest(made + "free").origin, {0, 1.7, 0.22}) < 1e-12);
  CHECK(rig.scene()[rig.node(made + "free")].parent == rig.node("root/root.offset"));
  CHECK(rig.scene()[rig.node(made + "hung")].parent == rig.node("torso.hips/control"));
  test::Pose pose(rig);
  pose.rotate("torso.hips/control", {0, 0, 90});
  CHECK(test::distance(pose.position(made + "free"), {0, 1.7, 0.22}) < 1e-12);
  CHECK(test::distance(pose.position(made + "hung"), {-0.65, 0.95, 0.02}) < 1e-12);
  CHECK(test::difference(pose.world(made + "following"), pose.world("head.head"), 1) < 1e-12);
}

TEST_CASE("modules basics: a transform has the role and the label that selectors find") {
  const test::Rig rig(
      test::body({{"head", "{command: transform, with: {label: crown, name: crown}}"}}));
  CHECK(rig.scene()[rig.node("head.crown")].name == "crown");
  CHECK(rig.node("head.crown") == rig.node("head/transform.transform"));
}

TEST_CASE("modules basics: a joint that a command makes hangs under its parent and moves with it") {
  const test::Rig rig(
      test::body({{"hips", "{command: control, with: {}}"},
                  {"head", "{command: joint, with: {offset: [0, 0.2, 0], label: crown}}"}}));
  CHECK(rig.scene()[rig.node("head.crown")].parent == rig.node("head.head"));
  CHECK(test::distance(rig.rest("head.crown").origin, {0, 1.8, 0.02}) < 1e-12);
  test::Pose pose(rig);
  pose.translate("torso.hips/control", {1, 0, 0});
  CHECK(test::distance(pose.position("head.crown"), {1, 1.8, 0.02}) < 1e-12);
}

TEST_CASE("modules basics: an offset along character axes is the same place on every model") {
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(
        test::body({{"head", "{command: transform, with: {offset: [0, 0.1, 0.2]}}"}}),
        model.change);
    CHECK(test::distance(rig.rest("head/transform").origin, model.by * Vec3{0, 1.7, 0.22}) <
          1e-9 * rig.skeleton.character.height);
  }
}

TEST_CASE("modules basics: parent moves a node in the hierarchy and keeps its place") {
  const std::string hang = "{command: parent, with: {node: ./control.zero, to: arm_l.end/control";
  const auto rig_with = [&](const std::string& more) {
    return test::body({{"hand_l", "{command: control, with: {}}"},
                       {"head", "{command: control, with: {drive: off}}\n" + hang + more + "}}"}});
  };
  const test::Rig rig(rig_with(""));
  REQUIRE(rig.clean());
  CHECK(rig.scene()[rig.node("head.head/control.zero")].parent == rig.node("arm_l.end/control"));
  CHECK(test::distance(rig.rest("head.head/control").origin, {0, 1.6, 0.02}) < 1e-12);
  test::Pose pose(rig);
  pose.translate("arm_l.end/control", {0, 1, 0});
  CHECK(test::distance(pose.position("head.head/control"), {0, 2.6, 0.02}) < 1e-12);
  const test::Rig snapped(rig_with(", maintain: off"));
  CHECK(test::distance(snapped.rest("head.head/control").origin, {0.73, 1.42, 0}) < 1e-12);
}

TEST_CASE("modules basics: parent keeps the place under a parent that rests turned and scaled") {
  const test::Rig rig(
      test::body({{"hips", "{command: control, with: {}}"},
                  {"head",
                   "{command: control, with: {drive: off}}\n"
                   "{command: parent, with: {node: ./control.zero, to: torso.hips}}"}}),
      [](auto& s) {
        test::turn_axes(s, 3);
        test::scale_root_joint(s, 50);
      });
  REQUIRE(rig.clean());
  CHECK(test::distance(rig.rest("head.head/control").origin, {0, 1.6, 0.02}) < 1e-9);
}
