// SPDX-License-Identifier: MIT
// foot_roll: what a foot does on the ground, as an animator sees it.
#include <doctest/doctest.h>

#include "modules/legs_helpers.h"
#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

const std::string kRoll =
    "{command: foot_roll, with: {limb: \"leg_{s}/ik_fk_limb.ik\", toes: \"leg_{s}.ball/control\", "
    "tip: \"leg_{s}.tip\"}}";
const std::string kFoot = "leg_l/ik_fk_limb.ik";

/// A pose with these attributes of both feet; the feet are raised, so that the legs reach.
test::Pose rolled(const test::Rig& rig, const std::map<std::string, double>& values,
                  const math::Affine& by = {}) {
  test::Pose pose(rig);
  const double size = math::cbrt(std::abs(math::determinant(by.linear)));
  for (const std::string foot : {"leg_l/ik_fk_limb.ik", "leg_r/ik_fk_limb.ik"}) {
    const Vec3 rest = rig.rest(foot).origin;
    const Vec3 up = rig.skeleton.character.up * (0.2 * size);
    pose.move_to(foot, rest + up);
    for (const auto& [name, value] : values) pose.set(foot + "@" + name, value);
  }
  return pose;
}

/// Points of the sole at rest: round the heel with the foot, round the tip with the toes; and where
/// they are in a pose, with 0.2 for how far the foot was raised taken off.
struct SolePoint {
  std::string joint;
  Vec3 at;
};
std::vector<SolePoint> sole_points() {
  return {{"leg_l.end", {0.10, 0, -0.07}}, {"leg_l.end", {0.085, 0, 0.08}},
          {"leg_l.end", {0.15, 0, 0.08}},  {"leg_l.ball", {0.09, 0, 0.12}},
          {"leg_l.ball", {0.16, 0, 0.12}}, {"leg_l.ball", {0.134, 0, 0.18}}};
}
std::vector<Vec3> sole_in(const test::Rig& rig, const test::Pose& pose) {
  std::vector<Vec3> out;
  for (const SolePoint& point : sole_points()) {
    const Vec3 now = pose.world(point.joint) * (math::inverse(rig.rest(point.joint)) * point.at);
    out.push_back(now - Vec3{0, 0.2, 0});
  }
  return out;
}

}  // namespace

TEST_CASE("modules foot_roll: at rest nothing moves, in IK and in FK") {
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    for (const double ik_fk : {0.0, 0.5, 1.0}) {
      const test::Rig rig(test::legs(kRoll, ik_fk), model.change);
      INFO(test::text(rig.diagnostics));
      REQUIRE(rig.clean());
      CHECK(test::rest_error(rig) < 1e-9);
    }
  }
}

TEST_CASE("modules foot_roll: rolling back stands on the heel, the toes point up") {
  const test::Rig rig(test::legs(kRoll));
  const test::Pose pose = rolled(rig, {{"roll", -30}});
  const auto sole = sole_in(rig, pose);
  CHECK(std::abs(sole[0].y) < 0.006);
  CHECK(sole[5].y > 0.1);
  CHECK(sole[3].y > 0.06);
}

TEST_CASE("modules foot_roll: up to the break the heel rises and the toes stay flat") {
  const test::Rig rig(test::legs(kRoll));
  const test::Pose rest = rolled(rig, {});
  const test::Pose pose = rolled(rig, {{"roll", 30}});
  CHECK(test::difference(pose.world("leg_l.ball"), rest.world("leg_l.ball"), 1) < 1e-9);
  CHECK(pose.position("leg_l.end").y > rest.position("leg_l.end").y + 0.04);
  CHECK(sole_in(rig, pose)[0].y > 0.07);
}

