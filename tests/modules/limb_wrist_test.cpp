// SPDX-License-Identifier: MIT
// limb_wrist: a hand that stays as it is turned, or goes with the forearm.
#include <doctest/doctest.h>

#include "modules/bodies_helpers.h"
#include "support/models.h"

using namespace rigc;

namespace {

test::Commands arms(double ik_fk) {
  test::Commands commands{{"root", "{command: root, with: {drive: on}}"},
                          {"hips", "{command: control, with: {}}"}};
  for (const std::string s : {"l", "r"})
    commands["upperarm_" + s] =
        "{command: ik_fk_limb, with: {start: ., middle: arm_" + s + ".lower, end: arm_" + s +
        ".end, bend: backward, ik_fk: " + std::to_string(ik_fk) +
        "}}\n{command: limb_wrist, with: {limb: arm_" + s + "/ik_fk_limb.ik}}";
  return commands;
}

/// The hand as the forearm sees it.
math::Mat3 seen(const test::Pose& pose, const std::string& group) {
  return math::transposed(math::orthonormal(pose.world(group + ".lower").linear)) *
         math::orthonormal(pose.world(group + ".end").linear);
}

double apart(const math::Mat3& a, const math::Mat3& b) {
  return test::difference({a, {}}, {b, {}}, 1);
}

}  // namespace

TEST_CASE("modules limb_wrist: the hand goes with the forearm at 1, with its control at 0") {
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    for (const double ik_fk : {0.0, 0.4, 1.0}) {
      const test::Rig rig(test::body(arms(ik_fk)), model.change);
      INFO(test::text(rig.diagnostics));
      REQUIRE(rig.clean());
      CHECK(test::rest_error(rig) < 1e-9);
    }
    const test::Rig rig(test::body(arms(1)), model.change);
    const test::Pose rest(rig);
    for (const std::string group : {"arm_l", "arm_r"}) {
      const std::string ik = group + "/ik_fk_limb.ik";
      test::Pose pose(rig);
      pose.move_to(ik, model.by * math::Vec3{group == "arm_l" ? 0.4 : -0.4, 1.6, 0.3});
      const math::Affine still = rest.world(group + ".end");
      CHECK(apart(math::orthonormal(pose.world(group + ".end").linear),
                  math::orthonormal(still.linear)) < 1e-9);
      const math::Vec3 place = pose.position(group + ".end");
      pose.set(ik + "@wrist", 1.0);
      CHECK(apart(seen(pose, group), seen(rest, group)) < 1e-9);
      CHECK(test::distance(pose.position(group + ".end"), place) == 0);
      // Turned from there by the control: as far as by the control alone.
      const math::Mat3 before = math::orthonormal(pose.world(group + ".end").linear);
      pose.rotate(ik, {0, 50, 0});
      const math::Quat turn = math::quaternion(
          math::orthonormal(pose.world(group + ".end").linear) * math::transposed(before));
      CHECK(2 * math::degrees(math::acos(std::abs(turn.w))) == doctest::Approx(50).epsilon(1e-6));
    }
  }
}

TEST_CASE("modules limb_wrist: FK is as it was, and a limb gets one") {
  const test::Rig rig(test::body(arms(0)));
  test::Pose pose(rig);
  pose.rotate("arm_l.lower/ik_fk_limb.fk", {0, 0, 40}).set("arm_l/ik_fk_limb.ik@wrist", 1.0);
  CHECK(apart(seen(pose, "arm_l"), seen(test::Pose(rig), "arm_l")) < 1e-9);
  test::Commands twice = arms(0);
  twice["upperarm_l"] += "\n{command: limb_wrist, id: two, with: {limb: arm_l/ik_fk_limb.ik}}";
  CHECK(test::codes(test::Rig(test::body(twice)).diagnostics) == "RIG0464");
}
