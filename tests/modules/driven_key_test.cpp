// SPDX-License-Identifier: MIT
// driven_key: attributes that follow another through keys.
#include <doctest/doctest.h>

#include "support/models.h"

using namespace rigc;

namespace {

/// A control with attributes a, b and c, and commands.
std::string gears(const std::string& commands) {
  return test::template_of(R"(joints:
  - name: base
    at: [0, 0, 0]
    local: base
    label: base
    tags:
      - {command: control, with: {}}
      - {command: attribute, id: a, with: {attribute: a, default: 1}}
      - {command: attribute, id: b, with: {attribute: b}}
      - {command: attribute, id: c, with: {attribute: c}}
)" + commands + R"(
  - {name: wheel, at: [0, 1, 0], local: wheel, label: wheel}
)");
}

const std::string kBase = "base/control";

std::string key(const std::string& with) {
  return "      - {command: driven_key, with: {" + with + "}}\n";
}

double at(const test::Rig& rig, double c, const std::string& plug) {
  return test::Pose(rig).set(kBase + "@c", c).number(plug);
}

}  // namespace

TEST_CASE("modules driven_key: each driven attribute passes its keys") {
  const test::Rig rig(
      gears(key("driver: ./control@c, driven: [./control@a, wheel@rotate.y],"
                " keys: [[-90, 3, 0], [0, 1, 10], [30, 2, 40], [90, -1, 90]]")));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  const double keys[][3] = {{-90, 3, 0}, {0, 1, 10}, {30, 2, 40}, {90, -1, 90}};
  for (const auto& [driver, a, turn] : keys) {
    CHECK(std::abs(at(rig, driver, kBase + "@a") - a) < 1e-9);
    CHECK(std::abs(at(rig, driver, "wheel@rotate.y") - turn) < 1e-9);
  }
  CHECK(at(rig, -500, kBase + "@a") == 3);
  CHECK(at(rig, 500, kBase + "@a") == -1);
  // Smooth: no step is much larger than its neighbours.
  for (double c = -90; c < 89; c += 0.5) {
    const double before = at(rig, c - 0.01, kBase + "@a"), after = at(rig, c + 0.01, kBase + "@a");
    CHECK(std::abs(after - before) < 0.02 * 0.11);
  }
}

TEST_CASE("modules driven_key: straight, held and eased between keys, on beyond the ends") {
  const auto rig_with = [](const std::string& more) {
    return gears(key("driver: ./control@c, driven: ./control@b, keys: [[0, 0], [10, 5]], " + more));
  };
  const test::Rig linear(rig_with("interpolation: linear, clamp: off"));
  CHECK(std::abs(at(linear, 4, kBase + "@b") - 2) < 1e-9);
  CHECK(std::abs(at(linear, 20, kBase + "@b") - 10) < 1e-9);
  const test::Rig held(rig_with("interpolation: none"));
  CHECK(at(held, 9.9, kBase + "@b") == 0);
  CHECK(at(held, 10, kBase + "@b") == 5);
  const test::Rig eased(rig_with("interpolation: smooth"));
  CHECK(at(eased, 1, kBase + "@b") < 0.2);
  CHECK(std::abs(at(eased, 5, kBase + "@b") - 2.5) < 1e-9);
}

TEST_CASE("modules driven_key: several drivers of one attribute add up") {
  const test::Rig rig(gears(
      key("driver: ./control@c, driven: ./control@a, add: on, keys: [[0, 0], [10, 5]], clamp: "
          "off") +
      "      - {command: driven_key, id: two, with: {driver: ./control@b, driven: ./control@a,"
      " add: on, keys: [[0, 0], [1, 100]]}}\n"));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  test::Pose pose(rig);
  CHECK(pose.number(kBase + "@a") == 1);  // its own value stays below
  pose.set(kBase + "@c", 4.0).set(kBase + "@b", 0.5);
  CHECK(std::abs(pose.number(kBase + "@a") - (1 + 2 + 50)) < 1e-9);
}

TEST_CASE("modules driven_key: keys that do not fit, attributes that are driven already") {
  const auto codes = [](const std::string& commands) {
    return test::codes(test::Rig(gears(commands)).diagnostics);
  };
  CHECK(codes(key("driver: ./control@c, driven: ./control@a, keys: [[0, 0]]")) == "RIG0872");
  CHECK(codes(key("driver: ./control@c, driven: ./control@a, keys: [[0, 0, 1], [1, 0, 1]]")) ==
        "RIG0872");
  CHECK(codes(key("driver: ./control@c, driven: ./control@a, keys: [[0, 0], [0, 1]]")) ==
        "RIG0872");
  CHECK(codes("      - {command: connect, with: {from: ./control@b, to: ./control@a}}\n" +
              key("driver: ./control@c, driven: ./control@a, keys: [[0, 0], [1, 1]]")) ==
        "RIG0463");
  CHECK(codes(key("driver: ./control@c, driven: wheel@translate, keys: [[0, 0], [1, 1]]")) ==
        "RIG0467");
}
