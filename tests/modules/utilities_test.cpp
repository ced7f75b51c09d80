// SPDX-License-Identifier: MIT
// condition, clamp, blend, vector and distance: numbers that other commands read by `@output`.
#include <doctest/doctest.h>

#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

/// Two controls and an attribute `out`; the first joint holds the commands.
std::string pair(const std::string& commands) {
  return test::template_of(R"(joints:
  - name: a
    at: [0, 1, 0]
    local: c
    label: a
    tags:
      - {command: root, with: {}}
      - {command: control, with: {}}
      - {command: attribute, with: {attribute: out}}
)" + commands + R"(
  - {name: b, at: [0.3, 1, 0.4], local: c, label: b, tags: [{command: control, with: {}}]}
)");
}

std::string command(const std::string& module, const std::string& with) {
  return "      - {command: " + module + ", with: {" + with + "}}";
}

const std::string kA = "c.a/control", kB = "c.b/control";

double at(const test::Rig& rig, Vec3 place, const std::string& plug) {
  return test::Pose(rig).translate(kA, place).number(plug);
}

}  // namespace

TEST_CASE("modules condition: one of two formulas") {
  const test::Rig rig(
      pair(command("condition",
                   "if: '{./control@translate.x} > 1', then: '{./control@translate.y} * 10',"
                   " else: '{./control@translate.z} + {./control@translate.x}', to: "
                   "./control@out")));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  CHECK(at(rig, {2, 3, 4}, kA + "@out") == 30);
  CHECK(at(rig, {0.5, 3, 4}, kA + "@out") == 4.5);
  CHECK(at(rig, {0.5, 3, 4}, "c.a/condition@output") == 4.5);
}

TEST_CASE("modules clamp: between its bounds") {
  const test::Rig hard(pair(command(
      "clamp", "value: '{./control@translate.x} * 2', min: -1, max: '{./control@translate.y}'")));
  INFO(test::text(hard.diagnostics));
  REQUIRE(hard.clean());
  CHECK(at(hard, {1, 5, 0}, "c.a/clamp@output") == 2);
  CHECK(at(hard, {9, 5, 0}, "c.a/clamp@output") == 5);
  CHECK(at(hard, {-9, 5, 0}, "c.a/clamp@output") == -1);
}

TEST_CASE("modules clamp: soft bounds are reached slowly and never passed") {
  const test::Rig rig(
      pair(command("clamp", "value: '{./control@translate.x}', max: 10, min: 0, soft: 2")));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  const auto value = [&](double x) { return at(rig, {x, 0, 0}, "c.a/clamp@output"); };
  CHECK(value(5) == 5);
  CHECK(std::abs(value(8) - 8) < 1e-12);
  CHECK(std::abs(value(12) - 10) < 1e-12);
  CHECK(std::abs(value(-2)) < 1e-12);
  double before = value(-5), slope = 0;
  for (double x = -4.99; x < 15; x += 0.01) {
    const double now = value(x), next = (now - before) / 0.01;
    CHECK(now >= -1e-12);
    CHECK(now <= 10 + 1e-12);
    CHECK(std::abs(next - slope) < 0.01);  // no corner
    CHECK(next > -1e-9);
    before = now;
    slope = next;
  }
}

TEST_CASE("modules blend: from one formula to another by a weight") {
  const test::Rig rig(pair(command("blend",
                                   "from: '{./control@translate.x}', into: 8, weight: "
                                   "'{./control@translate.y}', to: ./control@out")));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  CHECK(at(rig, {4, 0.25, 0}, kA + "@out") == 5);
  CHECK(at(rig, {4, -3, 0}, kA + "@out") == 4);
  CHECK(at(rig, {4, 3, 0}, kA + "@out") == 8);
  const test::Rig smooth(pair(command("blend", "weight: '{./control@translate.y}', smooth: on")));
  CHECK(std::abs(at(smooth, {0, 0.5, 0}, "c.a/blend@output") - 0.5) < 1e-12);
  CHECK(at(smooth, {0, 0.1, 0}, "c.a/blend@output") < 0.03);
}

