// SPDX-License-Identifier: MIT
// pole_vector: a pole after the fact; nothing moves at rest, and the chain turns with the pole.
#include <doctest/doctest.h>

#include <fmt/format.h>

#include "modules/bodies_helpers.h"
#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

/// A limb of two bones or a bent chain of five, its pole control at `pole`.
std::string limb(const std::string& pole, const std::string& more, const std::string& handle = {}) {
  std::string text =
      test::limb("[0, 1, 0]", "[0, 0.51, 0.1]", "[0, 0.12, 0.02]",
                 {{"base", "{command: control, with: {}}"},
                  {"end",
                   "{command: control, with: {drive: off}}\n"
                   "{command: ik_handle, with: {start: limb.upper, end: ., goal: ./control" +
                       handle + "}}"}});
  return text + fmt::format(
                    "  - name: aim\n    parent: base\n    at: {}\n    local: aim\n    tags:\n"
                    "      - {{command: control, with: {{}}}}\n"
                    "      - {{command: pole_vector, with: {{ik: limb.end/ik_handle.handle, "
                    "pole: ./control{}}}}}\n",
                    pole, more);
}

std::string chain(const std::string& pole) {
  std::string text = test::template_of("joints:\n");
  const char* places[] = {"[0, 1, 0]", "[0, 0.8, 0.1]", "[0.02, 0.6, 0.15]", "[0, 0.4, 0.1]",
                          "[0, 0.2, 0]"};
  text +=
      "  - {name: base, at: [0, 1.2, 0], local: base, label: base, tags: "
      "[{command: control, with: {}}]}\n";
  for (int i = 0; i < 5; ++i) {
    text += fmt::format("  - {{name: j{}, parent: {}, at: {}, local: limb}}\n", i,
                        i == 0 ? "base" : fmt::format("j{}", i - 1), places[i]);
  }
  return text + fmt::format(
                    "  - name: aim\n    parent: base\n    at: {}\n    local: aim\n    tags:\n"
                    "      - {{command: control, with: {{}}}}\n"
                    "      - {{command: ik_handle, with: {{solver: chain, start: \"limb[0]\", "
                    "end: \"limb[END]\", iterations: 60}}}}\n"
                    "      - {{command: pole_vector, with: {{ik: limb/ik_handle.handle, "
                    "pole: ./control}}}}\n",
                    pole);
}

/// Where a joint bends out to, at right angles to the line between two others: unit.
Vec3 side(const test::Pose& pose, const std::string& start, const std::string& joint,
          const std::string& end) {
  const Vec3 from = pose.position(start);
  const Vec3 line = math::normalised(pose.position(end) - from);
  const Vec3 out = pose.position(joint) - from;
  return math::normalised(out - line * math::dot(out, line));
}

}  // namespace

TEST_CASE("modules pole_vector: nothing moves at rest, wherever the pole is, on every model") {
  for (const char* pole : {"[0, 0.5, 1]", "[0.7, 0.5, 0.2]", "[-0.3, 0.9, -0.8]"}) {
    CAPTURE(std::string(pole));
    for (const test::Model& model : test::models()) {
      CAPTURE(model.name);
      for (const std::string& text : {limb(pole, ""), limb(pole, "", ", twist: 0"), chain(pole)}) {
        const test::Rig rig(text, model.change);
        INFO(test::text(rig.diagnostics));
        REQUIRE(rig.clean());
        CHECK(test::rest_error(rig) < 1e-9);
      }
    }
  }
}

TEST_CASE("modules pole_vector: a nearly straight limb bent to the wrong side stays, too") {
  for (const char* middle : {"[0.016, 0.51, 0.005]", "[-0.004, 0.51, -0.007]"}) {
    std::string text = limb("[0.7, 0.5, 0.2]", "", ", bend: forward");
    const std::string bent = "[0, 0.51, 0.1]";
    text.replace(text.find(bent), bent.size(), middle);
    const test::Rig rig(text);
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    CHECK(test::rest_error(rig) < 1e-9);
  }
}

TEST_CASE("modules pole_vector: the bend turns with the pole, the end stays where it is") {
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(limb("[0.7, 0.5, 0.2]", ""), model.change);
    REQUIRE(rig.clean());
    const double height = rig.skeleton.character.height;
    test::Pose pose(rig);
    const Vec3 line = math::normalised(pose.position("limb.end") - pose.position("limb.upper"));
    const Vec3 before = side(pose, "limb.upper", "limb.lower", "limb.end");
    const Vec3 end = pose.position("limb.end");
    // A turn of the pole by 100 degrees about the line is a turn of the bend by as much.
    const math::Quat turn = math::axis_angle(line, math::radians(100));
    const Vec3 start = pose.position("limb.upper");
    pose.move_to("aim/control", start + math::rotate(turn, rig.rest("aim/control").origin - start));
    CHECK(test::distance(side(pose, "limb.upper", "limb.lower", "limb.end"),
                         math::rotate(turn, before)) < 1e-6);
    CHECK(test::distance(pose.position("limb.end"), end) < 1e-9 * height);
  }
}

