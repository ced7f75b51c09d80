// SPDX-License-Identifier: MIT
// lock: what animators may not key keeps its value, and is said not to be keyable.
#include <doctest/doctest.h>

#include "modules/bodies_helpers.h"
#include "scene/access.h"
#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

const std::string kHips = "torso.hips/control";

std::string hips(const std::string& lock, const std::string& more = {}) {
  return test::body({{"hips",
                      "{command: control, with: {scale: on}}\n"
                      "{command: attribute, with: {attribute: roll, default: 2}}\n" +
                          more + "{command: lock, with: {" + lock + "}}"}});
}

double stored(const test::Rig& rig, const std::string& attribute) {
  return rig.scene().number(rig.plug(kHips + "@" + attribute));
}

bool near(Vec3 a, Vec3 b) { return test::distance(a, b) < 1e-9; }

}  // namespace

TEST_CASE("modules lock: a locked component keeps its value whatever is keyed") {
  const test::Rig rig(hips("attributes: [./control@translate.x, ./control@rotate.y]"));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  test::Pose pose(rig);
  pose.translate(kHips, {1, 2, 3}).rotate(kHips, {20, 40, 0});
  CHECK(near(pose.position("torso.hips"), {0, 2.95, 3}));
  CHECK(near(pose.vector(kHips + "@rotate"), {20, 0, 0}));
}

TEST_CASE("modules lock: what is locked is not keyable, component by component") {
  const test::Rig rig(hips("attributes: [./control@translate.x, ./control@scale]"));
  REQUIRE(rig.clean());
  CHECK(scene::keyable_bits(rig.scene(), rig.node(kHips)) == (2 | 4 | scene::kRotateBits));
  // Something of translate is left, nothing of scale.
  CHECK(stored(rig, "keyable") == 1 + 2);
  CHECK(stored(rig, "locked_components") == 1 + 7 * 64);
  CHECK(stored(rig, "hidden_components") == 1 + 7 * 64);
}

TEST_CASE("modules lock: the last component locked takes the attribute away, by several commands") {
  const test::Rig rig(hips("attributes: ./control@translate.z",
                           "{command: lock, id: xy, with: {attributes: [./control@translate.x, "
                           "./control@translate.y]}}\n"));
  REQUIRE(rig.clean());
  CHECK(stored(rig, "keyable") == 2 + 4);
}

TEST_CASE("modules lock: hide alone leaves an attribute keyable, lock alone leaves it to be seen") {
  const test::Rig hidden(hips("mode: hide, attributes: [./control@scale, ./control@roll]"));
  REQUIRE(hidden.clean());
  CHECK(stored(hidden, "keyable") == 7);
  CHECK(stored(hidden, "locked_components") == 0);
  CHECK(stored(hidden, "hidden_components") == 7 * 64);
  CHECK(hidden.scene()[hidden.node(kHips)].user[0].hidden);
  CHECK(hidden.scene()[hidden.node(kHips)].user[0].keyable);
  test::Pose pose(hidden);
  CHECK(pose.set(kHips + "@scale", Vec3{2, 2, 2}).world("torso.hips").linear.x.x > 1.9);

  const test::Rig locked(hips("mode: lock, attributes: [./control@scale, ./control@roll]"));
  REQUIRE(locked.clean());
  CHECK(stored(locked, "hidden_components") == 0);
  CHECK(stored(locked, "locked_components") == 7 * 64);
  CHECK_FALSE(locked.scene()[locked.node(kHips)].user[0].hidden);
  CHECK_FALSE(locked.scene()[locked.node(kHips)].user[0].keyable);
}

TEST_CASE("modules lock: a value may be fixed with it") {
  const test::Rig added(hips("attributes: ./control@roll, value: 5"));
  REQUIRE(added.clean());
  CHECK(stored(added, "roll") == 5);
  const test::Rig component(hips("attributes: ./control@translate.y, value: 0.5"));
  REQUIRE(component.clean());
  CHECK(near(test::Pose(component).translate(kHips, {1, 9, 1}).position("torso.hips"),
             {1, 0.95 + 0.5, 1}));
  const test::Rig angles(hips("attributes: ./control@rotate, value: [0, 90, 0]"));
  REQUIRE(angles.clean());
  test::Pose pose(angles);
  CHECK(near(pose.rotate(kHips, {10, 20, 30}).vector(kHips + "@rotate"), {0, 90, 0}));
}

TEST_CASE(
    "modules lock: what something drives may be locked and hidden, but not be given a value") {
  const std::string driven =
      "{command: connect, with: {from: ./control@roll, to: ./control@scale.x}}\n";
  const test::Rig rig(hips("attributes: ./control@scale", driven));
  REQUIRE(rig.clean());
  test::Pose pose(rig);
  pose.set(kHips + "@roll", 3.0);
  CHECK(near(pose.vector(kHips + "@scale"), {3, 1, 1}));
  const test::Rig given(hips("attributes: ./control@scale, value: [1, 1, 1]", driven));
  CHECK(test::codes(given.diagnostics) == "RIG0463");
}

TEST_CASE("modules lock: a group's controls are locked by one selector") {
  const test::Rig rig(
      test::body({{"hips", "{command: control}"},
                  {"chest", "{command: control}"},
                  {"root", "{command: lock, with: {attributes: \"torso::control@translate\"}}"}}));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  for (const std::string joint : {"torso.hips", "torso.chest"})
    CHECK(rig.scene().number(rig.plug(joint + "/control@keyable")) == 2);
}

TEST_CASE("modules lock: an optional selector that finds nothing skips the command") {
  const test::Rig rig(hips("attributes: \"tail.none/control@translate?\""));
  CHECK(rig.diagnostics.ok());
  CHECK(stored(rig, "locked_components") == 0);
}

TEST_CASE("modules lock: only what animators key can be locked") {
  const auto codes = [](const std::string& lock) {
    return test::codes(test::Rig(hips(lock)).diagnostics);
  };
  CHECK(codes("attributes: .@translate") == "RIG0494");
  CHECK(codes("attributes: ./control@color") == "RIG0494");
  CHECK(codes("attributes: ./control@world") == "RIG0494");
  CHECK(codes("attributes: ./control@rotation.x") == "RIG0494");
  CHECK(codes("attributes: [./control@visible, .@scale]") == "RIG0494 RIG0494");
  CHECK(codes("attributes: ./control@translate, value: 3") == "RIG0465");
  CHECK(codes("attributes: ./control@roll, value: much") == "RIG0465");
}

TEST_CASE("modules lock: taken back, everything may be keyed again") {
  test::Rig rig(hips("attributes: [./control@translate, ./control@roll], mode: lock_and_hide"), {},
                false);
  REQUIRE(rig.listed());
  REQUIRE(rig.processor().go_to(rig.commands.commands.size() - 1, rig.diagnostics));
  const std::string before = rig.scene().dump();
  REQUIRE(rig.processor().run(rig.diagnostics));
  CHECK(rig.scene().dump() != before);
  REQUIRE(rig.processor().go_to(rig.commands.commands.size() - 1, rig.diagnostics));
  CHECK(rig.scene().dump() == before);
}