TEST_CASE("modules vector: each operation") {
  const auto rig_with = [](const std::string& operation) {
    return pair(command(
        "vector", "operation: " + operation + ", a: ./control@translate, b: ./control@rotate"));
  };
  const Vec3 a{1, 2, -2}, b{30, 0, 40};
  const auto pose = [&](const test::Rig& rig) {
    test::Pose posed(rig);
    return posed.translate(kA, a).rotate(kA, b);
  };
  const std::string output = "c.a/vector@output";
  const std::pair<const char*, Vec3> vectors[] = {{"add", a + b},
                                                  {"subtract", a - b},
                                                  {"multiply", {30, 0, -80}},
                                                  {"cross", math::cross(a, b)},
                                                  {"project", b * (math::dot(a, b) / 2500)},
                                                  {"reject", a - b * (math::dot(a, b) / 2500)},
                                                  {"normalise", a * (1 / 3.0)}};
  for (const auto& one : vectors) {
    CAPTURE(one.first);
    const test::Rig rig(rig_with(one.first));
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    CHECK(test::distance(pose(rig).vector(output), one.second) < 1e-9);
  }
  const double angle = math::degrees(math::acos(math::dot(a, b) / 150));
  const std::pair<const char*, double> numbers[] = {
      {"dot", math::dot(a, b)}, {"length", 3}, {"angle", angle}};
  for (const auto& one : numbers) {
    CAPTURE(one.first);
    const test::Rig rig(rig_with(one.first));
    CHECK(std::abs(pose(rig).number(output) - one.second) < 1e-9);
  }
}

TEST_CASE("modules vector: by matrices; a node's world counts as its place") {
  const auto rig_with = [](const std::string& with) { return pair(command("vector", with)); };
  const test::Rig point(rig_with("operation: point, a: ./control@translate, b: ./control@world"));
  INFO(test::text(point.diagnostics));
  REQUIRE(point.clean());
  test::Pose pose(point);
  pose.translate(kA, {1, 2, 3}).rotate(kA, {0, 90, 0});
  const math::Affine world = pose.world(kA);
  CHECK(test::distance(pose.vector("c.a/vector@output"), world * Vec3{1, 2, 3}) < 1e-12);
  const test::Rig way(rig_with("operation: direction, a: ./control@translate, b: ./control@world"));
  test::Pose turned(way);
  turned.translate(kA, {1, 2, 3}).rotate(kA, {0, 90, 0});
  CHECK(test::distance(turned.vector("c.a/vector@output"), world.linear * Vec3{1, 2, 3}) < 1e-12);
  const test::Rig places(
      rig_with("operation: subtract, a: ./control@world, b: ./control.zero@world"));
  CHECK(test::distance(test::Pose(places).translate(kA, {1, 2, 3}).vector("c.a/vector@output"),
                       {1, 2, 3}) < 1e-12);
  const auto codes = [&](const std::string& with) {
    return test::codes(test::Rig(rig_with(with)).diagnostics);
  };
  CHECK(codes("operation: dot, a: ./control@translate") == "RIG0465");
  CHECK(codes("operation: dot, a: ./control@translate, b: ./control@out") == "RIG0467");
  CHECK(codes("operation: point, a: ./control@translate, b: ./control@scale") == "RIG0467");
}

TEST_CASE("modules distance: between two nodes, whatever the character's size") {
  const test::Rig rig(test::template_of(R"(joints:
  - {name: a, at: [0, 1, 0], local: c, label: a, tags: [{command: root, with: {}}, {command: control, with: {}}]}
  - {name: b, at: [0.3, 1, 0.4], local: c, label: b, tags: [{command: control, with: {}},
     {command: distance, with: {from: c.a/control, to: ./control}}]}
)"));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  for (const double size : {1.0, 4.0}) {
    test::Pose pose(rig);
    pose.set("c.a/root.world@master_scale", size).translate(kB, {0.3, 0, 0.4});
    CHECK(std::abs(pose.number("c.b/distance@output") - 1) < 1e-12);
    CHECK(std::abs(pose.number("c.b/distance@ratio") - 2) < 1e-12);
    CHECK(std::abs(pose.number("c.b/distance@change") - 0.5) < 1e-12);
  }
  CHECK(test::Pose(rig).number("c.b/distance@change") == 0);
}
