// SPDX-License-Identifier: MIT
// Reading templates: what comes out of good ones. What bad ones give stands in tests/bad.
#include "templates/read.h"

#include <doctest/doctest.h>

#include "templates/templates_helpers.h"

using namespace rigc;
using namespace rigc::templates;
using namespace rigc::templates::testing;

TEST_CASE("templates read: the head, in full and at its least") {
  Diagnostics diagnostics;
  const auto least = read_text(with_head("joints:\n  - name: a\n"), diagnostics);
  REQUIRE_MESSAGE(least, render(diagnostics, false));
  CHECK(least->global == "case");
  CHECK(least->digest.size() == 16);
  CHECK(least->reference == "case.yaml");
  CHECK_FALSE(least->has_catalogue);
  const auto full = read_text(
      "rigc: 1\nname: hero\nwas: [zero, one]\nversion: 3\ndescription: Hero\npreview: hero.png\n"
      "global: champion\nunits: centimetre\nneeds: [torso]\nmodules: {control: 1}\n"
      "features: {ikfk: {kind: limb, title: IK, default: off, switches: [arms], help: x}, plain: "
      "}\n"
      "parameters: {n: {type: int, default: 3, min: 0, max: 5, help: y}, w: {type: length, "
      "default: 20}}\n"
      "joints:\n  - name: a\n    at: [100, 0, 0]\n    tags:\n      - command: control\n"
      "        with: {size: 20, offset: [0, 10, 0]}\n",
      diagnostics);
  REQUIRE_MESSAGE(full, render(diagnostics, false));
  CHECK(full->was == std::vector<std::string>{"zero", "one"});
  CHECK(full->version == 3);
  CHECK(full->global == "champion");
  CHECK(full->features.size() == 2);
  CHECK_FALSE(full->features[0].on);
  CHECK(full->features[1].on);
  CHECK(full->find_parameter("n")->default_value->number == 3);
  CHECK(full->find_parameter("w")->default_value->number == 0.2);
  CHECK(full->joints[0].placement.position.x == 1);
  const tags::CommandTag& tag = full->joints[0].commands[0].tag;
  CHECK(tag.find("size")->number == 0.2);
  CHECK(tag.find("offset")->items[1].number == doctest::Approx(0.1));
}

TEST_CASE("templates read: joints with every key") {
  Diagnostics diagnostics;
  const auto read = read_text(
      with_head(
          "parameters: {n: {type: int, default: 3}}\n"
          "joints:\n"
          "  - {name: a, translate: [1, 2, 3], quat: [0, 0, 2, 0], scale: [1, 2, 1], local: l,\n"
          "     label: m, global: g, optional: true, helper: true, was: [z], uid: "
          "00000000000000ff,\n"
          "     if: $n != 2}\n"
          "  - {name: b, parent: a, at: [0, 1, 0], chain: {count: $n, to: [0, 2, 0]},\n"
          "     orient: {aim: -x, up: y, up_toward: [0, 2, 0], toward: a}}\n"),
      diagnostics);
  REQUIRE_MESSAGE(read, render(diagnostics, false));
  const Joint& a = read->joints[0];
  CHECK(a.placement.space == Placement::Space::parent);
  CHECK(a.placement.rotation == math::Quat{0, 0, 1, 0});
  CHECK(a.placement.scale == math::Vec3{1, 2, 1});
  CHECK(a.ids == Identifiers{"g", "l", "m"});
  CHECK(a.optional);
  CHECK(a.helper);
  CHECK(a.uid == 0xffu);
  REQUIRE(a.condition);
  CHECK(a.condition->op == Condition::Operator::not_equal);
  const Joint& b = read->joints[1];
  CHECK(b.parent == "a");
  REQUIRE(b.chain);
  CHECK(b.chain->count.parameter == "n");
  REQUIRE(b.placement.orient);
  CHECK(b.placement.orient->aim == math::Vec3{-1, 0, 0});
  CHECK(b.placement.orient->up_toward == math::Vec3{0, 1, 0});
  CHECK(b.placement.orient->toward == "a");
  CHECK(a.span.line == 6);
}

TEST_CASE("templates read: tags") {
  Diagnostics diagnostics;
  const auto read =
      read_text(with_head("features: {look: {kind: display, switches: [in]}}\n"
                          "joints:\n"
                          "  - name: a\n"
                          "    tags:\n"
                          "      - {command: control, id: main, comment: c, stage: finish, on: "
                          "off, was: [b/main]}\n"
                          "      - feature: look\n"
                          "        switch: in\n"
                          "        commands:\n"
                          "          - {command: control, with: {name: n, local: l, label: m}}\n"
                          "      - commands: [{command: control, id: third}]\n"
                          "        on: off\n"),
                diagnostics);
  REQUIRE_MESSAGE(read, render(diagnostics, false));
  const Joint& joint = read->joints[0];
  REQUIRE(joint.commands.size() == 3);
  CHECK(joint.commands[0].tag.id == "main");
  CHECK(joint.commands[0].tag.stage == "finish");
  CHECK_FALSE(joint.commands[0].tag.on);
  CHECK(joint.commands[0].tag.feature == -1);
  CHECK(joint.commands[1].tag.id == "control");
  CHECK(joint.commands[1].tag.feature == 0);
  CHECK(joint.features[0].tag.kind == "display");
  CHECK(joint.features[1].tag.name.empty());
  CHECK_FALSE(joint.features[1].tag.on);
}

TEST_CASE("templates read: all errors come in one run") {
  Diagnostics diagnostics;
  CHECK_FALSE(
      read_text("rigc: 1\nname: 2\nversion: x\nunits: mile\nfoo: 1\n"
                "joints:\n"
                "  - {name: a, parent: b, at: 1, tags: [{command: contrl}, {command: control, "
                "with: {siz: 1}}]}\n"
                "  - {name: a}\n",
                diagnostics));
  CHECK(numbers(diagnostics) == std::vector<int>{48, 44, 41, 223, 45, 236, 270, 224, 225});
}

TEST_CASE("templates read: suggestions") {
  Diagnostics diagnostics;
  CHECK_FALSE(read_text(with_head("joints:\n  - {name: elbow}\n  - {name: hand, parent: elbwo}\n"),
                        diagnostics));
  REQUIRE(diagnostics.all().size() == 1);
  CHECK(diagnostics.all()[0].hint == "did you mean \"elbow\"?");
}

TEST_CASE("templates read: large and hostile files end soon") {
  std::string many = with_head("joints:\n");
  for (int i = 0; i < 20000; ++i)
    many += "  - {name: j" + std::to_string(i) + ", parent: nowhere}\n";
  Diagnostics diagnostics;
  CHECK_FALSE(read_text(many, diagnostics));
  CHECK(diagnostics.errors() == 20000);
  std::string parameters = with_head("parameters:\n");
  for (int i = 0; i < 300; ++i)
    parameters += "  p" + std::to_string(i) + ": {type: int, default: 1}\n";
  Diagnostics second;
  CHECK_FALSE(read_text(parameters + "joints:\n  - name: a\n", second));
  CHECK(numbers(second) == std::vector<int>{222});
}
