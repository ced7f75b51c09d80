// SPDX-License-Identifier: MIT
// state_machine: intervals of one input that take over from one another.
#include <doctest/doctest.h>

#include <vector>

#include "support/models.h"

using namespace rigc;

namespace {

std::string foot(const std::string& with) {
  return test::template_of(R"(joints:
  - name: base
    at: [0, 0, 0]
    local: base
    label: base
    tags:
      - {command: control, with: {}}
      - {command: attribute, id: r, with: {attribute: roll}}
      - {command: attribute, id: a, with: {attribute: a}}
      - {command: attribute, id: b, with: {attribute: b}}
      - {command: state_machine, with: {input: ./control@roll, names: [heel, flat, ball, toe],
         bounds: [-5, 10, 30], )" +
                           with + "}}\n");
}

const std::vector<std::string> kNames{"heel", "flat", "ball", "toe"};

std::vector<double> weights(const test::Rig& rig, double roll) {
  test::Pose pose(rig);
  pose.set("base/control@roll", roll);
  std::vector<double> all;
  for (const std::string& name : kNames) all.push_back(pose.number("base/state_machine@" + name));
  return all;
}

}  // namespace

TEST_CASE("modules state_machine: exactly one state away from the bounds") {
  for (const char* overlap : {"overlap: 0", "overlap: 6"}) {
    const test::Rig rig(foot(overlap));
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    CHECK(weights(rig, -50) == std::vector<double>{1, 0, 0, 0});
    CHECK(weights(rig, -8.1) == std::vector<double>{1, 0, 0, 0});
    CHECK(weights(rig, 0) == std::vector<double>{0, 1, 0, 0});
    CHECK(weights(rig, 20) == std::vector<double>{0, 0, 1, 0});
    CHECK(weights(rig, 300) == std::vector<double>{0, 0, 0, 1});
  }
}

TEST_CASE("modules state_machine: a smooth hand-over, all weights add up to 1") {
  const test::Rig rig(foot("overlap: 6"));
  CHECK(std::abs(weights(rig, 10)[1] - 0.5) < 1e-12);
  std::vector<double> before = weights(rig, -20);
  for (double roll = -20; roll < 50; roll += 0.1) {
    const std::vector<double> now = weights(rig, roll);
    double sum = 0;
    for (std::size_t i = 0; i < now.size(); ++i) {
      CHECK(now[i] >= 0);
      CHECK(std::abs(now[i] - before[i]) < 1.6 * 0.1 / 6);
      sum += now[i];
    }
    CHECK(std::abs(sum - 1) < 1e-12);
    before = now;
  }
}

TEST_CASE("modules state_machine: drives attributes by its table") {
  const test::Rig rig(
      foot("overlap: 6, driven: [./control@a, ./control@b],"
           " values: [[1, 0], [2, -10], [4, 0], [0, 5]]"));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  const auto at = [&](double roll, const std::string& plug) {
    return test::Pose(rig).set("base/control@roll", roll).number("base/control@" + plug);
  };
  CHECK(at(-50, "a") == 1);
  CHECK(at(0, "b") == -10);
  CHECK(std::abs(at(10, "a") - 3) < 1e-12);
  CHECK(at(99, "b") == 5);
}

TEST_CASE("modules state_machine: bounds, names and tables that do not fit") {
  const auto codes = [](const std::string& with) {
    return test::codes(test::Rig(test::template_of(R"(joints:
  - name: base
    at: [0, 0, 0]
    local: base
    label: base
    tags:
      - {command: control, with: {}}
      - {command: attribute, id: r, with: {attribute: roll}}
      - {command: state_machine, with: {input: ./control@translate.x, )" +
                                                   with + "}}\n"))
                           .diagnostics);
  };
  CHECK(codes("names: [a, b], bounds: [1, 2]") == "RIG0872");
  CHECK(codes("names: [a, b, c], bounds: [2, 1]") == "RIG0872");
  CHECK(codes("names: [a, a], bounds: [1]") == "RIG0870");
  CHECK(codes("names: [a, b], bounds: [1], driven: ./control@roll") == "RIG0872");
  CHECK(codes("names: [a, b], bounds: [1], driven: ./control@roll, values: [[1]]") == "RIG0872");
}
