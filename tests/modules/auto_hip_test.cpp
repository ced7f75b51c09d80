// SPDX-License-Identifier: MIT
// auto_hip: lifting a leg turns the hips, as an animator sees it.
#include <doctest/doctest.h>

#include <algorithm>

#include "modules/legs_helpers.h"
#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

const std::string kHips =
    "{command: auto_hip, with: {hips: \"./control#hips\", limbs: [leg_l/ik_fk_limb.ik, "
    "leg_r/ik_fk_limb.ik]}}";
const std::string kLeft = "leg_l/ik_fk_limb.ik", kRight = "leg_r/ik_fk_limb.ik";
const std::string kControl = "torso.hips/control#hips";

test::Pose seated(const test::Rig& rig, bool left, bool right, const math::Affine& by = {}) {
  test::Pose pose(rig);
  if (left) pose.move_to(kLeft, by * Vec3{0.11, 0.9, 0.6});
  if (right) pose.move_to(kRight, by * Vec3{-0.11, 0.9, 0.6});
  return pose;
}

/// Where the character's left, up and forward of the hips point in a pose.
math::Mat3 hips_in(const test::Rig& rig, const test::Pose& pose) {
  return pose.world("torso.hips").linear * math::inverse(rig.rest("torso.hips").linear);
}

}  // namespace

TEST_CASE("modules auto_hip: at rest nothing moves") {
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    for (const double ik_fk : {0.0, 1.0}) {
      const test::Rig rig(test::legs("", ik_fk, kHips), model.change);
      INFO(test::text(rig.diagnostics));
      REQUIRE(rig.clean());
      CHECK(test::rest_error(rig) < 1e-9);
    }
  }
}

TEST_CASE("modules auto_hip: a leg that goes forward raises its side, takes it forward and tucks") {
  const test::Rig rig(test::legs("", 1, kHips));
  const math::Mat3 hips = hips_in(rig, seated(rig, true, false));
  CHECK(hips.x.y > 0.05);   // left side up
  CHECK(hips.x.z > 0.05);   // left side forward
  CHECK(hips.y.z < -0.05);  // top goes back
  const math::Mat3 other = hips_in(rig, seated(rig, false, true));
  CHECK(other.x.y < -0.05);
  CHECK(other.x.z < -0.05);
}

TEST_CASE("modules auto_hip: both legs forward only tuck the pelvis") {
  const test::Rig rig(test::legs("", 1, kHips));
  const math::Mat3 hips = hips_in(rig, seated(rig, true, true));
  CHECK(std::abs(hips.x.y) < 1e-9);
  CHECK(std::abs(hips.x.z) < 1e-9);
  CHECK(hips.y.z < -0.1);
}

TEST_CASE("modules auto_hip: a leg to the side raises the hip and swings nothing") {
  const test::Rig rig(test::legs("", 1, kHips));
  test::Pose pose(rig);
  pose.move_to(kLeft, {0.7, 0.7, -0.01});
  const math::Mat3 hips = hips_in(rig, pose);
  CHECK(hips.x.y > 0.05);
  CHECK(std::abs(hips.x.z) < 0.01);
}

TEST_CASE("modules auto_hip: thighs turned in FK do the same") {
  const test::Rig rig(test::legs("", 0, kHips));
  test::Pose pose(rig);
  pose.turn_in_world("leg_l.upper/ik_fk_limb.fk", math::from_euler_degrees({-80, 0, 0}));
  const math::Mat3 hips = hips_in(rig, pose);
  CHECK(hips.x.y > 0.03);
  CHECK(hips.x.z > 0.03);
}

TEST_CASE("modules auto_hip: small steps leave the hips, and the attribute fades all in and out") {
  const test::Rig rig(test::legs("", 1, kHips));
  test::Pose step(rig);
  step.translate(kLeft, {0, 0, 0.1});
  CHECK(test::difference({hips_in(rig, step), {}}, {}, 1) < 1e-9);
  double last = 0;
  for (const double amount : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    test::Pose pose = seated(rig, true, false);
    pose.set(kControl + "@auto_hip", amount);
    const double up = hips_in(rig, pose).x.y;
    if (amount == 0) {
      CHECK(std::abs(up) < 1e-12);
    } else {
      CHECK(up > last);
    }
    last = up;
  }
}

