// SPDX-License-Identifier: MIT
// control: what an animator sees of one control at a joint.
#include <doctest/doctest.h>

#include "modules/bodies_helpers.h"
#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

const test::Commands kControls{
    {"hips", "{command: control, with: {shape: square}}"},
    {"head", "{command: control, with: {translate: off}}"},
};

const std::string kHips = "torso.hips/control";
const std::string kHead = "head.head/control";

std::vector<double> numbers(const test::Rig& rig, const std::string& plug) {
  return std::get<std::vector<double>>(rig.scene().value(rig.plug(plug)));
}

/// Middle of the box around a control's shape, control space.
Vec3 middle(const test::Rig& rig, const std::string& control) {
  const std::vector<double> points = numbers(rig, control + "@points");
  Vec3 low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
  for (std::size_t at = 0; at < points.size();) {
    const auto count = static_cast<std::size_t>(points[at++]);
    for (std::size_t i = 0; i < count; ++i, at += 3) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], points[at + axis]);
        high[axis] = std::max(high[axis], points[at + axis]);
      }
    }
  }
  return (low + high) * 0.5;
}

}  // namespace

TEST_CASE("modules control: rests at identity under its zero") {
  const test::Rig rig(test::body(kControls));
  REQUIRE(rig.clean());
  for (const std::string& control : {kHips, kHead}) {
    CHECK(rig.scene().local(rig.node(control)) == math::Trs{});
    CHECK(rig.scene()[rig.node(control)].parent == rig.node(control + ".zero"));
  }
  CHECK(test::distance(rig.rest(kHips).origin, {0, 0.95, 0}) < 1e-12);
}

TEST_CASE("modules control: the joint and all below follow it") {
  const test::Rig rig(test::body(kControls));
  test::Pose pose(rig);
  pose.translate(kHips, {0.1, 0.2, 0.3}).rotate(kHips, {0, 90, 0});
  CHECK(test::distance(pose.position("torso.hips"), {0.1, 1.15, 0.3}) < 1e-12);
  // A quarter turn about up brings the left hand, 0.73 to the left, to the back.
  CHECK(test::distance(pose.position("arm_l.end"), {0.1, 1.62, 0.3 - 0.73}) < 1e-12);
  const auto rest = test::bone_lengths(rig, test::Pose(rig).joints());
  auto moved = test::bone_lengths(rig, pose.joints());
  moved[1] = rest[1];  // the hips themselves were moved
  CHECK(test::largest_difference(moved, rest) < 1e-12);
}

TEST_CASE("modules control: a control hangs under the control of the joint above") {
  const test::Rig rig(test::body(kControls));
  CHECK(rig.scene()[rig.node(kHead + ".zero")].parent == rig.node(kHips));
  test::Pose pose(rig);
  pose.rotate(kHips, {0, 0, 90}).rotate(kHead, {30, 0, 0});
  // The head turned by 30 degrees about what was left and is up now.
  const math::Affine head = pose.world("head.head");
  CHECK(test::distance(head.linear.x, {0, 1, 0}) < 1e-12);
}

TEST_CASE("modules control: what cannot be keyed is said and not driven") {
  const test::Rig rig(test::body({{"hips", "{command: control, with: {scale: on}}"},
                                  {"head", "{command: control, with: {translate: off}}"}}));
  CHECK(rig.scene().number(rig.plug(kHips + "@keyable")) == 7);
  CHECK(rig.scene().number(rig.plug(kHead + "@keyable")) == 2);
  // Even a value that finds its way onto the translation moves the shape, not the joint.
  test::Pose pose(rig);
  pose.translate(kHead, {0, 1, 0});
  CHECK(test::distance(pose.position("head.head"), {0, 1.6, 0.02}) < 1e-12);
}

TEST_CASE("modules control: scale reaches the joint and what hangs on it") {
  const test::Rig rig(test::body({{"hips", "{command: control, with: {scale: on}}"}}));
  test::Pose pose(rig);
  pose.set(kHips + "@scale", Vec3{2, 2, 2});
  CHECK(test::distance(pose.position("head.head"), {0, 0.95 + 2 * 0.65, 0.04}) < 1e-9);
}

TEST_CASE("modules control: drive off leaves the joint alone") {
  const test::Rig rig(test::body({{"hips", "{command: control, with: {drive: off}}"}}));
  test::Pose pose(rig);
  pose.translate(kHips, {1, 0, 0});
  CHECK(test::distance(pose.position("torso.hips"), {0, 0.95, 0}) < 1e-12);
  CHECK(rig.nodes("torso.hips/control.driver").empty());
}

TEST_CASE("modules control: a parent that is a joint is followed, not hung under") {
  const test::Rig rig(test::body({{"hips", "{command: control, with: {}}"},
                                  {"hand_l",
                                   "{command: control, id: grip, with: {drive: off, "
                                   "parent: .}}"}}));
  REQUIRE(rig.clean());
  const std::string grip = "arm_l.end/control#grip";
  CHECK(rig.scene()[rig.node(grip + ".zero")].parent != rig.node("arm_l.end"));
  test::Pose pose(rig);
  pose.translate(kHips, {0, 0.5, 0}).rotate(kHips, {0, 90, 0});
  CHECK(test::distance(pose.position(grip), pose.position("arm_l.end")) < 1e-12);
}

