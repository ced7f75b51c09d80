// SPDX-License-Identifier: MIT
// root: world and offset move everything, the master scale scales everything.
#include <doctest/doctest.h>

#include "modules/bodies_helpers.h"
#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

/// A whole rig: root, body, spine, neck, arms and legs, eyes left out.
test::Commands whole_rig() {
  test::Commands commands{{"root", "{command: root, with: {drive: on}}"},
                          {"hips",
                           "{command: control, id: body, with: {drive: off}}\n"
                           "{command: spine_fk, with: {joints: [., \"spine[*]\", torso.chest], "
                           "parent: \"./control#body\"}}"},
                          {"head", "{command: control, with: {translate: off}}"}};
  for (const std::string s : {"l", "r"}) {
    commands["clavicle_" + s] = "{command: control, with: {translate: off}}";
    commands["upperarm_" + s] = "{command: ik_fk_limb, with: {start: ., middle: arm_" + s +
                                ".lower, end: arm_" + s + ".end, ik_fk: 0.5}}";
    commands["thigh_" + s] = "{command: ik_fk_limb, with: {start: ., middle: leg_" + s +
                             ".lower, end: leg_" + s + ".end, bend: forward, ik_fk: 1}}";
  }
  return commands;
}

const std::string kWorld = "root/root.world";
const std::string kOffset = "root/root.offset";

}  // namespace

TEST_CASE("modules root: everything at rest leaves every joint exactly at rest on every model") {
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(test::body(whole_rig()), model.change);
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    CHECK(test::rest_error(rig) < 1e-9);
  }
}

TEST_CASE("modules root: world and offset move the whole rig rigidly") {
  for (const std::string& control : {kWorld, kOffset}) {
    const test::Rig rig(test::body(whole_rig()));
    test::Pose pose(rig);
    pose.translate(control, {1, 2, 3}).rotate(control, {10, 70, -20});
    const math::Affine moved =
        math::translation({1, 2, 3}) * math::rotation(math::from_euler_degrees({10, 70, -20}));
    for (const math::Affine& motion : test::motion(rig, pose)) {
      CHECK(test::difference(motion, moved, 1) < 1e-9);
    }
  }
}

TEST_CASE("modules root: the master scale scales every joint about the ground below the root") {
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(test::body(whole_rig()), model.change);
    test::Pose pose(rig);
    pose.set(kWorld + "@master_scale", 2.0);
    const Vec3 fixed = model.by * Vec3{0, 0, 0};
    const math::Affine doubled{{{2, 0, 0}, {0, 2, 0}, {0, 0, 2}}, fixed * -1.0};
    for (const math::Affine& motion : test::motion(rig, pose)) {
      CHECK(test::difference(motion, doubled, rig.skeleton.character.height) < 1e-9);
    }
  }
}

TEST_CASE("modules root: scale works together with a pose") {
  const test::Rig rig(test::body(whole_rig()));
  const auto posed = [&] {
    test::Pose pose(rig);
    pose.rotate("torso/spine_fk.chest", {20, 10, 5})
        .rotate("arm_l.upper/ik_fk_limb.fk", {0, 0, 40});
    pose.translate("torso.hips/control#body", {0, -0.2, 0.1});
    return pose;
  };
  const auto before = posed().joints();
  const auto after = posed().set(kWorld + "@master_scale", 3.0).joints();
  for (std::size_t j = 0; j < before.size(); ++j) {
    CHECK(test::distance(after[j].origin, before[j].origin * 3) < 1e-9);
  }
}

TEST_CASE("modules root: rests on the ground below its joint, or at the joint") {
  const test::Rig ground(test::body({{"hips", "{command: root, with: {}}"}}));
  CHECK(test::distance(ground.rest("torso/root.world").origin, {0, 0, 0}) < 1e-12);
  const test::Rig joint(test::body({{"hips", "{command: root, with: {place: joint}}"}}));
  CHECK(test::distance(joint.rest("torso/root.world").origin, {0, 0.95, 0}) < 1e-12);
}

TEST_CASE("modules root: what hangs under nothing else hangs under its offset control") {
  const test::Rig rig(test::body(
      {{"root", "{command: root, with: {}}"}, {"head", "{command: control, with: {}}"}}));
  CHECK(rig.scene()[rig.node("head.head/control.zero")].parent == rig.node(kOffset));
}

TEST_CASE("modules root: without a scale there is no such attribute, and the joint is left alone") {
  const test::Rig rig(test::body({{"root", "{command: root, with: {scale: off}}"}}));
  CHECK_FALSE(rig.scene().find_plug(rig.node(kWorld), "master_scale"));
  test::Pose pose(rig);
  pose.translate(kWorld, {1, 0, 0});
  CHECK(test::distance(pose.position("root"), {0, 0, 0}) < 1e-12);
}
