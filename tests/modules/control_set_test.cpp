// SPDX-License-Identifier: MIT
// control_set: what tools find in the named sets of a rig.
#include <doctest/doctest.h>

#include "modules/bodies_helpers.h"
#include "support/models.h"

using namespace rigc;

namespace {

namespace set_at = scene::control_set;

struct Found {
  scene::NodeId id;
  std::string parent;
  std::vector<scene::NodeId> members;
};

/// The one set with a name.
Found find(const test::Rig& rig, const std::string& name) {
  std::vector<Found> found;
  for (scene::NodeId id : rig.scene().nodes()) {
    const scene::Node& node = rig.scene()[id];
    if (node.kind != scene::Kind::control_set) continue;
    if (std::get<std::string>(rig.scene().value({id, set_at::kSet})) != name) continue;
    found.push_back({id, std::get<std::string>(rig.scene().value({id, set_at::kParent})), {}});
    for (const scene::Connection& c : node.inputs) found.back().members.push_back(c.from.node);
  }
  INFO(name << "\n" << test::text(rig.diagnostics));
  REQUIRE(found.size() == 1);
  return found.front();
}

using Nodes = std::vector<scene::NodeId>;

/// Both hands with a control, and commands on them and on the hips, which have one too.
std::string hands(const std::string& left, const std::string& right, const std::string& hips = {}) {
  const std::string control = "{command: control}\n";
  return test::body(
      {{"hand_l", control + left}, {"hand_r", control + right}, {"hips", control + hips}});
}

std::string codes(const std::string& text) { return test::codes(test::Rig(text).diagnostics); }

}  // namespace

TEST_CASE("modules control_set: left out, the members are the controls of the joint's group") {
  const test::Rig rig(test::body(
      {{"clavicle_l", "{command: control}"},
       {"hand_l", "{command: control}\n{command: control, id: grip, with: {drive: off}}"},
       {"hand_r", "{command: control}"},
       {"upperarm_l", "{command: control_set, with: {set: arm}}"}}));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  const Found arm = find(rig, "arm");
  CHECK(arm.members == rig.nodes("arm_l::control"));
  CHECK(arm.members.size() == 3);
  CHECK(rig.scene()[arm.id].ids.local == "arm_l");
}

TEST_CASE("modules control_set: commands that name one set add to it, each control once") {
  const test::Rig rig(hands(
      "{command: control_set, with: {set: hands}}", "{command: control_set, with: {set: hands}}",
      "{command: control_set, with: {set: hands, nodes: [arm_l.end/control, ./control, "
      "./control]}}"));
  REQUIRE(rig.clean());
  Nodes members = find(rig, "hands").members;
  CHECK(members.size() == 3);
  for (const char* control : {"arm_l.end/control", "arm_r.end/control", "torso.hips/control"})
    CHECK(std::count(members.begin(), members.end(), rig.node(control)) == 1);
}

TEST_CASE("modules control_set: sets lie in sets, whatever comes first") {
  const test::Rig rig(hands("{command: control_set, with: {set: left, parent: hands}}",
                            "{command: control_set, with: {set: right, parent: hands}}",
                            "{command: control_set, with: {set: hands, parent: all}}"));
  INFO(test::text(rig.diagnostics));
  REQUIRE(rig.clean());
  CHECK(find(rig, "left").parent == "hands");
  CHECK(find(rig, "right").parent == "hands");
  CHECK(find(rig, "hands").parent == "all");
  CHECK(find(rig, "hands").members == rig.nodes("torso.hips/control"));
  CHECK(find(rig, "all").parent.empty());
  CHECK(find(rig, "all").members.empty());
}

TEST_CASE("modules control_set: an optional selector that finds nothing makes nothing") {
  const test::Rig rig(
      hands("{command: control_set, with: {set: toes, nodes: \"leg_l.toe/control?\"}}", ""));
  REQUIRE(rig.clean());
  CHECK(rig.nodes("arm_l/control_set").empty());
  // Of several selectors one may find nothing.
  const test::Rig some(hands(
      "{command: control_set, with: {set: ends, nodes: [\"leg_l.toe/control?\", ./control]}}", ""));
  REQUIRE(some.clean());
  CHECK(find(some, "ends").members == some.nodes("arm_l.end/control"));
}

TEST_CASE("modules control_set: mistakes") {
  CHECK(codes(hands("{command: control_set, with: {set: 2d}}", "")) == "RIG0497");
  CHECK(codes(hands("{command: control_set, with: {set: hands, parent: \"a b\"}}", "")) ==
        "RIG0497");
  CHECK(codes(hands("{command: control_set, with: {set: hands, parent: hands}}", "")) == "RIG0496");
  CHECK(codes(hands("{command: control_set, with: {set: a, parent: b}}",
                    "{command: control_set, with: {set: b, parent: a}}")) == "RIG0496");
  CHECK(codes(hands("{command: control_set, with: {set: a, parent: b}}",
                    "{command: control_set, with: {set: a, parent: c}}")) == "RIG0495");
  CHECK(codes(hands("{command: control_set, with: {set: a, nodes: .}}", "")) == "RIG0422");
  CHECK(codes(hands("{command: control_set, with: {set: a, parent: b}}",
                    "{command: control_set, with: {set: b, parent: c}}",
                    "{command: control_set, with: {set: c, parent: a}}")) == "RIG0496");
}

TEST_CASE("modules control_set: stepping back one command takes away just what it added") {
  test::Rig rig(hands("{command: control_set, with: {set: hands, parent: all}}",
                      "{command: control_set, with: {set: hands}}"),
                {}, false);
  REQUIRE(rig.listed());
  std::vector<std::string> dumps;
  const std::size_t count = rig.commands.commands.size();
  for (std::size_t i = 0; i <= count; ++i) {
    REQUIRE(rig.processor().go_to(i, rig.diagnostics));
    dumps.push_back(rig.scene().dump());
  }
  for (std::size_t i = count; i-- > 0;) {
    REQUIRE(rig.processor().go_to(i, rig.diagnostics));
    CHECK(rig.scene().dump() == dumps[i]);
  }
}
