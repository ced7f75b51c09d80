// SPDX-License-Identifier: MIT
// decompose: how far a forearm has turned and moved from rest, in parts.
#include <doctest/doctest.h>

#include "support/models.h"

using namespace rigc;
using math::Quat;
using math::Vec3;

namespace {

/// A bone along X with a control of its own axes, on a base that moves.
std::string bone(const std::string& with) {
  return test::template_of(R"(joints:
  - {name: root, at: [0, 0, 0], local: c, label: root, tags: [{command: root, with: {}}]}
  - name: base
    parent: root
    at: [0, 1, 0]
    local: c
    label: base
    tags: [{command: control, with: {}}]
  - name: lower
    parent: base
    at: [0.3, 1.2, 0.1]
    local: c
    label: lower
    tags:
      - {command: control, with: {}}
      - {command: decompose, with: {)" +
                           with + R"(}}
  - {name: hand, parent: lower, at: [0.7, 1.2, 0.1], local: c, label: hand}
)");
}

const std::string kLower = "c.lower/control", kRead = "c.lower/decompose@";

Quat angles(Vec3 degrees) { return math::from_euler_degrees(degrees); }

Quat turned(const test::Pose& pose, const std::string& name) {
  return angles(pose.vector(kRead + name));
}

double apart(Quat a, Quat b) {
  return math::length({math::length(math::matrix(a).x - math::matrix(b).x),
                       math::length(math::matrix(a).y - math::matrix(b).y), 0});
}

}  // namespace

TEST_CASE("modules decompose: nothing at rest, wherever the base goes and however large") {
  const test::Rig rig(bone(""));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  test::Pose pose(rig);
  pose.translate("c.base/control", {1, 2, 3}).rotate("c.base/control", {30, 40, 50});
  pose.set("c.root/root.world@master_scale", 2.5);
  CHECK(test::distance(pose.vector(kRead + "translate"), {}) < 1e-12);
  CHECK(test::distance(pose.vector(kRead + "scale"), {1, 1, 1}) < 1e-12);
  CHECK(test::distance(pose.vector(kRead + "angles"), {}) < 1e-10);
  CHECK(test::distance(pose.vector(kRead + "swing_angles"), {}) < 1e-10);
  CHECK(std::abs(pose.number(kRead + "twist")) < 1e-10);
}

TEST_CASE("modules decompose: twist and swing about each axis") {
  const Vec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int axis = 0; axis < 3; ++axis) {
    const std::string name(1, static_cast<char>('x' + axis));
    const test::Rig rig(bone("orient: character, axis: " + name));
    for (const double degrees : {-170.0, -40.0, 5.0, 120.0}) {
      const Vec3 across = axes[(axis + 1) % 3] * 0.6 + axes[(axis + 2) % 3] * 0.8;
      const Quat swing = math::axis_angle(across, 1.2);
      const Quat twist = math::axis_angle(axes[axis], math::radians(degrees));
      test::Pose pose(rig);
      pose.turn(kLower, swing * twist);
      CHECK(std::abs(pose.number(kRead + "twist") - degrees) < 1e-9);
      CHECK(apart(turned(pose, "swing_angles"), swing) < 1e-9);
    }
  }
}

TEST_CASE("modules decompose: angles in every order") {
  const Vec3 degrees{20, -50, 130};
  for (const std::string order : {"xyz", "yzx", "zxy", "xzy", "yxz", "zyx"}) {
    CAPTURE(order);
    const test::Rig rig(bone("orient: character, order: " + order));
    Quat turn;
    for (const char c : order) {
      Vec3 one;
      one[static_cast<std::size_t>(c - 'x')] = degrees[static_cast<std::size_t>(c - 'x')];
      turn = angles(one) * turn;
    }
    test::Pose pose(rig);
    pose.turn(kLower, turn);
    // The middle angle stays within 90 degrees of either side, so that the three may be others of
    // the same turn: put together they are the turn.
    const Vec3 found = pose.vector(kRead + "angles");
    Quat again;
    for (const char c : order) {
      Vec3 one;
      one[static_cast<std::size_t>(c - 'x')] = found[static_cast<std::size_t>(c - 'x')];
      again = angles(one) * again;
    }
    CHECK(apart(again, turn) < 1e-9);
    CHECK(std::abs(found[static_cast<std::size_t>(order[1] - 'x')]) <= 90 + 1e-9);
  }
}

TEST_CASE("modules decompose: a move is told in the axes that are asked for") {
  const test::Rig rig(bone("orient: character"));
  test::Pose pose(rig);
  pose.translate(kLower, {0.1, 0.2, -0.3}).set("c.root/root.world@master_scale", 3.0);
  CHECK(test::distance(pose.vector(kRead + "translate"), {0.1, 0.2, -0.3}) < 1e-12);
  // x along the bone, which is the file's x, and y toward the front.
  const test::Rig along(bone("orient: bone"));
  test::Pose moved(along);
  moved.translate(kLower, {0.1, 0.2, 0.3});
  CHECK(test::distance(moved.vector(kRead + "translate"), {0.1, 0.3, -0.2}) < 1e-12);
}

TEST_CASE("modules decompose: the same on every model") {
  const Quat turn = angles({40, 20, -30});
  const test::Rig plain(bone(""));
  test::Pose expected(plain);
  expected.turn_in_world(kLower, turn);
  const double sign[] = {1, -1};
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(bone(""), model.change);
    test::Pose pose(rig);
    pose.turn_in_world(kLower, test::mapped(model.by, turn));
    // In a mirrored space every rotation goes the other way round.
    const double way = sign[math::determinant(model.by.linear) < 0];
    CHECK(std::abs(pose.number(kRead + "twist") - way * expected.number(kRead + "twist")) < 1e-8);
  }
}
