// SPDX-License-Identifier: MIT
// The five constraints: weights, kept offsets, single axes, and weights that animators key.
#include <doctest/doctest.h>

#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

/// Two controls a (left) and b (right) and a joint `c` at [0, 1, 0.5] turned by 30 degrees, which
/// holds `command`.
std::string scene_with(const std::string& command) {
  return test::template_of(R"(joints:
  - {name: a, at: [1, 1, 0], local: ends, label: a, tags: [{command: control, with: {scale: on}}]}
  - {name: b, at: [-1, 1, 0], local: ends, label: b, tags: [{command: control, with: {scale: on}}]}
  - name: c
    at: [0, 1, 0.5]
    rotate: [0, 30, 0]
    local: driven
    label: c
    tags:
      - )" + command + "\n");
}

std::string two(const std::string& module, const std::string& more = {}) {
  return scene_with("{command: " + module + ", with: {targets: [ends.a/control, ends.b/control]" +
                    more + "}}");
}

std::string one(const std::string& module, const std::string& more = {}) {
  return scene_with("{command: " + module + ", with: {targets: ends.a/control" + more + "}}");
}

const std::string kA = "ends.a/control";
const std::string kB = "ends.b/control";
const std::string kC = "driven.c";
const Vec3 kRest{0, 1, 0.5};

math::Mat3 axes(const math::Affine& world) { return math::orthonormal(world.linear); }

bool same(const math::Mat3& a, const math::Mat3& b) {
  return test::difference({a, {}}, {b, {}}, 1) < 1e-9;
}

math::Mat3 turned(Vec3 degrees) { return math::matrix(math::from_euler_degrees(degrees)); }

}  // namespace

TEST_CASE("modules constraints: point follows the weighted mean and keeps its distance") {
  const test::Rig rig(two("point_constraint", ", weights: [3, 1]"));
  REQUIRE(rig.clean());
  CHECK(test::rest_error(rig) < 1e-12);
  test::Pose pose(rig);
  pose.translate(kA, {0, 1, 0}).translate(kB, {0, 0, 4}).rotate(kA, {90, 0, 0});
  // Positions alone count: that a target turns moves nothing.
  CHECK(test::distance(pose.position(kC), kRest + Vec3{0, 0.75, 1}) < 1e-12);
  CHECK(same(axes(pose.world(kC)), turned({0, 30, 0})));
}

TEST_CASE("modules constraints: without the offset it goes to the target") {
  const test::Rig rig(one("point_constraint", ", maintain: off"));
  CHECK(test::distance(test::Pose(rig).position(kC), {1, 1, 0}) < 1e-12);
  const test::Rig orient(one("orient_constraint", ", maintain: off"));
  CHECK(same(axes(test::Pose(orient).world(kC)), {}));
  const test::Rig parent(one("parent_constraint", ", maintain: off"));
  test::Pose pose(parent);
  pose.rotate(kA, {0, 0, 45});
  CHECK(test::difference(pose.world(kC), pose.world(kA), 1) < 1e-12);
}

TEST_CASE("modules constraints: single axes follow, the others stay free") {
  const test::Rig rig(one("point_constraint", ", axes: xz"));
  test::Pose pose(rig);
  pose.translate(kA, {1, 2, 3}).set(kC + "@translate", Vec3{9, 7, 9});
  CHECK(test::distance(pose.position(kC), {1, 7, 3.5}) < 1e-12);

  const test::Rig orient(one("orient_constraint", ", axes: y"));
  CHECK(test::rest_error(orient) < 1e-9);
  test::Pose turn(orient);
  turn.rotate(kA, {0, 40, 0});
  CHECK(same(axes(turn.world(kC)), turned({0, 70, 0})));

  const test::Rig scale(one("scale_constraint", ", axes: x"));
  test::Pose larger(scale);
  larger.set(kA + "@scale", Vec3{2, 2, 2});
  const math::Trs found = math::decompose(larger.world(kC));
  CHECK(test::distance(found.scale, {2, 1, 1}) < 1e-12);
}

TEST_CASE("modules constraints: orient follows the mean rotation and keeps its own") {
  const test::Rig rig(two("orient_constraint"));
  CHECK(test::rest_error(rig) < 1e-12);
  test::Pose pose(rig);
  pose.rotate(kA, {0, 60, 0});
  CHECK(same(axes(pose.world(kC)), turned({0, 60, 0})));  // half of 60, and its own 30
  pose.rotate(kB, {0, 60, 0}).translate(kB, {5, 5, 5});
  CHECK(same(axes(pose.world(kC)), turned({0, 90, 0})));
  CHECK(test::distance(pose.position(kC), kRest) < 1e-12);
}

TEST_CASE("modules constraints: scale follows scales") {
  const test::Rig rig(two("scale_constraint"));
  CHECK(test::rest_error(rig) < 1e-12);
  test::Pose pose(rig);
  pose.set(kA + "@scale", Vec3{4, 4, 4}).set(kB + "@scale", Vec3{4, 4, 4});
  CHECK(test::distance(math::decompose(pose.world(kC)).scale, {4, 4, 4}) < 1e-9);
}

TEST_CASE("modules constraints: parent follows as if it hung there") {
  const test::Rig rig(one("parent_constraint"));
  CHECK(test::rest_error(rig) < 1e-12);
  test::Pose pose(rig);
  pose.translate(kA, {0, 1, 0}).rotate(kA, {0, 90, 0});
  // From a the joint lies 1 to the right and 0.5 ahead; turned by 90 degrees: 0.5 left and 1 ahead.
  CHECK(test::distance(pose.position(kC), {1 + 0.5, 2, 1}) < 1e-12);
  CHECK(same(axes(pose.world(kC)), turned({0, 120, 0})));
}