TEST_CASE("modules foot_roll: beyond the straight angle the foot stands on its tip, unbent") {
  const test::Rig rig(test::legs(kRoll));
  const test::Pose rest = rolled(rig, {}), pose = rolled(rig, {{"roll", 70}});
  CHECK(test::distance(pose.position("leg_l.tip"), rest.position("leg_l.tip")) < 1e-9);
  const auto bend = [&](const test::Pose& at) {
    return math::inverse(at.world("leg_l.end")) * at.world("leg_l.ball");
  };
  CHECK(test::difference(bend(pose), bend(rest), 1) < 1e-9);
  CHECK(pose.position("leg_l.ball").y > rest.position("leg_l.ball").y + 0.06);
}

TEST_CASE("modules foot_roll: break and straight are attributes that the animator moves") {
  const test::Rig rig(test::legs(kRoll));
  const test::Pose rest = rolled(rig, {});
  const test::Pose pose = rolled(rig, {{"roll", 50}, {"roll_break", 50}, {"roll_straight", 80}});
  CHECK(test::difference(pose.world("leg_l.ball"), rest.world("leg_l.ball"), 1) < 1e-9);
  const test::Pose past = rolled(rig, {{"roll", 50}, {"roll_break", 50}, {"roll_straight", 10}});
  CHECK(test::difference(past.world("leg_l.ball"), rest.world("leg_l.ball"), 1) < 1e-9);
}

TEST_CASE(
    "modules foot_roll: one way the foot tilts over its outer edge, the other over its inner") {
  const test::Rig rig(test::legs(kRoll));
  for (const double bank : {25.0, -25.0}) {
    const auto sole = sole_in(rig, rolled(rig, {{"bank", bank}}));
    const double inner = sole[3].y, outer = sole[4].y;
    CHECK((bank > 0 ? inner - outer : outer - inner) > 0.02);
    for (const Vec3& point : sole) CHECK(point.y > -1e-9);
  }
}

TEST_CASE("modules foot_roll: toes tap and the foot lifts over its tip") {
  const test::Rig rig(test::legs(kRoll));
  const test::Pose rest = rolled(rig, {});
  const test::Pose tapped = rolled(rig, {{"toe_tap", 30}});
  CHECK(tapped.position("leg_l.tip").y > rest.position("leg_l.tip").y + 0.03);
  CHECK(test::difference(tapped.world("leg_l.end"), rest.world("leg_l.end"), 1) < 1e-9);
  const test::Pose lifted = rolled(rig, {{"toe_lift", 30}});
  CHECK(test::distance(lifted.position("leg_l.tip"), rest.position("leg_l.tip")) < 1e-9);
  CHECK(lifted.position("leg_l.end").y > rest.position("leg_l.end").y + 0.05);
}

TEST_CASE("modules foot_roll: spins turn the foot on the ground, toes outward") {
  const test::Rig rig(test::legs(kRoll));
  const test::Pose rest = rolled(rig, {});
  for (const std::string spin : {"heel_spin", "ball_spin", "toe_spin"}) {
    CAPTURE(spin);
    const test::Pose pose = rolled(rig, {{spin, 20}});
    for (const Vec3& point : sole_in(rig, pose)) CHECK(std::abs(point.y) < 1e-9);
    const Vec3 was = rest.position("leg_l.tip") - rest.position("leg_l.end");
    const Vec3 is = pose.position("leg_l.tip") - pose.position("leg_l.end");
    CHECK(is.x > was.x + 0.04);
  }
  CHECK(test::distance(rolled(rig, {{"toe_spin", 20}}).position("leg_l.tip"),
                       rest.position("leg_l.tip")) < 1e-9);
  CHECK(test::distance(rolled(rig, {{"ball_spin", 20}}).position("leg_l.ball"),
                       rest.position("leg_l.ball")) < 1e-9);
}

