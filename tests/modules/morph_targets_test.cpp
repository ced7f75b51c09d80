// SPDX-License-Identifier: MIT
// morph_targets: which numbers of a rig are weights of which targets.
#include <doctest/doctest.h>

#include "support/models.h"

using namespace rigc;

namespace {

/// A head whose control has an attribute and whose pose is read.
std::string face(const std::string& with) {
  return test::template_of(R"(joints:
  - {name: root, at: [0, 0, 0], local: c, label: root, tags: [{command: root, with: {}}]}
  - name: head
    parent: root
    at: [0, 1.6, 0]
    local: head
    label: head
    tags:
      - {command: control, with: {}}
      - {command: attribute, with: {attribute: angry, min: 0, max: 1}}
      - {command: pose_reader, with: {poses: [[0, 0, 1]], names: [bowed]}}
      - {command: morph_targets, with: {)" +
                           with + R"(}}
  - {name: top, parent: head, at: [0, 1.8, 0], local: head, label: top}
)");
}

scene::NodeId morph_of(const test::Rig& rig) {
  for (const scene::NodeId id : rig.scene().nodes())
    if (rig.scene()[id].kind == scene::Kind::morph) return id;
  return {};
}

}  // namespace

TEST_CASE("modules morph_targets: targets are named, and weights follow what is read") {
  const test::Rig rig(
      face("weights: [./control@angry, ./pose_reader@bowed], targets: [Angry, \"Head down\"], "
           "amounts: [1, 0.5]"));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  const scene::NodeId morph = morph_of(rig);
  REQUIRE(morph.valid());
  CHECK(std::get<std::string>(rig.scene().value({morph, scene::morph::kTargets})) ==
        "Angry\nHead down");
  const auto weight = [&](std::int32_t i) {
    return *rig.scene().source({morph, scene::morph::kWeights, i});
  };
  CHECK(weight(0) == rig.plug("head/control@angry"));
  test::Pose pose(rig);
  pose.rotate("head/control", {90, 0, 0});
  const std::string half = "head/morph_targets.driver::expression@output";
  CHECK(weight(1) == rig.plug(half));
  CHECK(pose.number(half) == doctest::Approx(0.5));
}

TEST_CASE("modules morph_targets: as many targets as weights, each once") {
  for (const char* with : {"weights: [./control@angry], targets: [Angry, Sad]",
                           "weights: [./control@angry], targets: [Angry], amounts: [1, 2]",
                           "weights: [./control@angry, ./pose_reader@bowed], targets: [Sad, Sad]",
                           "weights: [./control@angry], targets: [\"\"]",
                           "weights: [./control@translate], targets: [Sad]"}) {
    CAPTURE(std::string(with));
    CHECK(!test::Rig(face(with)).clean());
  }
}