TEST_CASE("modules pole_vector: a chain of many joints turns with the pole as well") {
  for (const test::Model& model : test::models()) {
    CAPTURE(model.name);
    const test::Rig rig(chain("[0.6, 0.5, 0.5]"), model.change);
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    test::Pose pose(rig);
    const Vec3 start = pose.position("limb[0]"), end = pose.position("limb[END]");
    const Vec3 before = side(pose, "limb[0]", "limb[2]", "limb[END]");
    const math::Quat turn = math::axis_angle(math::normalised(end - start), math::radians(-70));
    pose.move_to("aim/control", start + math::rotate(turn, rig.rest("aim/control").origin - start));
    CHECK(test::distance(side(pose, "limb[0]", "limb[2]", "limb[END]"),
                         math::rotate(turn, before)) < 1e-6);
    CHECK(test::distance(pose.position("limb[END]"), end) < 1e-6 * rig.skeleton.character.height);
  }
}

TEST_CASE("modules pole_vector: without maintain the bend points at the pole") {
  const test::Rig rig(limb("[0.7, 0.5, 0.2]", ", maintain: off"));
  REQUIRE(rig.clean());
  const test::Pose pose(rig);
  const Vec3 start = pose.position("limb.upper");
  const Vec3 line = math::normalised(pose.position("limb.end") - start);
  const Vec3 to_pole = pose.position("aim/control") - start;
  const Vec3 wanted = math::normalised(to_pole - line * math::dot(to_pole, line));
  CHECK(test::distance(side(pose, "limb.upper", "limb.lower", "limb.end"), wanted) < 1e-9);
}

TEST_CASE("modules pole_vector: a twist stays, and the solver itself may be named") {
  std::string text = limb("[0.7, 0.5, 0.2]", "", ", twist: 30");
  const test::Rig without(test::limb(
      "[0, 1, 0]", "[0, 0.51, 0.1]", "[0, 0.12, 0.02]",
      {{"base", "{command: control, with: {}}"},
       {"end",
        "{command: control, with: {drive: off}}\n"
        "{command: ik_handle, with: {start: limb.upper, end: ., goal: ./control, twist: 30}}"}}));
  const test::Rig with(text);
  const std::string handle = "limb.end/ik_handle.handle";
  text.replace(text.rfind(handle), handle.size(), "limb.upper/ik_handle.driver::ik_two_bone");
  const test::Rig named(text);
  for (const test::Rig* rig : {&with, &named}) {
    INFO(test::text(rig->diagnostics));
    REQUIRE(rig->clean());
    for (const char* joint : {"limb.upper", "limb.lower", "limb.end"}) {
      CHECK(test::difference(test::Pose(*rig).world(joint), test::Pose(without).world(joint), 1) <
            1e-9);
    }
  }
}

TEST_CASE("modules pole_vector: a straight chain bends toward the pole") {
  const std::string text = test::tail(
      6, {{"base",
           "{command: control, with: {}}\n"
           "{command: transform, with: {label: aim, offset: [0.5, 0, -0.5]}}"},
          {"tail",
           "{command: control, id: goal, with: {drive: off, parent: base/control}}\n"
           "{command: ik_handle, with: {solver: chain, start: \"tail[0]\", end: \"tail[END]\", "
           "goal: \"./control#goal\", bend: up}}\n"
           "{command: pole_vector, with: {ik: \"tail[END]/ik_handle.handle\", pole: base.aim}}"}});
  const test::Rig rig(text);
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  CHECK(test::rest_error(rig) < 1e-9);
  test::Pose pose(rig);
  pose.move_to("tail[0]/control#goal", pose.position("tail[END]") + Vec3{0, 0, 0.4});
  CHECK(side(pose, "tail[0]", "tail[3]", "tail[END]").x > 0.9);
}

TEST_CASE("modules pole_vector: a chain that has a pole keeps it") {
  const test::Rig pole(limb("[0.7, 0.5, 0.2]", "", ", pole: base/control"));
  CHECK(test::codes(pole.diagnostics) == "RIG0463");
  const test::Rig twice(limb("[0.7, 0.5, 0.2]", "") +
                        "      - {command: pole_vector, id: again, with: {ik: "
                        "limb.end/ik_handle.handle, pole: base/control}}\n");
  CHECK(test::codes(twice.diagnostics) == "RIG0463");
  const test::Rig no_solver(
      test::limb("[0, 1, 0]", "[0, 0.51, 0.1]", "[0, 0.12, 0.02]",
                 {{"base",
                   "{command: control, with: {}}\n{command: pole_vector, with: {ik: ./control, "
                   "pole: limb.end}}"}}));
  CHECK(test::codes(no_solver.diagnostics) == "RIG0480");
}
