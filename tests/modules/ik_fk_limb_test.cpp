// SPDX-License-Identifier: MIT
// ik_fk_limb: an arm or leg as an animator has it, by FK, by IK and between.
#include <doctest/doctest.h>

#include "modules/bodies_helpers.h"
#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

std::string limb_command(const std::string& group, const std::string& more) {
  return "{command: ik_fk_limb, with: {start: ., middle: " + group + ".lower, end: " + group +
         ".end" + more + "}}";
}

test::Commands arms_and_legs(double ik_fk) {
  const std::string blend = ", ik_fk: " + std::to_string(ik_fk);
  test::Commands commands{{"root", "{command: root, with: {drive: on}}"},
                          {"hips", "{command: control, with: {}}"}};
  for (const std::string s : {"l", "r"}) {
    commands["upperarm_" + s] = limb_command("arm_" + s, ", bend: backward" + blend);
    commands["thigh_" + s] = limb_command("leg_" + s, ", bend: forward" + blend);
  }
  return commands;
}

const std::string kFoot = "leg_l/ik_fk_limb.ik";
const std::string kKnee = "leg_l/ik_fk_limb.pole";
const std::string kSwitch = "leg_l/ik_fk_limb.settings@ik_fk";

double length_error(const test::Rig& rig, const test::Pose& pose) {
  return test::largest_difference(test::bone_lengths(rig, pose.joints()),
                                  test::bone_lengths(rig, test::Pose(rig).joints())) /
         rig.skeleton.character.height;
}

}  // namespace

TEST_CASE("modules ik_fk_limb: at rest nothing moves, whatever the switch") {
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    for (const double ik_fk : {0.0, 0.3, 1.0}) {
      CAPTURE(ik_fk);
      const test::Rig rig(test::body(arms_and_legs(ik_fk)), model.change);
      INFO(test::text(rig.diagnostics));
      REQUIRE(rig.clean());
      CHECK(test::rest_error(rig) < 1e-9);
    }
  }
}

TEST_CASE("modules ik_fk_limb: the switch blends, and its ends are FK and IK alone") {
  const test::Rig rig(test::body(arms_and_legs(0)));
  const auto posed = [&](double ik_fk) {
    test::Pose pose(rig);
    pose.rotate("leg_l.upper/ik_fk_limb.fk", {0, 0, 40}).translate(kFoot, {0.1, 0.2, 0.2});
    pose.set(kSwitch, ik_fk);
    return pose;
  };
  const Vec3 fk = posed(0).position("leg_l.end");
  const Vec3 ik = posed(1).position("leg_l.end");
  CHECK(test::distance(ik, {0.2, 0.28, 0.2}) < 1e-5);
  CHECK(test::distance(fk, ik) > 0.2);
  double last = 0;
  for (const double blend : {0.25, 0.5, 0.75, 1.0}) {
    const double moved = test::distance(posed(blend).position("leg_l.end"), fk);
    CHECK(moved > last);
    last = moved;
    CHECK(length_error(rig, posed(blend)) < 1e-9);
  }
}

TEST_CASE("modules ik_fk_limb: feet and hands reach their controls, on every model") {
  const std::map<std::string, std::vector<Vec3>> goals{
      {"leg_l", {{0.15, 0.3, 0.2}, {0.1, 0.12, -0.1}, {0.4, 0.6, 0.3}}},
      {"arm_r", {{-0.3, 1.2, 0.3}, {-0.5, 1.7, 0.1}, {0.1, 1.4, 0.35}}}};
  const test::Rig plain(test::body(arms_and_legs(1)));
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(test::body(arms_and_legs(1)), model.change);
    for (const auto& [group, points] : goals) {
      for (const Vec3 point : points) {
        test::Pose pose(rig), expected(plain);
        pose.move_to(group + "/ik_fk_limb.ik", model.by * point);
        expected.move_to(group + "/ik_fk_limb.ik", point);
        const double height = rig.skeleton.character.height;
        CHECK(test::distance(pose.position(group + ".end"), model.by * point) < 5e-6 * height);
        CHECK(length_error(rig, pose) < 1e-9);
        CHECK(test::motion_difference(rig, test::motion(rig, pose),
                                      test::mapped(model.by, test::motion(plain, expected))) <
              1e-7);
      }
    }
  }
}

TEST_CASE("modules ik_fk_limb: exactly straight for what is out of reach") {
  const test::Rig rig(test::body(arms_and_legs(1)));
  for (const Vec3 point : {Vec3{0.1, -1, 0}, Vec3{0.9, 0.2, 0.8}, Vec3{0.1, 0.03, 0.2}}) {
    test::Pose pose(rig);
    pose.move_to(kFoot, point);
    const Vec3 hip = pose.position("leg_l.upper"), foot = pose.position("leg_l.end");
    const Vec3 knee = pose.position("leg_l.lower");
    CHECK(math::length(math::cross(math::normalised(foot - hip), knee - hip)) < 1e-9);
    CHECK(length_error(rig, pose) < 1e-9);
  }
}

