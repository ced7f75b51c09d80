// SPDX-License-Identifier: MIT
// What runs, and in which order.
#include "processor/command_list.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>

#include "base/text.h"
#include "processor/processor.h"
#include "support/rig.h"
#include "tags/settings.h"

using namespace rigc;

namespace {

constexpr const char* kTemplate = R"(rigc: 1
name: order
version: 1
joints:
  - name: hand
    parent: arm
    at: [0, 2, 0]
    local: arm_g
    label: hand
    tags:
      - {command: control, id: h1}
      - {command: set, id: h2, with: {plug: ./control@translate.x, value: 0}}
  - name: hip
    at: [0, 0, 0]
    local: body
    label: hip
    tags:
      - {command: proxy_mesh, id: p1, stage: build}
      - {command: control, id: p2, stage: optimize}
      - {command: set, id: p3, with: {plug: arm_g.arm/control@translate.x, value: 0}}
      - {command: root, id: p4}
  - name: arm
    parent: hip
    at: [0, 1, 0]
    local: arm_g
    label: arm
    tags:
      - feature: extra
        kind: limb
        switch: arms
        commands:
          - {command: attribute, id: a1, with: {"on": ".", attribute: extra}}
      - {command: control, id: a2}
      - {command: control, id: a3, on: off}
)";

std::string order(const tags::TaggedSkeleton& skeleton, const processor::CommandList& list) {
  std::vector<std::string> ids;
  for (const processor::Command& command : list.commands) {
    ids.push_back(processor::tag_of(skeleton, command).id);
  }
  return join(ids, " ");
}

std::string order_with(const tags::Settings& settings) {
  Diagnostics diagnostics;
  auto skeleton = test::skeleton_from(kTemplate, diagnostics);
  REQUIRE(skeleton);
  INFO(test::text(diagnostics));
  REQUIRE(tags::apply(*skeleton, settings, diagnostics));
  const auto list = processor::list(*skeleton, test::catalogue(), diagnostics);
  REQUIRE(list);
  return order(*skeleton, *list);
}

}  // namespace

TEST_CASE("processor command_list: stage by stage, parents first, top to bottom") {
  // build: hip, arm, hand; connect; then the one that asked for the last stage.
  CHECK(order_with({}) == "p1 p4 a1 a2 h1 p3 h2 p2");
}

TEST_CASE("processor command_list: features, switches and groups that are off run nothing") {
  CHECK(order_with({.features = {{"", "extra", "", false}}, .groups = {}, .rest = "bind"}) ==
        "p1 p4 a2 h1 p3 h2 p2");
  CHECK(
      order_with({.features = {{"arm_g", "extra", "arms", false}}, .groups = {}, .rest = "bind"}) ==
      "p1 p4 a2 h1 p3 h2 p2");
  CHECK(order_with({.features = {}, .groups = {{"arm_g", false}}, .rest = "bind"}) ==
        "p1 p4 p3 p2");
}

TEST_CASE("processor command_list: only keeps the commands of groups") {
  test::Rig rig(kTemplate, {}, false);
  Diagnostics diagnostics;
  const auto arm = processor::only(rig.commands, rig.skeleton, {"arm_g"}, diagnostics);
  REQUIRE(arm);
  CHECK(order(rig.skeleton, *arm) == "a1 a2 h1 h2");
  const auto both = processor::only(rig.commands, rig.skeleton, {"arm_g", "body"}, diagnostics);
  REQUIRE(both);
  CHECK(order(rig.skeleton, *both) == order(rig.skeleton, rig.commands));
  CHECK(diagnostics.all().empty());
  CHECK_FALSE(processor::only(rig.commands, rig.skeleton, {"arm_h", "leg"}, diagnostics));
  CHECK(test::codes(diagnostics) == "RIG0502 RIG0502");
  CHECK(diagnostics.all().front().hint.find("arm_g") != std::string::npos);
}

TEST_CASE("processor command_list: until counts up to the named command") {
  test::Rig rig(kTemplate, {}, false);
  Diagnostics diagnostics;
  CHECK(processor::until(rig.commands, rig.skeleton, "hip/p1", diagnostics) == 1);
  CHECK(processor::until(rig.commands, rig.skeleton, "hand/h1", diagnostics) == 5);
  CHECK(processor::until(rig.commands, rig.skeleton, "arm_g.hand/h2", diagnostics) == 7);
  CHECK(diagnostics.all().empty());
  CHECK_FALSE(processor::until(rig.commands, rig.skeleton, "hand/h3", diagnostics));
  CHECK_FALSE(processor::until(rig.commands, rig.skeleton, "arm/a3", diagnostics));  // off
  CHECK(test::codes(diagnostics) == "RIG0501 RIG0501");
  CHECK(diagnostics.all().front().hint.find("hand/h") != std::string::npos);
}

TEST_CASE("processor command_list: a module without implementation is reported where it is used") {
  Diagnostics diagnostics;
  auto skeleton = test::skeleton_from(kTemplate, diagnostics);
  REQUIRE(skeleton);
  skeleton->joints[0].commands[0].module = "contrl";
  skeleton->joints[1].commands[0].module = "set_";
  CHECK_FALSE(processor::list(*skeleton, test::catalogue(), diagnostics));
  CHECK(test::codes(diagnostics) == "RIG0500 RIG0500");
  CHECK(diagnostics.all().front().place.span.known());
  CHECK(diagnostics.all().back().hint.find("set") != std::string::npos);
}

TEST_CASE("processor command_list: a descriptor may run another module's constructor") {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(RIGC_TEST_OUT) / "processor_modules";
  fs::create_directories(folder);
  std::ofstream(folder / "marker.yaml") << R"(module: marker
version: 1
title: Marker
category: basics
summary: A transform under another name.
implementation: transform
parameters:
  - {name: offset, type: vec3, unit: metre, default: [0, 1, 0], help: Where it is.}
creates:
  - {role: transform, kind: transform, per: command, help: The transform.}
)";
  Diagnostics diagnostics;
  catalog::Catalogue catalogue;
  REQUIRE(catalogue.add_folder(folder.string(), diagnostics));
  auto skeleton = test::skeleton_from(kTemplate, diagnostics);
  REQUIRE(skeleton);
  for (tags::TaggedJoint& joint : skeleton->joints) joint.commands.clear();
  tags::CommandTag marker;
  marker.module = marker.id = "marker";
  skeleton->joints[0].commands = {marker};
  const auto list = processor::list(*skeleton, catalogue, diagnostics);
  INFO(test::text(diagnostics));
  REQUIRE(list);
  processor::Processor processor(*skeleton, *list, catalogue);
  REQUIRE(processor.run(diagnostics));
  const auto made = processor.index().made_by("order", "marker");
  REQUIRE(made.size() == 1);
  CHECK(processor.scene().rest_world(made[0]).origin == math::Vec3{0, 1, 0});
}
