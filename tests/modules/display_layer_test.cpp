// SPDX-License-Identifier: MIT
// display_layer: what is shown, in which colour, and what switches it.
#include <doctest/doctest.h>

#include "modules/bodies_helpers.h"
#include "support/models.h"

using namespace rigc;
using math::Vec3;

namespace {

const std::string kHips = "torso.hips/control";
const std::string kHand = "arm_l.end/control";

/// Controls on hips and left hand, and commands on the hand and on the chest.
std::string rig_of(const std::string& hand, const std::string& chest = {}) {
  test::Commands commands{{"hips", "{command: control}"},
                          {"hand_l", "{command: control}\n" + hand}};
  if (!chest.empty()) commands["chest"] = chest;
  return test::body(commands);
}

double shown(const test::Rig& rig, const std::string& node, const test::Pose* pose = nullptr) {
  return (pose ? *pose : test::Pose(rig)).number(node + "@visible");
}

std::string codes(const std::string& text) { return test::codes(test::Rig(text).diagnostics); }

}  // namespace

TEST_CASE("modules display_layer: hides and shows its nodes") {
  for (const bool on : {true, false}) {
    const std::string flag = on ? "on" : "off";
    const test::Rig rig(
        rig_of("{command: display_layer, with: {layer: hands, visible: " + flag + "}}"));
    INFO(test::text(rig.diagnostics));
    REQUIRE(rig.clean());
    CHECK(shown(rig, kHand) == (on ? 1 : 0));
    CHECK(shown(rig, kHips) == 1);
    CHECK(test::rest_error(rig) < 1e-12);
  }
}

TEST_CASE("modules display_layer: an attribute of a control switches it, also while animated") {
  const test::Rig rig(
      rig_of("{command: display_layer, with: {layer: hands, switch_on: torso.hips/control}}"));
  REQUIRE(rig.clean());
  const scene::UserAttribute& added = rig.scene()[rig.node(kHips)].user.at(0);
  CHECK(added.name == "hands_visible");
  CHECK(added.flavour == scene::UserAttribute::Flavour::boolean);
  CHECK(added.keyable);
  CHECK(added.initial == 1);
  test::Pose pose(rig);
  pose.set(kHips + "@hands_visible", 0.0);
  CHECK(shown(rig, kHand, &pose) == 0);
  pose.set(kHips + "@hands_visible", 1.0);
  CHECK(shown(rig, kHand, &pose) == 1);
}

TEST_CASE("modules display_layer: the switch begins as the layer does, and may be shared") {
  const test::Rig rig(
      rig_of("{command: display_layer, with: {layer: a, switch_on: torso.hips/control, attribute: "
             "extras}}",
             "{command: display_layer, with: {layer: b, visible: off, nodes: torso.hips/control, "
             "switch_on: torso.hips/control, attribute: extras}}"));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  REQUIRE(rig.scene()[rig.node(kHips)].user.size() == 1);
  CHECK(shown(rig, kHand) == 0);
  test::Pose pose(rig);
  pose.set(kHips + "@extras", 1.0);
  CHECK(shown(rig, kHand, &pose) == 1);
  CHECK(shown(rig, kHips, &pose) == 1);
}

TEST_CASE("modules display_layer: a node in several layers is shown where all are") {
  const test::Rig rig(
      rig_of("{command: display_layer, id: a, with: {layer: a, switch_on: torso.hips/control}}\n"
             "{command: display_layer, id: b, with: {layer: b, switch_on: torso.hips/control}}\n"
             "{command: display_layer, id: c, with: {layer: c, switch_on: torso.hips/control}}"));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  for (int bits = 0; bits < 8; ++bits) {
    test::Pose pose(rig);
    for (int i = 0; i < 3; ++i)
      pose.set(kHips + "@" + "abc"[i] + "_visible", bits & 1 << i ? 1.0 : 0.0);
    CHECK(shown(rig, kHand, &pose) == (bits == 7 ? 1 : 0));
  }
}

