// SPDX-License-Identifier: MIT
// spine_ik: hips and chest bend a spine between them, which stretches or keeps its length, twists
// evenly, and has FK controls on top.
#include <doctest/doctest.h>

#include "modules/bodies_helpers.h"
#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

/// A tower of joints, hips to chest, with an arm on the chest.
std::string tower(const std::string& with = {}) {
  std::string text = R"(joints:
  - name: hips
    at: [0, 1, 0]
    local: torso
    label: hips
    tags:
      - {command: root, with: {}}
      - {command: control, id: body, with: {drive: off}}
      - {command: spine_ik, with: {joints: [., "spine[*]", torso.chest], parent: "./control#body")";
  text += with;
  text += R"(}}
  - name: spine
    parent: hips
    at: [0, 1.1, 0]
    chain: {count: 4, to: [0, 1.4, 0]}
    local: spine
  - {name: chest, parent: spine, at: [0, 1.5, 0], local: torso, label: chest}
  - name: arm
    parent: chest
    at: [0.3, 1.5, 0]
    local: arm
    label: arm
    tags:
      - {command: control, with: {}}
)";
  return test::template_of(text);
}

const std::string kHips = "torso.hips/spine_ik.hips";
const std::string kChest = "torso.chest/spine_ik.chest";
const std::string kMiddle = "spine/spine_ik.ik";

std::vector<std::string> joints_of_spine() {
  return {"torso.hips", "spine[0]", "spine[1]", "spine[2]", "spine[3]", "torso.chest"};
}

std::vector<Vec3> places(const test::Pose& pose) {
  std::vector<Vec3> found;
  for (const std::string& joint : joints_of_spine()) found.push_back(pose.position(joint));
  return found;
}

/// About the character's up, in degrees.
double twist(const test::Rig& rig, const test::Pose& pose, const std::string& joint) {
  const math::Mat3 turn = math::orthonormal(pose.world(joint).linear) *
                          math::transposed(math::orthonormal(rig.rest(joint).linear));
  return math::degrees(math::atan2(turn.z.x, turn.z.z));
}

}  // namespace

TEST_CASE("modules spine_ik: the chest moved aside bends the spine smoothly, at its length") {
  const test::Rig rig(tower(", stretch: 0"));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  CHECK(test::rest_error(rig) < 1e-9);
  test::Pose pose(rig);
  pose.translate(kChest, {0.25, -0.05, 0.05});
  const std::vector<Vec3> at = places(pose);
  double before = 0;
  for (std::size_t i = 1; i < at.size(); ++i) {
    CHECK(math::length(at[i] - at[i - 1]) == doctest::Approx(0.1).epsilon(1e-9));
    CHECK(at[i].x > before);
    before = at[i].x;
    if (i < 2) continue;
    // No corner: neighbouring bones are less than 40 degrees apart.
    CHECK(math::dot(at[i] - at[i - 1], at[i - 1] - at[i - 2]) > 0.0076);
  }
  CHECK(test::distance(at.front(), {0, 1, 0}) < 1e-12);
  // The chest keeps the control's orientation.
  CHECK(twist(rig, pose, "torso.chest") == doctest::Approx(0));
}

TEST_CASE(
    "modules spine_ik: stretched, the chest reaches its control, also of a larger character") {
  for (const double size : {1.0, 2.5}) {
    const test::Rig rig(tower());
    test::Pose pose(rig);
    pose.set("torso.hips/root.world@master_scale", size);
    pose.translate(kChest, {0.2, 0.3, -0.1}).rotate(kChest, {10, 20, 30});
    CHECK(test::distance(pose.position("torso.chest"), pose.position(kChest)) < 1e-9);
    // The same character, larger: the root stands on the ground below the hips.
    test::Pose small(rig);
    small.translate(kChest, {0.2, 0.3, -0.1}).rotate(kChest, {10, 20, 30});
    const Vec3 root = rig.rest("torso.hips/root.world").origin;
    const auto grown = places(pose), plain = places(small);
    for (std::size_t i = 0; i < grown.size(); ++i)
      CHECK(test::distance(grown[i], root + (plain[i] - root) * size) < 1e-9);
    CHECK(test::distance(pose.position("arm.arm"),
                         root + (small.position("arm.arm") - root) * size) < 1e-9);
    // It is 0.5 long and may become twice that.
    small.set(kChest + "@stretch", 0.0);
    const auto kept = places(small);
    for (std::size_t i = 1; i < kept.size(); ++i)
      CHECK(math::length(kept[i] - kept[i - 1]) == doctest::Approx(0.1).epsilon(1e-9));
  }
  const test::Rig rig(tower(", most: 1.2"));
  test::Pose pose(rig);
  pose.translate(kChest, {0, 0.5, 0});
  CHECK(pose.position("torso.chest").y == doctest::Approx(1 + 0.6).epsilon(1e-6));
}

TEST_CASE("modules spine_ik: twist of the chest is spread over the spine") {
  for (const double angle : {90.0, -150.0}) {
    const test::Rig rig(tower());
    test::Pose pose(rig);
    pose.rotate(kChest, {0, angle, 0});
    double before = 0;
    const std::vector<std::string> joints = joints_of_spine();
    for (std::size_t i = 1; i < joints.size(); ++i) {
      const double here = twist(rig, pose, joints[i]);
      CHECK(here / angle > before + 0.1);
      before = here / angle;
    }
    CHECK(before == doctest::Approx(1).epsilon(1e-9));
    CHECK(twist(rig, pose, "torso.hips") == doctest::Approx(0));
  }
}

