// SPDX-License-Identifier: MIT
// Transforms whose worlds are computed from others: aim, blend, multiply, pick, hold, compose.
#include <doctest/doctest.h>

#include "support/models.h"

using namespace rigc;
using math::Affine;
using math::Quat;
using math::Vec3;

namespace {

/// Three controls under a root with a master scale; the last joint holds the command.
std::string crane(const std::string& command, const std::string& with) {
  return test::template_of(R"(joints:
  - {name: root, at: [0, 0, 0], local: c, label: root, tags: [{command: root, with: {}}]}
  - {name: a, parent: root, at: [0, 1, 0], local: c, label: a, tags: [{command: control, with: {scale: on}}]}
  - {name: b, parent: root, at: [0.5, 1, 0.2], local: c, label: b, tags: [{command: control, with: {scale: on}}]}
  - name: d
    parent: root
    at: [0, 1.8, 0]
    local: c
    label: d
    tags:
      - {command: control, with: {}}
      - {command: )" + command +
                           ", with: {" + with + "}}\n");
}

const std::string kA = "c.a/control", kB = "c.b/control", kD = "c.d/control";
const std::string kScale = "c.root/root.world@master_scale";

Quat angles(Vec3 degrees) { return math::from_euler_degrees(degrees); }

double error(const Affine& a, const Affine& b) { return test::difference(a, b, 1); }

test::Pose moved(const test::Rig& rig) {
  test::Pose pose(rig);
  pose.translate(kA, {0.3, -0.2, 0.1}).rotate(kA, {20, 40, -60}).set(kA + "@scale", Vec3{2, 2, 2});
  pose.translate(kB, {-0.4, 0.5, 0.6}).rotate(kB, {-30, 10, 80}).translate(kD, {0.2, 0.1, 0.4});
  return pose;
}

}  // namespace

TEST_CASE("modules aim_matrix: x at the primary node, y toward the secondary") {
  const test::Rig rig(crane("aim_matrix",
                            "at: c.a/control, primary: c.b/control, secondary: ./control,"
                            " maintain: off"));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  const std::string made = "c.d/aim_matrix";
  for (const double size : {1.0, 3.0}) {
    test::Pose pose = moved(rig);
    pose.set(kScale, size);
    const Affine found = pose.world(made);
    const Vec3 at = pose.position(kA), x = math::normalised(pose.position(kB) - at);
    CHECK(test::distance(found.origin, at) < 1e-12);
    CHECK(test::distance(math::normalised(found.linear.x), x) < 1e-12);
    CHECK(math::dot(found.linear.y, pose.position(kD) - at) > 0.1);
    CHECK(std::abs(math::dot(found.linear.y, x)) < 1e-12);
    CHECK(std::abs(math::length(found.linear.x) - 2 * size) < 1e-12);  // as large as the node
  }
}

TEST_CASE("modules aim_matrix: rests as its node does, and turns the least way") {
  const std::string yaml =
      crane("aim_matrix", "at: c.a/control, primary: c.b/control, up: up, up_space: ./control");
  const test::Rig plain(yaml);
  REQUIRE(plain.clean());
  CHECK(error(test::Pose(plain).world("c.d/aim_matrix"), plain.rest(kA)) < 1e-12);
  const auto posed = [](const test::Rig& rig, const Affine& by) {
    test::Pose pose(rig);
    pose.move_to(kB, by * Vec3{0.2, 1.4, -0.3});
    pose.turn_in_world(kD, test::mapped(by, angles({0, 0, 30})));
    const Affine rest = rig.rest("c.d/aim_matrix");
    return pose.world("c.d/aim_matrix") * math::inverse(rest);
  };
  const Affine expected = posed(plain, {});
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(yaml, model.change);
    const Affine want = model.by * expected * math::inverse(model.by);
    CHECK(test::difference(posed(rig, model.by), want, rig.skeleton.character.height) <
          1e-9 * rig.skeleton.character.height);
  }
}

