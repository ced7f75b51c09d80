// SPDX-License-Identifier: MIT
// auto_clavicle: the shoulder goes along with the arm as far as its extremes say, by FK and by IK.
#include <doctest/doctest.h>

#include <algorithm>

#include "modules/bodies_helpers.h"
#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

const char* const kDegrees = ", up: 30, down: 8, forward: 20, back: 10";

test::Commands arms(double ik_fk, const std::string& arm = "ik_fk_limb") {
  test::Commands commands{{"root", "{command: root, with: {drive: on}}"},
                          {"chest", "{command: control, with: {}}"}};
  const bool limb = arm == "ik_fk_limb";
  for (const std::string s : {"l", "r"}) {
    const std::string group = "arm_" + s;
    commands["clavicle_" + s] = "{command: clavicle, with: {}}";
    commands["upperarm_" + s] =
        limb ? "{command: ik_fk_limb, with: {start: ., middle: " + group + ".lower, end: " + group +
                   ".end, bend: backward, ik_fk: " + std::to_string(ik_fk) + "}}\n"
             : "{command: fk_chain, with: {joints: [., " + group + ".lower, " + group + ".end]}}\n";
    commands["upperarm_" + s] += "{command: gimbal, with: {control: ./" + arm + ".fk}}\n" +
                                 "{command: auto_clavicle, with: {control: " + group +
                                 ".clavicle/clavicle, limb: ./" + arm + ".fk" + kDegrees + "}}";
  }
  return commands;
}

const Vec3 kRestArm{0.28, -0.01, -0.03}, kShoulder{0.18, 1.44, 0};
const std::string kClavicle = "arm_l.clavicle/clavicle";

/// The turn of a clavicle in the chest, on a model that was changed by `by`: degrees up and forward
/// of a left one.
struct Shrug {
  double up = 0, forward = 0;
};
Shrug shrug(const test::Rig& rig, const test::Pose& pose, const math::Affine& by = {}) {
  const auto motion = [&](const std::string& joint) {
    return math::inverse(by) * pose.world(joint) * math::inverse(rig.rest(joint)) * by;
  };
  const math::Affine own = math::inverse(motion("torso.chest")) * motion("arm_l.clavicle");
  const Vec3 out = math::normalised(own.linear * Vec3{1, 0, 0});
  return {math::degrees(std::asin(out.y)), math::degrees(std::asin(out.z))};
}

/// The left arm, by FK, to where it would point if the clavicle were at rest.
test::Pose& point_fk(test::Pose& pose, const math::Affine& by, Vec3 direction,
                     const std::string& arm = "ik_fk_limb") {
  const math::Quat turn = math::between(math::normalised(kRestArm), math::normalised(direction));
  return pose.turn_in_world("arm_l.upper/" + arm + ".fk", test::mapped(by, turn));
}

/// By IK: nearly stretched out that way.
test::Pose& point_ik(test::Pose& pose, const math::Affine& by, Vec3 direction) {
  return pose.move_to("arm_l/ik_fk_limb.ik", by * (kShoulder + math::normalised(direction) * 0.55));
}

struct Extreme {
  Vec3 arm;
  double up, forward;
};
const Extreme kExtremes[] = {{{0, 1, 0}, 30, 0},     {{0, -1, 0}, -8, 0}, {{0, 0, 1}, 0, 20},
                             {{0, 0, -1}, 0, -10},   {{1, 0, 0}, 0, 0},   {{1, 1, 0}, 15, 0},
                             {{0, 1, 1}, 23.5, 15.5}};

double turned(const math::Affine& a, const math::Affine& b) {
  const double trace = math::dot(a.linear.x, b.linear.x) + math::dot(a.linear.y, b.linear.y) +
                       math::dot(a.linear.z, b.linear.z);
  return math::degrees(std::acos(std::clamp((trace - 1) / 2, -1.0, 1.0)));
}

}  // namespace

TEST_CASE("modules auto_clavicle: each extreme of the arm turns it by its degrees, FK and IK") {
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    for (const double ik_fk : {0.0, 1.0}) {
      CAPTURE(ik_fk);
      const test::Rig rig(test::body(arms(ik_fk)), model.change);
      INFO(test::text(rig.diagnostics));
      REQUIRE(rig.clean());
      CHECK(test::rest_error(rig) < 1e-9);
      for (const Extreme& extreme : kExtremes) {
        CAPTURE(extreme.arm);
        test::Pose pose(rig);
        ik_fk == 0 ? point_fk(pose, model.by, extreme.arm) : point_ik(pose, model.by, extreme.arm);
        const Shrug found = shrug(rig, pose, model.by);
        // The arm rests a little below and behind the side.
        const double tolerance = ik_fk == 0 ? 0.4 : 2.5;
        CHECK(std::abs(found.up - extreme.up) < tolerance);
        CHECK(std::abs(found.forward - extreme.forward) < tolerance);
      }
    }
  }
}

