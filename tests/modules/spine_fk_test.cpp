// SPDX-License-Identifier: MIT
// spine_fk: hips that turn alone, a spine that bends from below, and no bone that stretches.
#include <doctest/doctest.h>

#include "modules/bodies_helpers.h"
#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

const std::string kSpine = "{command: spine_fk, with: {joints: [., \"spine[*]\", torso.chest]";

test::Commands spine(const std::string& parent = ", parent: \"./control#body\"") {
  return {{"root", "{command: root, with: {drive: on}}"},
          {"hips", "{command: control, id: body, with: {drive: off}}\n" + kSpine + parent + "}}"},
          {"thigh_l", "{command: control, with: {translate: off}}"}};
}

const std::string kBody = "torso.hips/control#body";
const std::string kHips = "torso/spine_fk.hips";
const std::string kChest = "torso/spine_fk.chest";

}  // namespace

TEST_CASE("modules spine_fk: the hips turn without turning the spine, and nothing stretches") {
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(test::body(spine()), model.change);
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    test::Pose pose(rig);
    pose.turn_in_world(kHips, test::mapped(model.by, math::from_euler_degrees({20, 30, 40})));
    const auto motion = test::motion(rig, pose);
    const auto joints = pose.joints();
    const double height = rig.skeleton.character.height;
    CHECK(test::largest_difference(test::bone_lengths(rig, joints),
                                   test::bone_lengths(rig, test::Pose(rig).joints())) <
          1e-9 * height);
    // The chest keeps its orientation (linear part: identity) and stands on the turned hips.
    const math::Affine chest = motion[4];
    CHECK(test::difference({chest.linear, {}}, {}, 1) < 1e-9);
    CHECK(math::length(chest.origin) > 0.01 * height);
    CHECK(test::difference({motion[1].linear, {}}, {}, 1) > 0.3);
  }
}

TEST_CASE("modules spine_fk: moving the hips carries everything") {
  const test::Rig rig(test::body(spine()));
  test::Pose pose(rig);
  pose.translate(kHips, {0.1, -0.2, 0.3});
  for (std::size_t j = 1; j < rig.skeleton.joints.size(); ++j) {
    CHECK(test::difference(test::motion(rig, pose)[j], math::translation({0.1, -0.2, 0.3}), 1) <
          1e-12);
  }
}

TEST_CASE("modules spine_fk: the body control turns hips and spine together") {
  const test::Rig rig(test::body(spine()));
  test::Pose pose(rig);
  pose.rotate(kBody, {0, 90, 0});
  const auto motion = test::motion(rig, pose);
  CHECK(test::difference(motion[1], motion[4], 1) < 1e-12);
  CHECK(test::distance(pose.position("arm_l.end"), {0, 1.42, -0.73}) < 1e-12);
}

TEST_CASE("modules spine_fk: spine controls bend what is above, the chest last") {
  const test::Rig rig(test::body(spine()));
  test::Pose pose(rig);
  pose.rotate("spine[0]/spine_fk", {30, 0, 0}).rotate(kChest, {0, 45, 0});
  CHECK(test::distance(pose.position("torso.hips"), {0, 0.95, 0}) < 1e-12);
  CHECK(test::distance(pose.position("spine[0]"), {0, 1.05, 0}) < 1e-12);
  const Vec3 from_base = Vec3{0, 1.3, 0.01} - Vec3{0, 1.05, 0};
  CHECK(test::distance(pose.position("torso.chest"),
                       Vec3{0, 1.05, 0} +
                           math::rotate(math::from_euler_degrees({30, 0, 0}), from_base)) < 1e-12);
}

TEST_CASE("modules spine_fk: the same motion on every model") {
  const auto move = [](const test::Rig& rig, const math::Affine& by) {
    test::Pose pose(rig);
    pose.turn_in_world(kBody, test::mapped(by, math::from_euler_degrees({5, 40, 0})));
    pose.turn_in_world(kHips, test::mapped(by, math::from_euler_degrees({0, -20, 15})));
    pose.turn_in_world("spine[1]/spine_fk", test::mapped(by, math::from_euler_degrees({25, 0, 5})));
    pose.turn_in_world(kChest, test::mapped(by, math::from_euler_degrees({0, 30, 0})));
    return test::motion(rig, pose);
  };
  const test::Rig plain(test::body(spine()));
  const auto expected = move(plain, {});
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(test::body(spine()), model.change);
    CHECK(test::motion_difference(rig, move(rig, model.by), test::mapped(model.by, expected)) <
          1e-9);
  }
}

TEST_CASE("modules spine_fk: it may follow a joint") {
  test::Commands commands = spine(", parent: root");
  commands["root"] = "{command: control, with: {}}";
  const test::Rig rig(test::body(commands));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  CHECK(test::rest_error(rig) < 1e-12);
  test::Pose pose(rig);
  pose.translate("root/control", {0, 0, 1}).rotate("root/control", {0, 90, 0});
  CHECK(test::distance(pose.position("arm_l.end"), {0, 1.42, 1 - 0.73}) < 1e-12);
  pose.rotate(kHips, {0, 0, 30});
  CHECK(test::largest_difference(test::bone_lengths(rig, pose.joints()),
                                 test::bone_lengths(rig, test::Pose(rig).joints())) < 1e-12);
}
