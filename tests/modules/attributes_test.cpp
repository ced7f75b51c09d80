// SPDX-License-Identifier: MIT
// attribute, set, connect, expression, remap: numbers that animators and formulas use.
#include <doctest/doctest.h>

#include <cmath>

#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

/// A control with the attribute `roll`, an undriven joint `wheel`, and more commands on the base.
std::string gears(const std::string& commands) {
  return test::template_of(R"(joints:
  - name: base
    at: [0, 0, 0]
    local: base
    label: base
    tags:
      - {command: control, with: {}}
      - {command: attribute, id: roll, with: {attribute: roll}}
)" + commands + R"(
  - {name: wheel, at: [0, 1, 0], local: wheel, label: wheel}
)");
}

const std::string kBase = "base/control";
const std::string kTurn = "wheel@rotate.y";

double turn_at(const test::Rig& rig, double roll) {
  return test::Pose(rig).set(kBase + "@roll", roll).number(kTurn);
}

}  // namespace

TEST_CASE("modules attributes: an attribute has its type, range and default") {
  const test::Rig rig(gears(R"(
      - {command: attribute, id: a, with: {attribute: gear, type: int, default: 3, min: 1, max: 5}}
      - {command: attribute, id: b, with: {attribute: locked, type: bool, default: on, keyable: off}}
      - {command: attribute, id: c, with: {attribute: lean, type: angle, default: -12.5}})"));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  using Flavour = scene::UserAttribute::Flavour;
  const auto& user = rig.scene()[rig.node(kBase)].user;
  REQUIRE(user.size() == 4);
  CHECK(user[0] == scene::UserAttribute{"roll", Flavour::number, 0, 0, {}, {}, true});
  CHECK(user[1] == scene::UserAttribute{"gear", Flavour::integer, 3, 3, 1.0, 5.0, true});
  CHECK(user[2] == scene::UserAttribute{"locked", Flavour::boolean, 1, 1, {}, {}, false});
  CHECK(user[3] == scene::UserAttribute{"lean", Flavour::angle, -12.5, -12.5, {}, {}, true});
}

TEST_CASE("modules attributes: connect carries a value as it is") {
  const test::Rig rig(gears(R"(
      - {command: connect, with: {from: ./control@roll, to: wheel@rotate.y}}
      - {command: connect, id: t, with: {from: ./control@translate, to: wheel@translate}})"));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  CHECK(std::abs(turn_at(rig, 33) - 33) < 1e-9);
  test::Pose pose(rig);
  pose.translate(kBase, {1, 2, 3}).set(kBase + "@roll", 90.0);
  CHECK(test::distance(pose.position("wheel"), {1, 2, 3}) < 1e-12);
  CHECK(test::distance(pose.world("wheel").linear.z, {1, 0, 0}) < 1e-12);
}

TEST_CASE("modules attributes: set gives numbers, switches, vectors and angles") {
  const test::Rig rig(gears(R"(
      - {command: attribute, id: flag, with: {attribute: flag, type: bool}}
      - {command: set, id: s1, with: {plug: ./control@roll, value: 2.5}}
      - {command: set, id: s2, with: {plug: ./control@flag, value: on}}
      - {command: set, id: s3, with: {plug: wheel@translate, value: [1, 2, 3]}}
      - {command: set, id: s4, with: {plug: ./control@translate.y, value: 4}}
      - {command: set, id: s5, with: {plug: wheel@rotate, value: [10, 20, 30]}}
      - {command: set, id: s6, with: {plug: ./control@rotate.x, value: 15}})"));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  CHECK(rig.scene().number(rig.plug(kBase + "@roll")) == 2.5);
  CHECK(rig.scene().number(rig.plug(kBase + "@flag")) == 1);
  CHECK(rig.scene().local(rig.node("wheel")).translation == Vec3{1, 2, 3});
  CHECK(rig.scene().local(rig.node(kBase)).translation == Vec3{0, 4, 0});
  const test::Pose pose(rig);
  CHECK(test::difference({pose.world("wheel").linear, {}},
                         math::rotation(math::from_euler_degrees({10, 20, 30})), 1) < 1e-12);
  CHECK(test::distance(math::to_euler_degrees(rig.scene().local(rig.node(kBase)).rotation),
                       {15, 0, 0}) < 1e-9);
}

TEST_CASE("modules attributes: an expression computes") {
  const auto rig_with = [](const std::string& formula) {
    return gears("      - {command: expression, with: {to: wheel@rotate.y, value: \"" + formula +
                 "\"}}");
  };
  const test::Rig twice(rig_with("{./control@roll} * -2 + 5"));
  INFO(test::text(twice.diagnostics));
  REQUIRE(twice.clean());
  CHECK(std::abs(turn_at(twice, 10) - -15) < 1e-9);
  const test::Rig two_inputs(rig_with("{./control@roll} + {./control@translate.x} * 10"));
  test::Pose pose(two_inputs);
  pose.translate(kBase, {3, 0, 0}).set(kBase + "@roll", 4.0);
  CHECK(std::abs(pose.number(kTurn) - 34) < 1e-9);
  const test::Rig functions(rig_with("clamp({./control@roll}, 0, 10) + sin(90) + max(1, 2, 3)"));
  CHECK(std::abs(turn_at(functions, 50) - 14) < 1e-9);
  CHECK(std::abs(turn_at(functions, -50) - 4) < 1e-9);
  const test::Rig constant(
      gears("      - {command: expression, with: {to: wheel@rotate.y, value: 12}}"));
  CHECK(std::abs(turn_at(constant, 0) - 12) < 1e-9);
}

TEST_CASE("modules attributes: remap maps ranges through a curve") {
  const auto rig_with = [](const std::string& more) {
    return gears("      - {command: remap, with: {from: ./control@roll, to: wheel@rotate.y, " +
                 more + "}}");
  };
  const test::Rig linear(rig_with("input_min: 10, input_max: 20, output_min: 0, output_max: 40"));
  INFO(test::text(linear.diagnostics));
  REQUIRE(linear.clean());
  CHECK(std::abs(turn_at(linear, 15) - 20) < 1e-9);
  CHECK(std::abs(turn_at(linear, 0)) < 1e-9);  // clamped
  CHECK(std::abs(turn_at(linear, 99) - 40) < 1e-9);
  const test::Rig open(rig_with("clamp: off, output_max: 40"));
  CHECK(std::abs(turn_at(open, 2) - 80) < 1e-9);
  CHECK(std::abs(turn_at(open, -1) - -40) < 1e-9);
  const test::Rig steps(
      rig_with("output_max: 10, curve: [[0, 0, none], [0.5, 1, linear], [1, 0.2]]"));
  CHECK(std::abs(turn_at(steps, 0.25)) < 1e-9);
  CHECK(std::abs(turn_at(steps, 0.5) - 10) < 1e-9);
  CHECK(std::abs(turn_at(steps, 0.75) - 6) < 1e-9);
  const test::Rig smooth(rig_with("output_max: 10, curve: [[0, 0, smooth], [1, 1]]"));
  CHECK(std::abs(turn_at(smooth, 0.5) - 5) < 1e-9);
  CHECK(turn_at(smooth, 0.1) < 0.5);
  const test::Rig spline(
      rig_with("output_max: 10, curve: [[0, 0, spline], [0.5, 0.9, spline], [1, 1]]"));
  CHECK(std::abs(turn_at(spline, 0.5) - 9) < 1e-9);
}