TEST_CASE("modules auto_hip: the tweak control and the hips control turn on top of it") {
  const test::Rig rig(test::legs("", 1, kHips));
  for (const std::string& control : {std::string("torso.hips/auto_hip.tweak"), kControl}) {
    test::Pose pose = seated(rig, true, false);
    const double up = hips_in(rig, pose).x.y;
    pose.rotate(control, {0, 0, 15});
    CHECK(hips_in(rig, pose).x.y > up + 0.2);
  }
}

TEST_CASE("modules auto_hip: wherever a leg goes the hips follow without a jump") {
  const test::Rig rig(test::legs("", 1, kHips));
  test::Random random(5);
  const Vec3 hip{0.1, 0.9, 0};
  for (int i = 0; i < 12; ++i) {
    const math::Mat3 axes = math::matrix(random.rotation());
    math::Mat3 last;
    double most = 0;
    for (int step = 0; step <= 360; ++step) {
      test::Pose pose(rig);
      pose.move_to(
          kLeft, hip + (axes.x * math::cos_degrees(step) + axes.y * math::sin_degrees(step)) * 0.6);
      const math::Mat3 now = hips_in(rig, pose);
      if (step > 0) most = std::max(most, test::difference({now, {}}, {last, {}}, 1));
      last = now;
    }
    CHECK(most < 0.03);
  }
}

TEST_CASE("modules auto_hip: mirrored legs turn the hips the mirrored way, on every model alike") {
  const test::Rig plain(test::legs("", 1, kHips));
  const auto left = test::motion(plain, seated(plain, true, false));
  const auto right = test::motion(plain, seated(plain, false, true));
  CHECK(test::motion_difference(plain, test::mirror_image(plain, left), right) < 1e-9);
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(test::legs("", 1, kHips), model.change);
    CHECK(test::motion_difference(rig, test::motion(rig, seated(rig, true, false, model.by)),
                                  test::mapped(model.by, left)) < 1e-6);
  }
}

TEST_CASE("modules auto_hip: works together with what moves feet and knees") {
  const test::Rig rig(
      test::legs("{command: foot_roll, with: {limb: \"leg_{s}/ik_fk_limb.ik\", tip: "
                 "\"leg_{s}.tip\"}}\n{command: auto_pole, with: "
                 "{limb: \"leg_{s}/ik_fk_limb.ik\", body: \"torso.hips/control#body\"}}",
                 1, kHips));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  CHECK(test::rest_error(rig) < 1e-9);
  CHECK(hips_in(rig, seated(rig, true, false)).x.y > 0.05);
}

TEST_CASE("modules auto_hip: hips have one, and legs are limbs") {
  std::string again = kHips;
  again.replace(again.find("auto_hip,"), 9, "auto_hip, id: again,");
  CHECK(test::codes(test::Rig(test::legs("", 1, kHips + "\n" + again)).diagnostics) == "RIG0464");
  const std::string wrong =
      "{command: auto_hip, with: {hips: \"./control#hips\", limbs: \"./control#hips\"}}";
  CHECK(test::codes(test::Rig(test::legs("", 1, wrong)).diagnostics) == "RIG0498");
}

TEST_CASE("modules auto_hip: feet may be named where goals depend on the hips") {
  const std::string named =
      "{command: auto_hip, with: {hips: \"./control#hips\", limbs: [leg_l/ik_fk_limb.ik, "
      "leg_r/ik_fk_limb.ik], feet: [\"./control#body\", leg_r/ik_fk_limb.ik]}}";
  const test::Rig rig(test::legs("", 1, named)), usual(test::legs("", 1, kHips));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  CHECK(test::rest_error(rig) < 1e-9);
  // The left foot named is one that stays; the right one goes with its control.
  CHECK(std::abs(hips_in(rig, seated(rig, true, false)).x.y) < 1e-9);
  const math::Mat3 lifted = hips_in(rig, seated(rig, false, true));
  const math::Mat3 expected = hips_in(usual, seated(usual, false, true));
  CHECK(test::difference({lifted, {}}, {expected, {}}, 1) < 1e-6);
}