TEST_CASE("modules display_layer: what showed and hid a node before still does") {
  const test::Rig rig(test::body(
      {{"hips", "{command: control}\n{command: attribute, with: {attribute: ik, default: 0}}"},
       {"hand_l",
        "{command: control}\n"
        "{command: connect, with: {from: torso.hips/control@ik, to: ./control@visible}}\n"
        "{command: display_layer, with: {layer: hands}}"},
       {"hand_r",
        "{command: control}\n"
        "{command: set, with: {plug: ./control@visible, value: 0}}\n"
        "{command: display_layer, with: {layer: hands}}"}}));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  CHECK(shown(rig, kHand) == 0);
  test::Pose pose(rig);
  pose.set(kHips + "@ik", 1.0);
  CHECK(shown(rig, kHand, &pose) == 1);
  CHECK(shown(rig, "arm_r.end/control", &pose) == 0);
}

TEST_CASE("modules display_layer: controls take its colour, also those that come later") {
  const test::Rig rig(rig_of(
      "{command: display_layer, with: {layer: a, color: [0.1, 0.2, 0.3]}}",
      "{command: display_layer, with: {layer: a, nodes: [torso.hips/control, torso.hips]}}"));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  const auto color = [&](const std::string& control) {
    return std::get<Vec3>(rig.scene().value(rig.plug(control + "@color")));
  };
  // Parents first: the chest's command made the layer, without a colour to say.
  CHECK(color(kHand) == Vec3{0.1, 0.2, 0.3});
  CHECK(color(kHips) == Vec3{0.1, 0.2, 0.3});
}

TEST_CASE("modules display_layer: commands that name one layer must agree about it") {
  const auto two = [](const std::string& first, const std::string& second) {
    return codes(rig_of("{command: display_layer, id: a, with: {layer: a" + first + "}}\n" +
                        "{command: display_layer, id: b, with: {layer: a" + second + "}}"));
  };
  CHECK(two("", "") == "");
  CHECK(two(", mode: reference, visible: off", ", mode: reference, visible: off") == "");
  CHECK(two(", mode: reference, visible: off, color: red", "") == "");
  CHECK(two(", mode: reference", ", mode: template") == "RIG0495");
  CHECK(two(", color: red", ", color: blue") == "RIG0495");
  CHECK(two(", visible: off", ", visible: on") == "RIG0495");
  // Said by whichever command, once.
  CHECK(two("", ", mode: reference, visible: off, color: red") == "");
  // A layer's switch begins as the layer did.
  CHECK(two(", switch_on: ./control", ", visible: off") == "RIG0495");
  CHECK(two(", switch_on: torso.hips/control", ", switch_on: ./control") == "RIG0495");
  const std::string both = "switch_on: ./control, attribute: extras";
  CHECK(codes(rig_of("{command: display_layer, id: a, with: {layer: a, " + both + "}}\n" +
                     "{command: display_layer, id: b, with: {layer: b, visible: off, " + both +
                     "}}")) == "RIG0495");
}

TEST_CASE("modules display_layer: mistakes") {
  CHECK(codes(rig_of("{command: display_layer, with: {layer: \"my layer\"}}")) == "RIG0497");
  CHECK(codes(rig_of("{command: display_layer, with: {layer: a, switch_on: ./control, attribute: "
                     "visible}}")) == "RIG0464");
  CHECK(codes(rig_of("{command: display_layer, with: {layer: a, switch_on: ./control, attribute: "
                     "rigc}}")) == "RIG0497");
  CHECK(codes(rig_of("{command: display_layer, with: {layer: a, nodes: ./control.driver}}")) ==
        "RIG0468");
  CHECK(codes(rig_of(
            "{command: display_layer, with: {layer: a, nodes: \"arm_l.none/control?\"}}")) == "");
}

TEST_CASE("modules display_layer: stepping back takes away just what a command did") {
  test::Rig rig(
      rig_of("{command: display_layer, id: a, with: {layer: a, color: red, switch_on: "
             "torso.hips/control}}\n"
             "{command: display_layer, id: b, with: {layer: b, color: blue}}\n"
             "{command: display_layer, id: c, with: {layer: a, nodes: torso.hips/control}}"),
      {}, false);
  REQUIRE(rig.listed());
  std::vector<std::string> dumps;
  const std::size_t count = rig.commands.commands.size();
  for (std::size_t i = 0; i <= count; ++i) {
    REQUIRE(rig.processor().go_to(i, rig.diagnostics));
    dumps.push_back(rig.scene().dump());
  }
  CHECK(dumps[count] != dumps[count - 1]);
  for (std::size_t i = count; i-- > 0;) {
    REQUIRE(rig.processor().go_to(i, rig.diagnostics));
    CHECK(rig.scene().dump() == dumps[i]);
  }
}