TEST_CASE(
    "modules foot_roll: whatever is combined up to a quarter turn, no point of the sole sinks into "
    "the ground") {
  const test::Rig rig(test::legs(kRoll));
  test::Random random(6);
  for (int i = 0; i < 300; ++i) {
    std::map<std::string, double> values{{"roll", random.number(-60, 50)},
                                         {"bank", random.number(-40, 40)},
                                         {"toe_lift", random.number(0, 40)}};
    for (const char* spin : {"heel_spin", "ball_spin", "toe_spin"})
      values[spin] = random.number(-40, 40);
    const auto sole = sole_in(rig, rolled(rig, values));
    // 0.5 % of the foot's length.
    for (const Vec3& point : sole) CHECK(point.y > -0.005 * 0.26);
  }
}

TEST_CASE(
    "modules foot_roll: the toes' control bends the toes in FK and, on top of the roll, in IK") {
  for (const double ik_fk : {0.0, 1.0}) {
    const test::Rig rig(test::legs(kRoll, ik_fk));
    const test::Pose before = rolled(rig, {{"roll", 30}});
    test::Pose pose = before;
    pose.rotate("leg_l.ball/control", {-40, 0, 0});
    CHECK(pose.position("leg_l.tip").y > before.position("leg_l.tip").y + 0.03);
    CHECK(test::difference(pose.world("leg_l.end"), before.world("leg_l.end"), 1) < 1e-9);
  }
  const test::Rig fk(test::legs(kRoll, 0));
  test::Pose pose(fk);
  pose.rotate("leg_l.end/ik_fk_limb.fk", {0, 0, 35});
  const auto bend = [](const test::Pose& at) {
    return math::inverse(at.world("leg_l.end")) * at.world("leg_l.ball");
  };
  CHECK(test::difference(bend(pose), bend(test::Pose(fk)), 1) < 1e-9);
}

TEST_CASE("modules foot_roll: equal values mirror each other, on every model alike") {
  const std::map<std::string, double> values{{"roll", 40},      {"bank", 15},     {"toe_tap", 10},
                                             {"heel_spin", 12}, {"ball_spin", 8}, {"toe_spin", -5}};
  const test::Rig plain(test::legs(kRoll), test::mirror_right_side);
  const auto expected = test::motion(plain, rolled(plain, values));
  CHECK(test::motion_difference(plain, test::mirror_image(plain, expected), expected) < 1e-9);
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(test::legs(kRoll), [&](tags::TaggedSkeleton& skeleton) {
      test::mirror_right_side(skeleton);
      if (model.change) model.change(skeleton);
    });
    CHECK(test::motion_difference(rig, test::motion(rig, rolled(rig, values, model.by)),
                                  test::mapped(model.by, expected)) < 1e-7);
  }
}

TEST_CASE("modules foot_roll: a foot without toes rolls from its tip") {
  const test::Rig rig(test::legs(
      "{command: foot_roll, with: {limb: \"leg_{s}/ik_fk_limb.ik\", tip: \"leg_{s}.tip\"}}"));
  REQUIRE(rig.clean());
  CHECK(test::rest_error(rig) < 1e-9);
  const test::Pose rest = rolled(rig, {}), pose = rolled(rig, {{"roll", 20}});
  CHECK(test::distance(pose.position("leg_l.tip"), rest.position("leg_l.tip")) < 1e-9);
  CHECK(pose.position("leg_l.end").y > rest.position("leg_l.end").y + 0.04);
}

TEST_CASE("modules foot_roll: a foot that grows with the character rolls over its own heel") {
  const test::Rig rig(test::legs(kRoll));
  test::Pose pose = rolled(rig, {{"roll", -30}}), large = pose;
  large.set("root/root.world@master_scale", 2.0);
  for (const std::string joint : {"leg_l.end", "leg_l.ball", "leg_l.tip"})
    CHECK(test::distance(large.position(joint), pose.position(joint) * 2) < 1e-9);
}

TEST_CASE("modules foot_roll: a limb rolls once") {
  const test::Rig rig(test::legs(kRoll + "\n{command: foot_roll, id: again, with: {limb: "
                                         "\"leg_{s}/ik_fk_limb.ik\"}}"));
  CHECK(test::codes(rig.diagnostics) == "RIG0464");
}
