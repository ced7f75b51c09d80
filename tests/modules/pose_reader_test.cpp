// SPDX-License-Identifier: MIT
// pose_reader: weights of poses of an arm, for correctives.
#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

/// A chest and two arms that point outward; each shoulder holds the command.
std::string arms(const std::string& with) {
  const auto arm = [&](const std::string& side, const std::string& x, const std::string& far) {
    return R"(
  - name: upper_)" +
           side + R"(
    parent: chest
    at: [)" +
           x + R"(, 1.4, 0]
    local: arm_)" +
           side + R"(
    label: upper
    tags:
      - {command: control, with: {orient: bone, translate: off}}
      - {command: attribute, with: {attribute: bulge, default: 2}}
      - {command: pose_reader, with: {)" +
           with + R"(}}
  - {name: lower_)" +
           side + R"(, parent: )" + "upper_" + side + ", at: [" + far + ", 1.4, 0], local: arm_" +
           side + ", label: lower}";
  };
  return test::template_of(
      "joints:\n  - {name: root, at: [0, 0, 0], local: c, label: root, tags: "
      "[{command: root, with: {}}]}\n"
      "  - {name: chest, parent: root, at: [0, 1.3, 0], local: c, label: "
      "chest, tags: [{command: control, with: {}}]}" +
      arm("l", "0.2", "0.5") + arm("r", "-0.2", "-0.5") + "\n");
}

const std::string kPoses =
    "poses: [[0, 1, 0], [0, 0, 1], [0, -1, 0]], names: [raised, forward, lowered]";
const std::vector<std::string> kNames{"raised", "forward", "lowered"};

const std::string kArm = "arm_l.upper/control";

std::vector<double> weights(const test::Pose& pose, const std::string& arm = "arm_l") {
  std::vector<double> all;
  for (const std::string& name : kNames)
    all.push_back(pose.number(arm + ".upper/pose_reader@" + name));
  return all;
}

/// The left arm turned from its rest, in the axes of the file.
std::vector<double> posed(const test::Rig& rig, math::Quat turn) {
  test::Pose pose(rig);
  pose.turn_in_world(kArm, turn);
  return weights(pose);
}

math::Quat about(Vec3 axis, double degrees) {
  return math::axis_angle(axis, math::radians(degrees));
}
const Vec3 kUp{0, 0, 1}, kForward{0, -1, 0};  // what turns the left arm up, and forward

double apart(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

}  // namespace

TEST_CASE("modules pose_reader: cones say how near the arm is to each pose") {
  const test::Rig rig(arms(kPoses + ", angle: 60, inner: 10"));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  CHECK(apart(posed(rig, {}), {0, 0, 0}) < 1e-12);
  CHECK(apart(posed(rig, about(kUp, 90)), {1, 0, 0}) < 1e-12);
  CHECK(apart(posed(rig, about(kForward, 90)), {0, 1, 0}) < 1e-12);
  CHECK(apart(posed(rig, about(kUp, -90)), {0, 0, 1}) < 1e-12);
  CHECK(apart(posed(rig, about(kUp, 81)), {1, 0, 0}) < 1e-12);
  CHECK(apart(posed(rig, about(kUp, 55)), {0.5, 0, 0}) < 1e-9);
  CHECK(apart(posed(rig, about(kUp, 29.9)), {0, 0, 0}) < 1e-12);
  // Turning about itself changes nothing.
  CHECK(apart(posed(rig, about(kUp, 55) * about({1, 0, 0}, 70)), {0.5, 0, 0}) < 1e-9);
}

TEST_CASE("modules pose_reader: radial weights are 1 at their pose, 0 at the others and at rest") {
  const test::Rig rig(arms(kPoses + ", method: radial"));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  CHECK(apart(posed(rig, {}), {0, 0, 0}) < 1e-9);
  CHECK(apart(posed(rig, about(kUp, 90)), {1, 0, 0}) < 1e-9);
  CHECK(apart(posed(rig, about(kForward, 90)), {0, 1, 0}) < 1e-9);
  CHECK(apart(posed(rig, about(kUp, -90)), {0, 0, 1}) < 1e-9);
  // All directions of a swing: between 0 and 1, never more than 1 in all, no jumps.
  std::vector<double> before;
  for (int i = 0; i <= 720; ++i) {
    const auto now = posed(rig, about(kUp, 40 * math::sin(0.02 * i)) * about(kForward, 0.5 * i));
    double sum = 0;
    for (const double weight : now) {
      CHECK(weight >= 0);
      sum += weight;
    }
    CHECK(sum < 1 + 1e-9);
    if (!before.empty()) CHECK(apart(now, before) < 0.05);
    before = now;
  }
}

