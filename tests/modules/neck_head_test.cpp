// SPDX-License-Identifier: MIT
// neck_head: a head that turns as its control says, on a neck that goes along.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

/// A chest, a neck of some joints and a head.
std::string figure(int neck, const std::string& with = "") {
  return test::template_of(
      "joints:\n"
      "  - {name: root, at: [0, 0, 0], local: root, label: root,"
      " tags: [{command: root, with: {drive: on}}]}\n"
      "  - {name: chest, parent: root, at: [0, 1.3, 0], local: torso, label: chest,"
      " tags: [{command: control, with: {}}]}\n" +
      (neck == 0 ? std::string()
                 : fmt::format("  - {{name: neck, parent: chest, at: [0, 1.45, -0.03], local: neck,"
                               " chain: {{count: {}, to: [0, 1.52, 0]}}}}\n",
                               neck)) +
      fmt::format("  - {{name: head, parent: {}, at: [0, 1.6, 0.02], local: head, label: head,"
                  " tags: [{{command: neck_head, with: {{neck: \"neck[*]?\"{}}}}}]}}\n",
                  neck == 0 ? "chest" : "neck", with));
}

const std::string kHead = "head.head/neck_head", kChest = "torso.chest/control";
std::string fk(int i) { return fmt::format("neck[{}]/neck_head.fk", i); }

/// What a joint was turned by, rig space.
math::Mat3 turn(const test::Rig& rig, const test::Pose& pose, const std::string& joint) {
  return (pose.world(joint) * math::inverse(rig.rest(joint))).linear;
}
double apart(const math::Mat3& a, const math::Mat3& b) {
  return test::difference({a, {}}, {b, {}}, 1);
}
math::Mat3 matrix(Vec3 degrees) { return math::matrix(math::from_euler_degrees(degrees)); }

}  // namespace

TEST_CASE("modules neck_head: the head turns by its control, the neck shares, on every model") {
  for (const int count : {0, 1, 3}) {
    CAPTURE(count);
    const math::Quat turned = math::from_euler_degrees({20, 50, -15});
    for (const test::Model& model : test::models()) {
      CAPTURE(model.name);
      const test::Rig rig(figure(count), model.change);
      INFO(test::text(rig.diagnostics));
      REQUIRE(rig.clean());
      CHECK(test::rest_error(rig) < 1e-9);
      test::Pose pose(rig);
      pose.turn_in_world(kHead, test::mapped(model.by, turned));
      const auto motion = test::mapped(math::inverse(model.by), test::motion(rig, pose));
      CHECK(apart(motion.back().linear, math::matrix(turned)) < 1e-9);
      for (int i = 0; i < count; ++i) {
        const math::Quat share = math::slerp({}, turned, 0.4 * (i + 1) / count);
        CHECK(apart(motion[static_cast<std::size_t>(2 + i)].linear, math::matrix(share)) < 1e-9);
      }
    }
  }
}

TEST_CASE("modules neck_head: without a bend the head turns alone, with it it leans forward too") {
  const test::Rig rig(figure(2));
  test::Pose pose(rig);
  pose.rotate(kHead, {40, 0, 0});
  const Vec3 bent = pose.position("head.head");
  pose.set(kHead + "@neck_bend", 0.0);
  CHECK(test::distance(pose.position("head.head"), rig.rest("head.head").origin) < 1e-12);
  CHECK(bent.z > rig.rest("head.head").origin.z + 0.01);
}

TEST_CASE("modules neck_head: the neck's controls take the head along") {
  const test::Rig rig(figure(2));
  test::Pose pose(rig);
  pose.turn_in_world(fk(0), math::from_euler_degrees({30, 0, 0}));
  CHECK(apart(turn(rig, pose, "head.head"), matrix({30, 0, 0})) < 1e-12);
  // However much of the head's turn the neck takes, the head turns from there.
  pose.turn_in_world(kHead, math::from_euler_degrees({0, 60, 10}));
  const math::Mat3 expected = matrix({30, 0, 0}) * matrix({0, 60, 10});
  for (const double bend : {0.0, 0.5, 1.0}) {
    pose.set(kHead + "@neck_bend", bend);
    CHECK(apart(turn(rig, pose, "head.head"), expected) < 1e-12);
  }
}

TEST_CASE("modules neck_head: the chest takes all along, and a larger character does the same") {
  const test::Rig rig(figure(2));
  test::Pose pose(rig);
  pose.rotate(kChest, {10, 40, 5}).rotate(kHead, {0, 30, 0});
  pose.set("root.root/root.world@master_scale", 2.0);
  const math::Mat3 expected = matrix({10, 40, 5}) * matrix({0, 30, 0});
  const math::Mat3 found = turn(rig, pose, "head.head");
  CHECK(apart({found.x * 0.5, found.y * 0.5, found.z * 0.5}, expected) < 1e-9);
}