TEST_CASE("modules ik_fk_limb: moving the pole turns the knee toward it, the foot stays") {
  const test::Rig rig(test::body(arms_and_legs(1)));
  test::Pose pose(rig);
  pose.translate(kFoot, {0, 0.25, 0});
  const Vec3 foot = pose.position("leg_l.end");
  CHECK(pose.position("leg_l.lower").z > 0.15);
  pose.move_to(kKnee, {1, 0.5, 0});
  CHECK(pose.position("leg_l.lower").x > 0.2);
  CHECK(test::distance(pose.position("leg_l.end"), foot) < 1e-9);
}

TEST_CASE("modules ik_fk_limb: the end turns with its IK control, in its own orientation") {
  const test::Rig rig(test::body(arms_and_legs(1)), [](auto& s) { test::turn_axes(s, 9); });
  test::Pose pose(rig);
  const math::Quat turn = math::from_euler_degrees({30, 20, 10});
  pose.turn_in_world(kFoot, turn);
  const auto motion = test::motion(rig, pose);
  const int foot = rig.skeleton.find(rig.scene()[rig.node("leg_l.end")].identity.owner);
  CHECK(test::difference({motion[static_cast<std::size_t>(foot)].linear, {}}, math::rotation(turn),
                         1) < 1e-9);
}

TEST_CASE("modules ik_fk_limb: FK bends the limb and never stretches it") {
  const test::Rig plain(test::body(arms_and_legs(0)));
  const auto pose_fk = [](const test::Rig& rig, const math::Affine& by) {
    test::Pose pose(rig);
    pose.turn_in_world("arm_l.upper/ik_fk_limb.fk",
                       test::mapped(by, math::from_euler_degrees({10, 20, 50})));
    pose.turn_in_world("arm_l.lower/ik_fk_limb.fk",
                       test::mapped(by, math::from_euler_degrees({0, -60, 0})));
    pose.turn_in_world("arm_l.end/ik_fk_limb.fk",
                       test::mapped(by, math::from_euler_degrees({15, 0, 0})));
    return pose;
  };
  const auto expected = test::motion(plain, pose_fk(plain, {}));
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(test::body(arms_and_legs(0)), model.change);
    const test::Pose pose = pose_fk(rig, model.by);
    CHECK(test::motion_difference(rig, test::motion(rig, pose), test::mapped(model.by, expected)) <
          1e-9);
    CHECK(length_error(rig, pose) < 1e-9);
  }
}

TEST_CASE("modules ik_fk_limb: twists turn bones about themselves") {
  const test::Rig rig(test::body(arms_and_legs(1)));
  test::Pose bent(rig);
  for (const std::string group : {"arm_l", "arm_r"})
    bent.translate(group + "/ik_fk_limb.ik", {-0.1, 0.1, 0.2});
  test::Pose twisted = bent;
  for (const std::string group : {"arm_l", "arm_r"}) {
    twisted.set(group + "/ik_fk_limb.ik@upper_twist", 30.0);
    twisted.set(group + "/ik_fk_limb.ik@lower_twist", -75.0);
  }
  for (int side = 0; side < 2; ++side) {
    const std::string group = side == 0 ? "arm_l" : "arm_r";
    const Vec3 points[] = {bent.position(group + ".upper"), bent.position(group + ".lower"),
                           bent.position(group + ".end")};
    const char* joints[] = {".upper", ".lower", ".end"};
    for (int i = 0; i < 3; ++i)
      CHECK(test::distance(twisted.position(group + joints[i]), points[i]) < 1e-9);
    for (int i = 0; i < 2; ++i) {
      const math::Mat3 turn =
          math::orthonormal(twisted.world(group + joints[i]).linear) *
          math::transposed(math::orthonormal(bent.world(group + joints[i]).linear));
      const math::Quat q = math::quaternion(turn);
      const Vec3 bone = math::normalised(points[i + 1] - points[i]);
      const double angle = 2 * math::degrees(math::atan2(math::dot({q.x, q.y, q.z}, bone), q.w));
      CHECK(angle == doctest::Approx((i == 0 ? 30 : -75)));
    }
  }
}

TEST_CASE("modules ik_fk_limb: IK controls stay where they are while the body moves") {
  const test::Rig rig(test::body(arms_and_legs(1)));
  test::Pose pose(rig);
  pose.translate("torso.hips/control", {0.05, -0.3, 0.05});
  CHECK(test::distance(pose.position("leg_l.end"), {0.1, 0.08, 0}) < 1e-5);
  CHECK(test::distance(pose.position("leg_r.end"), {-0.1, 0.08, 0}) < 1e-5);
  CHECK(pose.position("leg_l.lower").z > 0.1);  // knees forward
  CHECK(test::distance(pose.position("arm_l.end"), {0.73, 1.42, 0}) < 0.2);
}

