// SPDX-License-Identifier: MIT
// ribbon: pinned joints follow a limb, bend with its controls, twist and squash; all of it adds up.
#include <doctest/doctest.h>

#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

std::string arm(const std::string& with = ", count: 5", const std::string& riders = {}) {
  return test::template_of(R"(joints:
  - name: base
    at: [0, 0, 0]
    local: base
    label: base
    tags:
      - {command: root, with: {}}
      - {command: control, with: {}}
  - name: upper
    parent: base
    at: [0, 2, 0]
    local: arm
    label: upper
    tags:
      - {command: ik_fk_limb, with: {start: ., middle: arm.lower, end: arm.end, ik_fk: 0}}
      - {command: ribbon, with: {along: [., arm.lower, arm.end])" +
                           with + R"(}}
  - {name: lower, parent: upper, at: [1, 2, 0], local: arm, label: lower}
  - {name: end, parent: lower, at: [2, 2, 0], local: arm, label: end}
)" + riders);
}

const std::string kRiders =
    R"(  - {name: twist_a, parent: upper, at: [0.5, 2, 0], local: twist, label: a}
  - {name: twist_b, parent: lower, at: [1.5, 2, 0], local: twist, label: b}
)";

/// Of the made joints.
std::vector<math::Affine> pins(const test::Rig& rig, const test::Pose& pose) {
  return pose.worlds(rig.nodes("arm/ribbon.joint"));
}

std::vector<std::string> tweaks() {
  return {"arm/ribbon.tweak[0]", "arm/ribbon.tweak[1]", "arm/ribbon.tweak[2]"};
}

}  // namespace

TEST_CASE("modules ribbon: made joints lie evenly along the limb and follow it") {
  const test::Rig rig(arm());
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  CHECK(test::rest_error(rig) < 1e-9);
  test::Pose pose(rig);
  const auto rest = pins(rig, pose);
  REQUIRE(rest.size() == 5);
  for (std::size_t k = 0; k < 5; ++k)
    CHECK(test::distance(rest[k].origin, {0.5 * static_cast<double>(k), 2, 0}) < 1e-9);
  pose.translate("base/control", {1, 2, 3}).rotate("base/control", {0, 90, 0});
  const auto moved = pins(rig, pose);
  for (std::size_t k = 0; k < 5; ++k)
    CHECK(test::distance(moved[k].origin, {1, 4, 3 - 0.5 * static_cast<double>(k)}) < 1e-9);
}

TEST_CASE("modules ribbon: a bent elbow is passed through, a bend control makes a bow") {
  const test::Rig rig(arm());
  test::Pose bent(rig);
  bent.turn_in_world("arm.lower/ik_fk_limb.fk", math::from_euler_degrees({0, -80, 0}));
  const auto at = pins(rig, bent);
  CHECK(test::distance(at[0].origin, bent.position("arm.upper")) < 1e-9);
  CHECK(test::distance(at[2].origin, bent.position("arm.lower")) < 1e-9);
  CHECK(test::distance(at[4].origin, bent.position("arm.end")) < 1e-9);
  test::Pose bow(rig);
  bow.move_to(tweaks()[0], {0.5, 2.3, 0});
  const auto bowed = pins(rig, bow);
  CHECK(test::distance(bowed[1].origin, {0.5, 2.3, 0}) < 1e-9);
  CHECK(test::distance(bowed[0].origin, {0, 2, 0}) < 1e-9);
  CHECK(test::distance(bowed[4].origin, {2, 2, 0}) < 1e-9);
  // On a bent arm it stays beside the upper arm.
  bent.translate(tweaks()[0], {0.2, 0, 0});
  CHECK(test::distance(bent.position(tweaks()[0]), {0.7, 2, 0}) < 1e-9);
}