TEST_CASE("modules auto_clavicle: off it does nothing, halfway half") {
  for (const double ik_fk : {0.0, 1.0}) {
    const test::Rig rig(test::body(arms(ik_fk)));
    test::Pose pose(rig);
    ik_fk == 0 ? point_fk(pose, {}, {0, 1, 0}) : point_ik(pose, {}, {0, 1, 0});
    const Shrug full = shrug(rig, pose);
    CHECK(std::abs(shrug(rig, pose.set(kClavicle + "@auto", 0.0)).up) < 1e-12);
    const Shrug half = shrug(rig, pose.set(kClavicle + "@auto", 0.5));
    CHECK(half.up == doctest::Approx(full.up / 2).epsilon(0.01));
  }
}

TEST_CASE("modules auto_clavicle: an animator's turn comes on top and does not change it") {
  for (const double ik_fk : {0.0, 1.0}) {
    const test::Rig rig(test::body(arms(ik_fk)));
    const auto clavicle = [&](Vec3 keyed) {
      test::Pose pose(rig);
      ik_fk == 0 ? point_fk(pose, {}, {0, 1, 0.5}) : point_ik(pose, {}, {0, 1, 0.5});
      return pose.rotate(kClavicle, keyed).world("arm_l.clavicle");
    };
    const math::Mat3 automatic = clavicle({}).linear, both = clavicle({5, -10, 12}).linear;
    const math::Affine expected{automatic * math::matrix(math::from_euler_degrees({5, -10, 12})),
                                {}};
    CHECK(turned({both, {}}, expected) < 1e-5);
  }
}

TEST_CASE("modules auto_clavicle: in IK the hand stays on its control") {
  const test::Rig rig(test::body(arms(1)));
  test::Pose pose(rig);
  pose.move_to("arm_l/ik_fk_limb.ik", {0.4, 1.7, 0.2});
  CHECK(shrug(rig, pose).up > 3);
  CHECK(test::distance(pose.position("arm_l.end"), {0.4, 1.7, 0.2}) < 1e-9);
  CHECK(pose.position("arm_l.upper").y > 1.445);
}

TEST_CASE("modules auto_clavicle: between FK and IK it blends as the arm does") {
  const test::Rig rig(test::body(arms(0)));
  test::Pose pose(rig);
  point_fk(pose, {}, {0, 1, 0});
  point_ik(pose, {}, {0, -1, 0});
  double last = 35;
  for (const double blend : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    const double up = shrug(rig, pose.set("arm_l/ik_fk_limb.settings@ik_fk", blend)).up;
    CHECK(up < last - 4);
    last = up;
  }
}

TEST_CASE("modules auto_clavicle: small steps of the arm are small steps of the clavicle") {
  const test::Rig fk(test::body(arms(0))), ik(test::body(arms(1)));
  constexpr int kSteps = 720;
  for (const Vec3 axis : {Vec3{0, 0, 1}, Vec3{0, 1, 0}, Vec3{0.6, 0, 0.8}}) {
    CAPTURE(axis);
    double most_fk = 0, most_ik = 0;
    math::Affine last_fk, last_ik;
    for (int i = 0; i <= kSteps; ++i) {
      const math::Quat turn = math::axis_angle(axis, 2 * math::kPi * i / kSteps);
      test::Pose by_fk(fk), by_ik(ik);
      by_fk.turn_in_world("arm_l.upper/ik_fk_limb.fk", turn);
      const Vec3 hand = math::rotate(turn, Vec3{0.45, 0.1, 0.05});
      by_ik.move_to("arm_l/ik_fk_limb.ik", kShoulder + hand);
      by_ik.move_to("arm_l/ik_fk_limb.pole", kShoulder + math::rotate(turn, Vec3{0.28, 0, -0.4}));
      const math::Affine now_fk = by_fk.world("arm_l.clavicle");
      const math::Affine now_ik = by_ik.world("arm_l.clavicle");
      if (i > 0) {
        most_fk = std::max(most_fk, turned(now_fk, last_fk));
        most_ik = std::max(most_ik, turned(now_ik, last_ik));
      }
      last_fk = now_fk;
      last_ik = now_ik;
    }
    // Half a degree of the arm.
    CHECK(most_fk < 0.4);
    CHECK(most_ik < 0.6);
    CHECK(most_fk > 0.01);
  }
}