TEST_CASE("modules pose_reader: rotations, with the turn about the bone") {
  const test::Rig rig(
      arms("poses: [[0, 0, 90], [0, 0, -60], [80, 0, 0]], names: [raised, forward, lowered],"
           " reads: rotation, method: radial"));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  CHECK(apart(posed(rig, {}), {0, 0, 0}) < 1e-9);
  CHECK(apart(posed(rig, about({0, 0, 1}, 90)), {1, 0, 0}) < 1e-9);
  CHECK(apart(posed(rig, about({0, 0, 1}, -60)), {0, 1, 0}) < 1e-9);
  CHECK(apart(posed(rig, about({1, 0, 0}, 80)), {0, 0, 1}) < 1e-9);
  CHECK(posed(rig, about({1, 0, 0}, 40))[2] > 0.3);
}

TEST_CASE("modules pose_reader: only the arm's own motion counts, and size does not") {
  for (const char* method : {"cone", "radial"}) {
    const test::Rig rig(arms(kPoses + ", method: " + method));
    test::Pose alone(rig), carried(rig);
    const math::Quat turn = about(kUp, 50) * about(kForward, 30);
    alone.turn_in_world(kArm, turn);
    carried.turn_in_world(kArm, turn);
    carried.rotate("c.chest/control", {30, 70, -20}).translate("c.chest/control", {1, 2, 3});
    carried.set("c.root/root.world@master_scale", 3.0);
    CHECK(apart(weights(alone), weights(carried)) < 1e-9);
    CHECK(weights(alone)[0] > 0.05);
  }
}

TEST_CASE("modules pose_reader: equal keys on both sides give equal weights, on every model") {
  const std::string yaml = arms(kPoses + ", method: radial");
  const test::Rig plain(yaml, [](auto& s) { test::mirror_right_side(s); });
  for (const Vec3 degrees : {Vec3{0, 40, 0}, {10, -50, 30}, {0, 20, 70}}) {
    test::Pose pose(plain);
    pose.rotate("arm_l.upper/control", degrees).rotate("arm_r.upper/control", degrees);
    CHECK(apart(weights(pose, "arm_l"), weights(pose, "arm_r")) < 1e-9);
  }
  const test::Rig usual(yaml);
  for (const Vec3 axis : {kUp, kForward}) {  // mirrored poses of joints that say nothing of it
    test::Pose pose(usual);
    pose.turn_in_world(kArm, about(axis, 50))
        .turn_in_world("arm_r.upper/control", about(-axis, 50));
    CHECK(apart(weights(pose, "arm_l"), weights(pose, "arm_r")) < 1e-9);
    CHECK(apart(weights(pose), weights(test::Pose(usual))) > 0.1);
  }
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(yaml, model.change);
    for (const math::Quat turn : {about(kUp, 50), about(kForward, 80) * about(kUp, -20)}) {
      CHECK(apart(posed(rig, test::mapped(model.by, turn)), posed(usual, turn)) < 1e-9);
    }
  }
}

TEST_CASE("modules pose_reader: weights drive attributes on top of what they rest at") {
  const test::Rig rig(
      arms("poses: [[0, 1, 0]], names: raised, to: ./control@bulge, amounts: [-30]"));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  test::Pose pose(rig);
  CHECK(pose.number(kArm + "@bulge") == 2);
  pose.turn_in_world(kArm, about(kUp, 90));
  CHECK(std::abs(pose.number(kArm + "@bulge") - -28) < 1e-9);
}

TEST_CASE("modules pose_reader: poses and names that do not fit") {
  const auto codes = [](const std::string& with) {
    return test::codes(test::Rig(arms(with)).diagnostics).substr(0, 7);
  };
  CHECK(codes("poses: [[0, 1]], names: a") == "RIG0872");
  CHECK(codes("poses: [[0, 1, 0], [0, 2, 0]], names: [a, b], method: radial") == "RIG0872");
  CHECK(codes("poses: [[0, 1, 0]], names: [a, b]") == "RIG0870");
  CHECK(codes("poses: [[0, 1, 0]], names: [_a]") == "RIG0870");
  CHECK(codes("poses: [[0, 1, 0]], names: [a-b]") == "RIG0870");
  CHECK(codes("poses: [[0, 1, 0]], names: a, angle: 20, inner: 30") == "RIG0490");
  CHECK(codes("poses: [[0, 1, 0]], names: a, to: ./control@bulge, amounts: [1, 2]") == "RIG0872");
}