TEST_CASE("modules ik_fk_limb: a straight limb bends to its stated side") {
  for (const auto& [side, sign] : {std::pair{"forward", 1.0}, {"backward", -1.0}}) {
    const test::Rig rig(
        test::limb("[0, 1, 0]", "[0, 0.5, 0]", "[0, 0.1, 0]",
                   {{"base", "{command: control, with: {}}"},
                    {"upper", limb_command("limb", std::string(", ik_fk: 1, bend: ") + side)}}));
    REQUIRE(rig.clean());
    CHECK(test::rest_error(rig) < 1e-9);
    CHECK(rig.rest("limb/ik_fk_limb.pole").origin.z * sign > 0.3);
    test::Pose pose(rig);
    pose.translate("limb/ik_fk_limb.ik", {0, 0.3, 0});
    CHECK(pose.position("limb.lower").z * sign > 0.2);
    CHECK(test::distance(pose.position("limb.end"), {0, 0.4, 0}) < 1e-5);
  }
}

TEST_CASE("modules ik_fk_limb: the pole rests in the limb's plane, where it leaves it unmoved") {
  const test::Rig rig(test::body(arms_and_legs(1)));
  for (const std::string group : {"arm_l", "arm_r", "leg_l"}) {
    const Vec3 upper = rig.rest(group + ".upper").origin, lower = rig.rest(group + ".lower").origin;
    const Vec3 end = rig.rest(group + ".end").origin;
    const Vec3 pole = rig.rest(group + "/ik_fk_limb.pole").origin;
    const Vec3 normal = math::normalised(math::cross(end - upper, lower - upper));
    CHECK(std::abs(math::dot(normal, pole - upper)) < 1e-9);
  }
}

TEST_CASE("modules ik_fk_limb: a limb that hangs on no joint moves with the root") {
  std::string text = test::template_of(R"(joints:
  - name: upper
    at: [0, 1, 0]
    local: limb
    label: upper
    tags:
      - {command: root, with: {}}
      - {command: ik_fk_limb, with: {start: ., middle: limb.lower, end: limb.end, ik_fk: 1}}
  - {name: lower, parent: upper, at: [0, 0.5, 0.1], local: limb, label: lower}
  - {name: end, parent: lower, at: [0, 0.1, 0], local: limb, label: end}
)");
  const test::Rig rig(text);
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  CHECK(test::rest_error(rig) < 1e-9);
  test::Pose pose(rig);
  pose.translate("limb/root.world", {1, 2, 3});
  for (const math::Affine& motion : test::motion(rig, pose)) {
    CHECK(test::difference(motion, math::translation({1, 2, 3}), 1) < 1e-9);
  }
  pose.set("limb/root.world@master_scale", 2.0);
  // The root rests on the ground, which is at the end's height.
  CHECK(test::distance(pose.position("limb.end"), {1, 2.1, 3}) < 1e-9);
  CHECK(test::distance(pose.position("limb.upper"), {1, 3.9, 3}) < 1e-9);
}

TEST_CASE("modules ik_fk_limb: controls that have no part in the pose are hidden where asked") {
  const auto shown = [](const test::Pose& pose) {
    std::string text;
    for (const char* control :
         {"limb.upper/ik_fk_limb.fk", "limb.lower/ik_fk_limb.fk", "limb.end/ik_fk_limb.fk",
          "limb/ik_fk_limb.ik", "limb/ik_fk_limb.pole", "limb/ik_fk_limb.settings"})
      text += pose.number(std::string(control) + "@visible") == 1 ? "1" : "0";
    return text;
  };
  const test::Rig rig(test::limb("[0, 1, 0]", "[0, 0.5, 0.1]", "[0, 0.1, 0]",
                                 {{"upper", limb_command("limb", ", hide: true")}}));
  REQUIRE(rig.clean());
  test::Pose pose(rig);
  CHECK(shown(pose) == "111001");
  pose.set("limb/ik_fk_limb.settings@ik_fk", 0.5);
  CHECK(shown(pose) == "111111");
  pose.set("limb/ik_fk_limb.settings@ik_fk", 1.0);
  CHECK(shown(pose) == "000111");
}

TEST_CASE("modules ik_fk_limb: the FK elbow bends the limb in its plane about one axis") {
  // Planes that no axis of the character lies in.
  for (const char* middle : {"[0.1, 0.5, 0.1]", "[-0.02, 0.52, 0.1]", "[0.07, 0.5, -0.05]"}) {
    CAPTURE(middle);
    const test::Rig rig(test::limb("[0, 1, 0]", middle, "[0.03, 0.1, 0.02]",
                                   {{"upper", limb_command("limb", "")}}));
    REQUIRE(rig.clean());
    test::Pose pose(rig);
    const auto place = [&](const char* joint) { return pose.position(joint); };
    const math::Vec3 start = place("limb.upper");
    const math::Vec3 normal =
        math::normalised(math::cross(place("limb.lower") - start, place("limb.end") - start));
    const math::Vec3 before = place("limb.end");
    for (const double angle : {-40.0, 25.0, 80.0}) {
      pose.set("limb.lower/ik_fk_limb.fk@rotate", math::Vec3{0, 0, angle});
      CHECK(test::distance(place("limb.end"), before) > 0.1);
      CHECK(std::abs(math::dot(place("limb.end") - start, normal)) < 1e-9);
    }
  }
}