TEST_CASE("modules auto_clavicle: both sides are mirror images") {
  for (const double ik_fk : {0.0, 0.4, 1.0}) {
    const test::Rig rig(test::body(arms(ik_fk)), test::mirror_right_side);
    REQUIRE(rig.clean());
    test::Pose pose(rig);
    for (const std::string s : {"l", "r"}) {
      pose.rotate("arm_" + s + ".upper/ik_fk_limb.fk", {20, -30, 60});
      pose.translate("arm_" + s + "/ik_fk_limb.ik", {s == "l" ? -0.3 : 0.3, 0.4, 0.2});
    }
    const auto motion = test::motion(rig, pose);
    CHECK(test::motion_difference(rig, motion, test::mirror_image(rig, motion)) < 1e-9);
  }
}

TEST_CASE("modules auto_clavicle: a larger character does the same, turned with its chest") {
  for (const double ik_fk : {0.0, 1.0}) {
    const test::Rig rig(test::body(arms(ik_fk)));
    const auto posed = [&](double scale) {
      test::Pose pose(rig);
      pose.set("root.root/root.world@master_scale", scale);
      pose.rotate("torso.chest/control", {0, 0, 0});
      pose.rotate("arm_l.upper/ik_fk_limb.fk", {10, 20, 40});
      pose.translate("arm_l/ik_fk_limb.ik", {-0.2, 0.4, 0.2});
      return shrug(rig, pose);
    };
    CHECK(posed(2.5).up == doctest::Approx(posed(1).up).epsilon(1e-9));
    CHECK(posed(2.5).forward == doctest::Approx(posed(1).forward).epsilon(1e-9));
  }
}

TEST_CASE("modules auto_clavicle: an arm of FK controls alone, and its gimbal, count too") {
  const test::Rig rig(test::body(arms(0, "fk_chain")));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  test::Pose pose(rig);
  point_fk(pose, {}, {0, 1, 0}, "fk_chain");
  CHECK(shrug(rig, pose).up == doctest::Approx(30).epsilon(0.01));
  test::Pose by_gimbal(rig);
  const math::Quat turn = math::between(math::normalised(kRestArm), Vec3{0, 1, 0});
  by_gimbal.turn_in_world("arm_l.upper/gimbal", turn);
  CHECK(shrug(rig, by_gimbal).up == doctest::Approx(30).epsilon(0.01));
}

// As the chest sees the arm, whatever turned it.
TEST_CASE("modules auto_clavicle: FK controls are read in the space that they follow") {
  for (const std::string arm : {"ik_fk_limb", "fk_chain"}) {
    CAPTURE(arm);
    test::Commands commands = arms(0, arm);
    std::string& text = commands["upperarm_l"];
    const std::string spaces = "{command: space_switch, with: {control: ./" + arm +
                               ".fk, own: chest, spaces: [root.root/root.world], names: [root], "
                               "translate: off}}\n";
    text.insert(text.find("{command: gimbal"), spaces);
    const test::Rig rig(test::body(commands));
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    CHECK(test::rest_error(rig) < 1e-9);
    const std::string control = "arm_l.upper/" + arm + ".fk";
    for (const double space : {0.0, 1.0}) {
      CAPTURE(space);
      for (const Vec3 direction : {Vec3{0, 1, 0}, Vec3{0.2, 0.7, 0.6}}) {
        // The chest alone is turned, so that the arm that stays points there as it sees it.
        const math::Quat turn =
            math::between(math::normalised(kRestArm), math::normalised(direction));
        test::Pose wanted(rig), pose(rig);
        wanted.turn_in_world(control, turn);
        pose.set(control + "@space", space);
        pose.turn_in_world("torso.chest/control", math::conjugate(turn));
        if (space == 0) {
          const Shrug still = shrug(rig, pose), rest = shrug(rig, test::Pose(rig));
          CHECK(std::abs(still.up - rest.up) < 1e-9);
          continue;
        }
        const Shrug found = shrug(rig, pose), as = shrug(rig, wanted);
        CHECK(as.up > 10);
        CHECK(std::abs(found.up - as.up) < 1e-6);
        CHECK(std::abs(found.forward - as.forward) < 1e-6);
        // What an animator turns the shoulder by does not come back.
        const math::Affine before = pose.world("arm_l.upper");
        pose.rotate(kClavicle, {0, 0, 15});
        CHECK(turned(pose.world("arm_l.upper"), before) < 1e-5);
      }
    }
  }
}

TEST_CASE("modules auto_clavicle: a node that is no arm is refused") {
  test::Commands commands = arms(0);
  commands["upperarm_l"] =
      "{command: auto_clavicle, with: {control: arm_l.clavicle/clavicle, limb: .}}";
  const test::Rig rig(test::body(commands));
  CHECK(test::codes(rig.diagnostics) == "RIG0498");
}