TEST_CASE("modules constraints: parent takes what it is told to take") {
  const test::Rig rig(one("parent_constraint", ", translate: off, scale: on"));
  test::Pose pose(rig);
  pose.translate(kA, {0, 5, 0}).rotate(kA, {0, 90, 0}).set(kA + "@scale", Vec3{2, 2, 2});
  CHECK(test::distance(pose.position(kC), kRest) < 1e-12);
  CHECK(same(axes(pose.world(kC)), turned({0, 120, 0})));
  CHECK(test::distance(math::decompose(pose.world(kC)).scale, {2, 2, 2}) < 1e-12);
}

TEST_CASE("modules constraints: weights are attributes that animators key") {
  const test::Rig rig(two("parent_constraint",
                          ", weights: [1, 0], weights_on: ends.a/control, weights_name: hold"));
  REQUIRE(rig.clean());
  CHECK(rig.scene().number(rig.plug(kA + "@hold_0")) == 1);
  CHECK(rig.scene().number(rig.plug(kA + "@hold_1")) == 0);
  test::Pose pose(rig);
  pose.translate(kA, {0, 1, 0}).translate(kB, {0, 0, 2});
  CHECK(test::distance(pose.position(kC), kRest + Vec3{0, 1, 0}) < 1e-12);
  pose.set(kA + "@hold_0", 0.0).set(kA + "@hold_1", 1.0);
  CHECK(test::distance(pose.position(kC), kRest + Vec3{0, 0, 2}) < 1e-12);
  pose.set(kA + "@hold_0", 1.0);
  CHECK(test::distance(pose.position(kC), kRest + Vec3{0, 0.5, 1}) < 1e-12);
}

TEST_CASE("modules constraints: aim keeps its rest and looks at where the target goes") {
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(one("aim_constraint"), model.change);
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    CHECK(test::rest_error(rig) < 1e-9);
    const Vec3 goal = model.by * Vec3{0.5, 2, 3};
    test::Pose pose(rig);
    pose.move_to(kA, goal);
    const Vec3 at = rig.rest(kC).origin;
    const math::Affine motion = pose.world(kC) * math::inverse(rig.rest(kC));
    const Vec3 before = math::normalised(rig.rest("ends.a").origin - at);
    CHECK(math::dot(math::normalised(motion.linear * before), math::normalised(goal - at)) >
          1 - 1e-12);
  }
}

TEST_CASE("modules constraints: aim without the offset points a named axis") {
  const test::Rig rig(one("aim_constraint", ", maintain: off, aim: -z, up: +y"));
  test::Pose pose(rig);
  pose.move_to(kA, {0, 4, 4});
  const math::Affine world = pose.world(kC);
  const Vec3 toward = math::normalised(Vec3{0, 4, 4} - kRest);
  CHECK(math::dot(math::normalised(world.linear.z), toward) < -1 + 1e-12);
  CHECK(math::dot(world.linear.y, {0, 1, 0}) > 0.5);
  CHECK(std::abs(world.linear.x.y) < 1e-9);  // not rolled
}

TEST_CASE("modules constraints: aim names its axes by itself, even where one of them is given") {
  // At rest the target lies to the left of the joint and behind it: -z is nearer than any but +x.
  const test::Rig rig(one("aim_constraint", ", maintain: off, up: +x"));
  REQUIRE(rig.clean());
  test::Pose pose(rig);
  pose.move_to(kA, {0, 5, 0.5});
  const math::Affine world = pose.world(kC);
  CHECK(std::abs(world.linear.z.y) > 1 - 1e-9);
}

TEST_CASE("modules constraints: aim may find up by another node") {
  const test::Rig rig(one("aim_constraint",
                          ", up_target: ends.b/control, maintain: off, "
                          "aim: +x, up: +y"));
  test::Pose pose(rig);
  pose.move_to(kA, {5, 1, 0.5}).move_to(kB, {0, 1, 9});
  const math::Affine world = pose.world(kC);
  CHECK(test::distance(world.linear.x, {1, 0, 0}) < 1e-9);
  CHECK(test::distance(world.linear.y, {0, 0, 1}) < 1e-9);
}

TEST_CASE("modules constraints: without any weight all targets count the same") {
  const test::Rig rig(two("aim_constraint", ", weights: [0, 0]"));
  REQUIRE(rig.clean());
  CHECK(test::rest_error(rig) < 1e-9);
  const test::Rig point(two("point_constraint", ", weights: [0, 0]"));
  CHECK(test::rest_error(point) < 1e-9);
}

TEST_CASE("modules constraints: the same world motion under a parent that is turned and scaled") {
  const std::string text = test::template_of(R"(joints:
  - {name: a, at: [1, 1, 0], local: ends, label: a, tags: [{command: control, with: {}}]}
  - {name: holder, at: [0, 0, 1], rotate: [20, 50, 10], scale: [2, 2, 2], local: holder}
  - name: c
    parent: holder
    at: [0, 1, 0.5]
    local: driven
    label: c
    tags: [{command: parent_constraint, with: {targets: ends.a/control}}]
)");
  const test::Rig rig(text);
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  CHECK(test::rest_error(rig) < 1e-9);
  test::Pose pose(rig);
  pose.translate(kA, {0, 1, 2}).rotate(kA, {0, 0, 30});
  const math::Affine by = pose.world(kA) * math::inverse(rig.rest(kA));
  CHECK(test::distance(pose.position(kC), by * rig.rest(kC).origin) < 1e-9);
}