TEST_CASE("modules spine_ik: the middle control bends the middle and leaves the ends") {
  const test::Rig rig(tower());
  test::Pose pose(rig);
  pose.translate(kMiddle, {0, 0, 0.1});
  const std::vector<Vec3> at = places(pose);
  CHECK(at[2].z > 0.07);
  CHECK(at[3].z > 0.07);
  CHECK(test::distance(at.front(), {0, 1, 0}) < 1e-12);
  CHECK(test::distance(at.back(), {0, 1.5, 0}) < 1e-12);
  // It rides between hips and chest.
  test::Pose moved(rig);
  moved.translate(kChest, {0.2, 0, 0});
  CHECK(test::distance(moved.position(kMiddle), {0.1, 1.25, 0}) < 1e-9);
}

TEST_CASE("modules spine_ik: FK controls turn what is above on top of the curve") {
  const test::Rig rig(tower());
  test::Pose curved(rig);
  curved.translate(kChest, {0.1, 0.02, 0});
  const std::vector<Vec3> before = places(curved);
  const Vec3 arm = curved.position("arm.arm");
  test::Pose pose = curved;
  const math::Quat turn = math::from_euler_degrees({30, 0, 0});
  pose.turn_in_world("spine[1]/spine_ik.fk", turn);
  const std::vector<Vec3> at = places(pose);
  for (std::size_t i = 0; i <= 2; ++i) CHECK(test::distance(at[i], before[i]) < 1e-12);
  // All above turns as one about that joint.
  for (std::size_t i = 3; i < at.size(); ++i)
    CHECK(math::length(at[i] - at[2]) ==
          doctest::Approx(math::length(before[i] - before[2])).epsilon(1e-12));
  CHECK(at.back().z > 0.1);
  CHECK(math::length(pose.position("arm.arm") - at.back()) ==
        doctest::Approx(math::length(arm - before.back())).epsilon(1e-12));
}

TEST_CASE("modules spine_ik: the chest stays with the body or follows the hips") {
  const test::Rig rig(tower());
  test::Pose pose(rig);
  pose.translate(kHips, {0.1, 0, 0});
  CHECK(test::distance(pose.position("torso.chest"), {0, 1.5, 0}) < 1e-9);
  pose.set(kChest + "@follow_hips", 1.0);
  CHECK(test::distance(pose.position("torso.chest"), {0.1, 1.5, 0}) < 1e-9);
  test::Pose body(rig);
  body.translate("torso.hips/control#body", {0, -0.2, 0.1});
  for (std::size_t i = 0; i < 6; ++i)
    CHECK(test::distance(places(body)[i], Vec3{0, 0.8 + 0.1 * static_cast<double>(i), 0.1}) < 1e-9);
}

TEST_CASE("modules spine_ik: volume makes a stretched spine thinner, hips and chest stay") {
  const test::Rig rig(tower(", volume: 1"));
  test::Pose pose(rig);
  pose.translate(kChest, {0, 0.5, 0});
  const auto size = [&](const std::string& joint) {
    const math::Mat3 m = pose.world(joint).linear;
    CHECK(math::length(m.x) == doctest::Approx(math::length(m.y)));
    return math::length(m.x);
  };
  for (const std::string joint : {"spine[0]", "spine[1]", "spine[3]"})
    CHECK(size(joint) == doctest::Approx(1 / math::sqrt(2)).epsilon(1e-6));
  for (const std::string joint : {"torso.hips", "torso.chest", "arm.arm"})
    CHECK(size(joint) == doctest::Approx(1).epsilon(1e-9));
  CHECK(test::distance(pose.position("torso.chest"), {0, 2, 0}) < 1e-9);
  CHECK(test::distance(pose.position("arm.arm"), {0.3, 2, 0}) < 1e-9);
}

TEST_CASE("modules spine_ik: the same motion on every model") {
  const auto move = [](const test::Rig& rig, const math::Affine& by) {
    test::Pose pose(rig);
    pose.turn_in_world(kHips, test::mapped(by, math::from_euler_degrees({0, -20, 15})));
    pose.turn_in_world(kChest, test::mapped(by, math::from_euler_degrees({20, 30, 5})));
    const Vec3 at = pose.position(kChest);
    pose.move_to(kChest, at + by.linear * Vec3{0.1, 0.05, -0.05});
    pose.turn_in_world("spine[1]/spine_ik.fk",
                       test::mapped(by, math::from_euler_degrees({10, 0, 5})));
    return test::motion(rig, pose);
  };
  const test::Rig plain(tower());
  const auto expected = move(plain, {});
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(tower(), model.change);
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    CHECK(test::rest_error(rig) < 1e-9);
    CHECK(test::motion_difference(rig, move(rig, model.by), test::mapped(model.by, expected)) <
          1e-8);
  }
}

TEST_CASE("modules spine_ik: two joints are too few") {
  const test::Rig rig(test::template_of(R"(joints:
  - name: hips
    at: [0, 1, 0]
    local: torso
    label: hips
    tags:
      - {command: spine_ik, with: {joints: [., torso.chest]}}
  - {name: chest, parent: hips, at: [0, 1.5, 0], local: torso, label: chest}
)"));
  CHECK(test::codes(rig.diagnostics) == "RIG0461");
}
