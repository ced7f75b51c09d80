// SPDX-License-Identifier: MIT
// look_at: the eyes look where the target is, on every model.
#include <doctest/doctest.h>

#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

const std::string kHead = R"(rigc: 1
name: test
version: 1
joints:
  - name: head
    at: [0, 1.6, 0]
    local: head
    label: head
    tags:
      - {command: control, with: {}}
      - {command: look_at, with: {eyes: [eye_l.eye, eye_r.eye], distance: 0.4}}
  - name: eye_l
    parent: head
    at: [0.03, 1.66, 0.08]
    local: eye_l
    label: eye
  - name: eye_r
    parent: head
    at: [-0.03, 1.66, 0.08]
    local: eye_r
    label: eye
)";

const std::string kTarget = "head/look_at.target";

/// Where an eye looks: what was ahead of it at rest.
Vec3 gaze(const test::Rig& rig, const test::Pose& pose, const std::string& eye) {
  const math::Affine motion = pose.world(eye) * math::inverse(rig.rest(eye));
  return math::normalised(motion.linear * rig.skeleton.character.forward);
}

}  // namespace

TEST_CASE("modules look_at: both eyes look at the target, with their distance kept") {
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(kHead, model.change);
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    test::Pose pose(rig);
    pose.move_to(kTarget, model.by * Vec3{0.3, 1.9, 0.6});
    for (const std::string eye : {"eye_l.eye", "eye_r.eye"}) {
      const Vec3 aim = pose.position(eye + "/look_at.aim");
      CHECK(math::dot(gaze(rig, pose, eye), math::normalised(aim - pose.position(eye))) >
            1 - 1e-12);
    }
    const Vec3 left = pose.position("eye_l.eye/look_at.aim");
    const Vec3 middle = pose.position(kTarget);
    CHECK(test::distance(left - middle, model.by.linear * Vec3{0.03, 0, 0}) <
          1e-9 * rig.skeleton.character.height);
  }
}

TEST_CASE("modules look_at: an eye's own control moves that eye alone") {
  const test::Rig rig(kHead);
  test::Pose pose(rig);
  const Vec3 right = gaze(rig, pose, "eye_r.eye");
  pose.translate("eye_l.eye/look_at.aim", {0.1, 0, 0});
  CHECK(gaze(rig, pose, "eye_l.eye").x > 0.2);
  CHECK(test::distance(gaze(rig, pose, "eye_r.eye"), right) < 1e-12);
}

TEST_CASE("modules look_at: the head turns, the eyes stay on the target and upright in the head") {
  const test::Rig rig(kHead);
  test::Pose pose(rig);
  pose.rotate("head.head/control", {0, 30, 0});
  const Vec3 aim = pose.position("eye_l.eye/look_at.aim");
  CHECK(math::dot(gaze(rig, pose, "eye_l.eye"),
                  math::normalised(aim - pose.position("eye_l.eye"))) > 1 - 1e-12);
  test::Pose rolled(rig);
  rolled.rotate("head.head/control", {0, 0, 90});
  const math::Affine eye = rolled.world("eye_l.eye");
  CHECK(eye.linear.y.x < -0.95);  // its up lies where the head's up lies
}

TEST_CASE("modules look_at: under a parent the target follows it") {
  std::string text = kHead;
  text.replace(text.find("distance: 0.4"), 13, "parent: ./control");
  const test::Rig rig(text);
  REQUIRE(rig.clean());
  test::Pose pose(rig);
  pose.rotate("head.head/control", {0, 30, 0});
  CHECK(test::distance(gaze(rig, pose, "eye_l.eye"),
                       math::rotate(math::from_euler_degrees({0, 30, 0}), Vec3{0, 0, 1})) < 1e-9);
}