TEST_CASE("modules control: orient says the axes") {
  const auto axes = [](const std::string& orient) {
    const test::Rig rig(
        test::body({{"upperarm_l", "{command: control, with: {orient: " + orient + "}}"}}),
        [](auto& s) { test::turn_axes(s, 5); });
    REQUIRE(rig.clean());
    const math::Mat3 found = rig.rest("arm_l.upper/control").linear;
    const math::Mat3 joint = math::orthonormal(rig.rest("arm_l.upper").linear);
    return std::pair{found, joint};
  };
  const auto near = [](const math::Mat3& a, const math::Mat3& b) {
    return test::difference({a, {}}, {b, {}}, 1) < 1e-9;
  };
  CHECK(near(axes("character").first, {}));
  CHECK(near(axes("world").first, {}));
  const auto [found, joint] = axes("joint");
  CHECK(near(found, joint));
  const math::Mat3 bone = axes("bone").first;
  CHECK(test::distance(bone.x, math::normalised(Vec3{0.28, -0.01, -0.03})) < 1e-9);
  CHECK(bone.y.z > 0.99);  // toward the front
}

TEST_CASE("modules control: colour by side, or as written") {
  const std::string control = "{command: control, with: {}}";
  const test::Rig rig(
      test::body({{"hand_l", control},
                  {"hand_r", control},
                  {"hips", control},
                  {"head", "{command: control, with: {color: green}}"},
                  {"chest", "{command: control, with: {color: [0.1, 0.2, 0.3]}}"}}));
  const auto color = [&](const std::string& joint) {
    return std::get<Vec3>(rig.scene().value(rig.plug(joint + "/control@color")));
  };
  CHECK(color("arm_l.end").z > 0.9);  // blue
  CHECK(color("arm_r.end").x > 0.9);  // red
  CHECK(color("arm_r.end").y < 0.3);
  CHECK(color("torso.hips").x > 0.9);  // yellow
  CHECK(color("torso.hips").y > 0.7);
  CHECK(color("head.head") == Vec3{0.2, 0.75, 0.25});
  CHECK(color("torso.chest") == Vec3{0.1, 0.2, 0.3});
}

TEST_CASE("modules control: sides are the character's, whatever way it faces") {
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(test::body({{"hand_l", "{command: control, with: {}}"}}), model.change);
    CHECK(std::get<Vec3>(rig.scene().value(rig.plug("arm_l.end/control@color"))).z > 0.9);
  }
}

TEST_CASE("modules control: size, axis and offset place the shape, not the pivot") {
  const auto rig_with = [](const std::string& with) {
    return test::body({{"hips", "{command: control, with: " + with + "}"}});
  };
  const test::Rig plain(rig_with("{shape: circle, size: 0.4, axis: z, offset: [0, 0.1, 0.2]}"));
  CHECK(test::distance(middle(plain, kHips), {0, 0.1, 0.2}) < 1e-9);
  CHECK(test::distance(plain.rest(kHips).origin, {0, 0.95, 0}) < 1e-12);
  const std::vector<double> points = numbers(plain, kHips + "@points");
  double widest = 0;
  for (std::size_t i = 1; i + 2 < points.size(); i += 3) {
    widest = std::max(widest, std::abs(points[i]));
    CHECK(std::abs(points[i + 2] - 0.2) < 1e-9);  // flat across z
  }
  CHECK(widest > 0.19);
  CHECK(widest < 0.21);

  const test::Rig large(rig_with("{shape: circle, size: 0.4, offset: [0, 0.1, 0]}"),
                        [](auto& s) { test::transform(s, test::similarity(100, {})); });
  CHECK(test::distance(middle(large, kHips), {0, 10, 0}) < 1e-6);
}

TEST_CASE("modules control: a template brings shapes of its own") {
  const std::string shapes = "shapes: {tick: {lines: [[[0, 0, 0], [0, 0, 1]]]}}\n";
  std::string text = test::body({{"hips", "{command: control, with: {shape: tick, size: 2}}"}});
  text.insert(text.find("joints:"), shapes);
  const test::Rig rig(text);
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  CHECK(numbers(rig, kHips + "@points") == std::vector<double>{2, 0, 0, 0, 0, 0, 2});
}

TEST_CASE("modules control: a name is for the control alone") {
  const test::Rig rig(test::body(
      {{"hips", "{command: control, with: {name: body_ctl, local: main, label: body}}"}}));
  const scene::Node& control = rig.scene()[rig.node("main.body/control")];
  CHECK(control.name == "body_ctl");
  CHECK(rig.scene()[control.parent].name == "body_ctl_control_zero");
  CHECK(control.ids == Identifiers{"test", "main", "body"});
}