TEST_CASE("modules ribbon: twist is spread along it, and adds to a bow") {
  const test::Rig rig(arm());
  test::Pose pose(rig);
  pose.set(tweaks()[1] + "@twist_end", 200.0).set(tweaks()[1] + "@twist_start", 40.0);
  const auto turned = pins(rig, pose), rest = pins(rig, test::Pose(rig));
  for (std::size_t k = 0; k < 5; ++k) {
    const double expected = 40 * (1 - static_cast<double>(k) / 4) + 50 * static_cast<double>(k);
    const math::Quat turn = math::axis_angle({1, 0, 0}, math::radians(expected));
    CHECK(test::distance(turned[k].linear.y, math::rotate(turn, rest[k].linear.y)) < 1e-9);
    CHECK(test::distance(turned[k].origin, rest[k].origin) < 1e-9);
  }
  pose.move_to(tweaks()[0], {0.5, 2.3, 0});
  CHECK(test::distance(pins(rig, pose)[1].origin, {0.5, 2.3, 0}) < 1e-9);
}

TEST_CASE("modules ribbon: longer is thinner, squash is thicker, both by factors") {
  const test::Rig rig(arm(", count: 5, volume: 1"));
  test::Pose pose(rig);
  const auto across = [&] { return math::length(pins(rig, pose)[2].linear.y); };
  pose.set(tweaks()[1] + "@squash", 0.5);
  CHECK(across() == doctest::Approx(1.5));
  pose.move_to(tweaks()[1], {1, 2, 1});
  const double bowed = across();
  CHECK(bowed < 1.4);
  CHECK(bowed > 1);
  CHECK(math::length(pins(rig, pose)[2].linear.x) == doctest::Approx(1));
  pose.set(tweaks()[1] + "@volume", 0.0);
  CHECK(across() == doctest::Approx(1.5));
  pose.set("base/root.world@master_scale", 2.0);
  CHECK(across() == doctest::Approx(3));
}

TEST_CASE("modules ribbon: pins at given places, and on joints of the model") {
  const test::Rig given(arm(", places: [0.25, 0.9]"));
  const auto at = pins(given, test::Pose(given));
  REQUIRE(at.size() == 2);
  CHECK(test::distance(at[0].origin, {0.5, 2, 0}) < 1e-9);
  CHECK(test::distance(at[1].origin, {1.8, 2, 0}) < 1e-9);
  const test::Rig rig(arm(", joints: [twist.a, twist.b]", kRiders));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  CHECK(rig.nodes("arm/ribbon.joint").empty());
  CHECK(test::rest_error(rig) < 1e-9);
  test::Pose pose(rig);
  pose.move_to(tweaks()[0], {0.5, 2, 0.25});
  CHECK(test::distance(pose.position("twist.a"), {0.5, 2, 0.25}) < 1e-9);
}

TEST_CASE("modules ribbon: the same motion on every model") {
  const auto move = [](const test::Rig& rig, const math::Affine& by) {
    test::Pose pose(rig);
    pose.turn_in_world("arm.lower/ik_fk_limb.fk",
                       test::mapped(by, math::from_euler_degrees({0, -60, 10})));
    pose.move_to(tweaks()[0], pose.position(tweaks()[0]) + by.linear * Vec3{0.1, 0.2, 0.1});
    return test::motion(rig, pose);
  };
  const std::string text = arm(", joints: [twist.a, twist.b]", kRiders);
  const test::Rig plain(text);
  const auto expected = move(plain, {});
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(text, model.change);
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    CHECK(test::rest_error(rig) < 1e-9);
    CHECK(test::motion_difference(rig, move(rig, model.by), test::mapped(model.by, expected)) <
          1e-8);
  }
}

TEST_CASE("modules ribbon: between its ends there must be a control") {
  const test::Rig rig(test::template_of(R"(joints:
  - name: upper
    at: [0, 2, 0]
    local: arm
    label: upper
    tags:
      - {command: ribbon, with: {along: [., arm.lower], bends: 0}}
  - {name: lower, parent: upper, at: [1, 2, 0], local: arm, label: lower}
)"));
  CHECK(test::codes(rig.diagnostics) == "RIG0461");
}