TEST_CASE("modules blend_matrix: each takes over from the ones before by its weight") {
  const test::Rig rig(crane("blend_matrix",
                            "targets: [c.a/control, c.b/control, ./control], weights: [1, 0.25, 0],"
                            " weights_on: c.root/root.world"));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  test::Pose pose = moved(rig);
  const math::Trs a = math::decompose(pose.world(kA)), b = math::decompose(pose.world(kB));
  const Affine between =
      math::compose({a.translation * 0.75 + b.translation * 0.25,
                     math::slerp(a.rotation, b.rotation, 0.25), a.scale * 0.75 + b.scale * 0.25});
  CHECK(error(pose.world("c.d/blend_matrix"), between) < 1e-12);
  test::Pose all = moved(rig);
  all.set("c.root/root.world@weight_2", 1.0);
  CHECK(error(all.world("c.d/blend_matrix"), all.world(kD)) < 1e-12);
  test::Pose first = moved(rig);
  first.set("c.root/root.world@weight_1", 0.0);
  CHECK(error(first.world("c.d/blend_matrix"), first.world(kA)) < 1e-12);
}

TEST_CASE("modules blend_matrix: parts alone") {
  const test::Rig rig(crane("blend_matrix", "targets: [c.a/control, c.b/control], translate: off"));
  test::Pose pose = moved(rig);
  const Affine found = pose.world("c.d/blend_matrix");
  CHECK(test::distance(found.origin, pose.position(kA)) < 1e-12);
  CHECK(error({found.linear, {}}, {pose.world(kB).linear, {}}) < 1e-12);
}

TEST_CASE("modules multiply_matrix: what a node does seen from one, under another") {
  const test::Rig rig(
      crane("multiply_matrix", "node: c.b/control, from: c.a/control, under: ./control"));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  test::Pose pose = moved(rig);
  const Affine want = pose.world(kD) * math::inverse(pose.world(kA)) * pose.world(kB);
  CHECK(error(pose.world("c.d/multiply_matrix"), want) < 1e-12);
}

TEST_CASE("modules pick_matrix: some parts, the others as they rest or from another node") {
  const test::Rig rests(crane("pick_matrix", "node: c.a/control, rotate: off, scale: off"));
  INFO(test::text(rests.diagnostics));
  REQUIRE(rests.clean());
  test::Pose pose = moved(rests);
  CHECK(error(pose.world("c.d/pick_matrix"), Affine{{}, pose.position(kA)}) < 1e-12);
  const test::Rig other(
      crane("pick_matrix", "node: c.a/control, translate: off, otherwise: c.b/control"));
  test::Pose both = moved(other);
  CHECK(error(both.world("c.d/pick_matrix"), {both.world(kA).linear, both.position(kB)}) < 1e-12);
}

TEST_CASE("modules hold_matrix: stays where a node rests, in its space") {
  const test::Rig rig(crane("hold_matrix", "node: c.a/control, space: c.b/control"));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  test::Pose pose = moved(rig);
  const Affine want = pose.world(kB) * math::inverse(rig.rest(kB)) * rig.rest(kA);
  CHECK(error(pose.world("c.d/hold_matrix"), want) < 1e-12);
}

TEST_CASE("modules compose: a translation, angles and a scale that attributes give") {
  const test::Rig rig(crane("compose",
                            "translate: c.a/control@translate, rotate:"
                            " c.b/control@rotate, scale: c.a/control@scale,"
                            " under: ./control"));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  test::Pose pose = moved(rig);
  const Affine want =
      pose.world(kD) * math::compose({{0.3, -0.2, 0.1}, angles({-30, 10, 80}), {2, 2, 2}});
  CHECK(error(pose.world("c.d/compose"), want) < 1e-12);
  const test::Rig wrong(crane("compose", "translate: c.a/control@translate.x"));
  CHECK(test::codes(wrong.diagnostics) == "RIG0467");
}

// What is made can be followed like any other node.
TEST_CASE("modules blend_matrix: other commands follow the transform") {
  const test::Rig rig(test::template_of(R"(joints:
  - {name: a, at: [0, 1, 0], local: c, label: a, tags: [{command: control, with: {}}]}
  - {name: b, at: [1, 1, 0], local: c, label: b, tags: [{command: control, with: {}}]}
  - name: d
    at: [0, 2, 0]
    local: c
    label: d
    tags:
      - {command: blend_matrix, with: {targets: [c.a/control, c.b/control], weights: [1, 0.5]}}
      - {command: parent_constraint, with: {targets: ./blend_matrix}}
)"));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  CHECK(test::rest_error(rig) < 1e-12);
  test::Pose pose(rig);
  pose.translate(kA, {0, 0, 2}).translate(kB, {0, 1, 0});
  CHECK(test::distance(pose.position("c.d"), {0, 2.5, 1}) < 1e-12);
}
