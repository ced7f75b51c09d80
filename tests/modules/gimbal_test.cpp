// SPDX-License-Identifier: MIT
// gimbal: a second turn under a control, and everything that hung on the control takes both.
#include <doctest/doctest.h>

#include "modules/bodies_helpers.h"
#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

test::Commands arms() {
  test::Commands commands{{"root", "{command: root, with: {drive: on}}"},
                          {"chest", "{command: control, with: {}}"}};
  for (const std::string s : {"l", "r"}) {
    commands["upperarm_" + s] = "{command: ik_fk_limb, with: {start: ., middle: arm_" + s +
                                ".lower, end: arm_" + s + ".end, bend: backward}}\n" +
                                "{command: gimbal, with: {control: ./ik_fk_limb.fk}}";
  }
  return commands;
}

std::string fk(const std::string& side, const std::string& label) {
  return "arm_" + side + "." + label + "/ik_fk_limb.fk";
}
std::string gimbal(const std::string& side) { return "arm_" + side + ".upper/gimbal"; }

}  // namespace

TEST_CASE("modules gimbal: the arm takes the control's turn, then the gimbal's, on every model") {
  const math::Quat first = math::from_euler_degrees({20, -40, 70});
  const math::Quat second = math::from_euler_degrees({-15, 30, 10});
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(test::body(arms()), model.change);
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    CHECK(test::rest_error(rig) < 1e-9);
    test::Pose both(rig), one(rig);
    both.turn(fk("l", "upper"), first).turn(gimbal("l"), second);
    one.turn(fk("l", "upper"), first * second);
    both.rotate(fk("l", "lower"), {0, 0, 35});
    one.rotate(fk("l", "lower"), {0, 0, 35});
    CHECK(test::motion_difference(rig, test::motion(rig, both), test::motion(rig, one)) < 1e-9);
  }
}

TEST_CASE("modules gimbal: hidden until asked for, and the controls under it are not") {
  const test::Rig rig(test::body(arms()));
  test::Pose pose(rig);
  CHECK(pose.number(gimbal("l") + "@visible") == 0);
  CHECK(pose.set(fk("l", "upper") + "@gimbal_visible", 1.0).number(gimbal("l") + "@visible") == 1);
  const scene::NodeId hidden = rig.node(gimbal("l"));
  for (scene::NodeId at = rig.node(fk("l", "lower")); at.valid(); at = rig.scene()[at].parent) {
    const bool under = at == hidden;
    CHECK_FALSE(under);
  }
}

TEST_CASE("modules gimbal: equal values on both sides are mirror images") {
  const test::Rig rig(test::body(arms()), test::mirror_right_side);
  REQUIRE(rig.clean());
  CHECK(rig.scene()[rig.node(gimbal("l"))].identity.role == "control");
  test::Pose pose(rig);
  for (const std::string s : {"l", "r"}) {
    pose.rotate(fk(s, "upper"), {10, 20, 30}).rotate(gimbal(s), {-40, 15, 25});
  }
  const auto motion = test::motion(rig, pose);
  CHECK(test::motion_difference(rig, motion, test::mirror_image(rig, motion)) < 1e-9);
  const auto opposite =
      std::get<std::string>(rig.scene().value({rig.node(gimbal("l")), scene::control::kOpposite}));
  CHECK(opposite == to_text(rig.scene()[rig.node(gimbal("r"))].identity));
}

TEST_CASE("modules gimbal: matching FK and IK still keys the control itself") {
  const test::Rig rig(test::body(arms()));
  const auto source =
      rig.scene().source({rig.node("arm_l.end/ik_fk_limb.driver::match"), scene::match::kFk, 0});
  REQUIRE(source);
  const bool same = source->node == rig.node(fk("l", "upper"));
  CHECK(same);
}
