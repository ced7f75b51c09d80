// SPDX-License-Identifier: MIT
// Every form of docs/selectors.md finds what it says, and what finds nothing says why.
#include "traversal/resolve.h"

#include <doctest/doctest.h>

#include "base/text.h"
#include "support/rig.h"
#include "traversal/codes.h"

using namespace rigc;
using scene::NodeId;

namespace {

/// A hip, a spine of four, two arms; controls here and there.
constexpr const char* kHero = R"(rigc: 1
name: hero
version: 1
joints:
  - name: hips
    at: [0, 1, 0]
    local: torso
    label: hips
    tags:
      - command: root
      - {command: control, with: {shape: square}}
  - name: spine
    parent: hips
    at: [0, 1.1, 0]
    chain: {count: 4, to: [0, 1.4, 0]}
    local: spine
    tags:
      - {command: fk_chain, with: {joints: "spine[*]"}}
  - name: shoulder_l
    parent: spine
    at: [0.2, 1.4, 0]
    local: arm_l
    label: shoulder
    tags:
      - command: control
      - {command: control, id: gimbal, with: {drive: off}}
      - command: ik_fk_limb
        on: off
        with: {start: arm_l.shoulder, middle: arm_l.elbow, end: arm_l.wrist}
  - name: elbow_l
    parent: shoulder_l
    at: [0.5, 1.4, -0.02]
    local: arm_l
    label: elbow
    tags:
      - {command: control, with: {drive: off}}
      - {command: attribute, with: {attribute: roll}}
  - name: wrist_l
    parent: elbow_l
    at: [0.8, 1.4, 0]
    local: arm_l
    label: wrist
    tags:
      - {command: joint, id: twist, with: {label: twist}}
      - {command: transform, id: palm, with: {label: palm, offset: [0, 0, 0.1]}}
  - name: prop
    at: [2, 0, 0]
)";

/// A built hero and how selectors are answered from one of its joints.
struct Hero {
  test::Rig rig{kHero};
  Diagnostics diagnostics;

  explicit Hero() { REQUIRE(rig.clean()); }

  NodeId joint(const std::string& name) const {
    for (const tags::TaggedJoint& joint : rig.skeleton.joints) {
      if (joint.name == name) return rig.index().joint(joint.key);
    }
    FAIL("no joint " << name);
    return {};
  }

  std::optional<traversal::Found> resolve(const std::string& text, const std::string& from) {
    diagnostics = Diagnostics();
    const auto file = diagnostics.sources().add("selector", text);
    const auto selector = selector::parse(text, {file, 1, 1, 0}, diagnostics);
    REQUIRE(selector);
    const traversal::Context context{rig.scene(), rig.index(), "hero", joint(from), {}};
    return traversal::resolve(*selector, context, diagnostics);
  }

  /// Names of what is found, or the codes of what is reported.
  std::string names(const std::string& text, const std::string& from = "elbow_l") {
    const auto found = resolve(text, from);
    if (!found) return test::codes(diagnostics);
    std::vector<std::string> names;
    for (NodeId id : found->nodes) names.push_back(rig.scene()[id].name);
    return join(names, " ");
  }

  std::string plugs(const std::string& text, const std::string& from = "elbow_l") {
    const auto found = resolve(text, from);
    if (!found) return test::codes(diagnostics);
    REQUIRE(found->plugs.size() == found->nodes.size());
    std::vector<std::string> names;
    for (const scene::Plug& plug : found->plugs) {
      names.push_back(rig.scene()[plug.node].name + "@" + rig.scene().plug_name(plug));
    }
    return join(names, " ");
  }

  /// The hint of the only diagnostic.
  std::string hint(const std::string& text, const std::string& from = "elbow_l") {
    resolve(text, from);
    REQUIRE(diagnostics.all().size() == 1);
    return diagnostics.all().front().hint;
  }
};

bool has(const std::string& text, const std::string& part) {
  INFO("\"" << text << "\" should contain \"" << part << "\"");
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("traversal resolve: this joint and its parent") {
  Hero hero;
  CHECK(hero.names(".") == "elbow_l");
  CHECK(hero.names("..") == "shoulder_l");
  CHECK(hero.names("..", "hips") == "RIG0420");
  CHECK(has(hero.hint("..", "hips"), "has no parent"));
}

TEST_CASE("traversal resolve: groups and labels name joints") {
  Hero hero;
  CHECK(hero.names("torso") == "hips");
  CHECK(hero.names("spine") == "spine_1 spine_2 spine_3 spine_4");
  CHECK(hero.names("arm_l.wrist") == "wrist_l");
  CHECK(hero.names("hero:arm_l.wrist") == "wrist_l");
}

TEST_CASE("traversal resolve: joints that commands made are found by label, module and kind") {
  Hero hero;
  CHECK(hero.names("arm_l") == "shoulder_l elbow_l wrist_l");
  CHECK(hero.names("arm_l[END]") == "wrist_l");
  CHECK(hero.names("arm_l/joint") == "wrist_l_joint");
  CHECK(hero.names("arm_l::joint") == "shoulder_l elbow_l wrist_l wrist_l_joint");
  CHECK(hero.names("arm_l.twist") == "wrist_l_joint");
  CHECK(hero.names("arm_l.palm") == "wrist_l_transform");
}

TEST_CASE("traversal resolve: indices of joints") {
  Hero hero;
  CHECK(hero.names("spine[START]") == "spine_1");
  CHECK(hero.names("spine[MIDDLE]") == "spine_2");
  CHECK(hero.names("spine[END]") == "spine_4");
  CHECK(hero.names("spine[0]") == "spine_1");
  CHECK(hero.names("spine[-1]") == "spine_4");
  CHECK(hero.names("spine[-4]") == "spine_1");
  CHECK(hero.names("spine[*]") == "spine_1 spine_2 spine_3 spine_4");
  CHECK(hero.names("spine[1..2]") == "spine_2 spine_3");
  CHECK(hero.names("spine[1..END]") == "spine_2 spine_3 spine_4");
  CHECK(hero.names("spine[END..START]") == "spine_4 spine_3 spine_2 spine_1");
  CHECK(hero.names("spine[-2..-1]") == "spine_3 spine_4");
  CHECK(hero.names("spine[3,0]") == "spine_4 spine_1");
  CHECK(hero.names("spine[0,2..3]") == "spine_1 spine_3 spine_4");
  CHECK(hero.names("torso[START..END]") == "hips");
}

TEST_CASE("traversal resolve: an index outside the list says what there is") {
  Hero hero;
  for (const char* text : {"spine[4]", "spine[-5]", "spine[0..4]", "spine[1,9]"}) {
    CAPTURE(text);
    CHECK(hero.names(text) == "RIG0425");
    CHECK(has(hero.hint(text), "group \"spine\" has 4 to choose from: 0..3"));
  }
  CHECK(hero.names("arm_l.elbow/control[1]") == "RIG0425");
}

TEST_CASE("traversal resolve: what a module made for joints") {
  Hero hero;
  CHECK(hero.names("./control") == "elbow_l_control");
  CHECK(hero.names("../control") == "shoulder_l_control shoulder_l_control");
  CHECK(hero.names("../control#gimbal") == "shoulder_l_control");
  CHECK(hero.resolve("../control#gimbal", "elbow_l")->nodes !=
        hero.resolve("../control#control", "elbow_l")->nodes);
  CHECK(hero.names("arm_l.elbow/control") == "elbow_l_control");
  CHECK(hero.names("spine[1..2]/fk_chain") == "spine_2_fk spine_3_fk");
  CHECK(hero.names("torso/root") == "hips_world hips_offset");
}

TEST_CASE("traversal resolve: roles, and the helpers that only a role or a star finds") {
  Hero hero;
  CHECK(hero.names("./control.zero") == "elbow_l_control_zero");
  CHECK(hero.names("torso.hips/control.driver") == "hips_driver");
  CHECK(hero.names("spine[0]/fk_chain.zero") == "spine_1_fk_zero");
  CHECK(hero.names("./*") == "elbow_l_control_zero elbow_l_control");
  CHECK(hero.names("./*.control") == "elbow_l_control");
  CHECK(hero.names("torso/root.offset") == "hips_offset");
  CHECK(hero.names("arm_l/transform") == "wrist_l_transform");
}

TEST_CASE("traversal resolve: indices of what was made count in the order of making") {
  Hero hero;
  CHECK(hero.names("spine/fk_chain") == "spine_1_fk spine_2_fk spine_3_fk spine_4_fk");
  CHECK(hero.names("spine/fk_chain[START..1]") == "spine_1_fk spine_2_fk");
  CHECK(hero.names("spine/fk_chain.fk[END]") == "spine_4_fk");
  CHECK(hero.names("torso/root[1]") == "hips_offset");
}

TEST_CASE("traversal resolve: kinds") {
  Hero hero;
  CHECK(hero.names("arm_l::control") == "shoulder_l_control shoulder_l_control elbow_l_control");
  CHECK(hero.names("arm_l::joint") == "shoulder_l elbow_l wrist_l wrist_l_joint");
  CHECK(hero.names("arm_l.elbow::control") == "elbow_l_control");
  CHECK(hero.names("arm_l.elbow::joint") == "elbow_l");
  CHECK(hero.names(".::control") == "elbow_l_control");
  CHECK(hero.names(".::joint") == "elbow_l");
  CHECK(hero.names("spine[1..2]::control") == "spine_2_fk spine_3_fk");
  CHECK(hero.names("./*::transform") == "elbow_l_control_zero");
  CHECK(hero.names("./control::control") == "elbow_l_control");
  CHECK(hero.names("./control::joint") == "RIG0420");
  CHECK(hero.names("arm_l::ik_chain") == "RIG0420");
  CHECK(has(hero.hint("arm_l::ik_chain"), "no node there is of kind ik_chain"));
}

TEST_CASE("traversal resolve: attributes and components") {
  Hero hero;
  CHECK(hero.plugs("./control@translate") == "elbow_l_control@translate");
  CHECK(hero.plugs("./control@translate.x") == "elbow_l_control@translate.x");
  CHECK(hero.plugs(".@rotation.w") == "elbow_l@rotation.w");
  CHECK(hero.plugs("./control@roll") == "elbow_l_control@roll");
  CHECK(hero.plugs("spine[0..1]@rotate.y") == "spine_1@rotate.y spine_2@rotate.y");
  CHECK(hero.plugs("torso/root.world@master_scale") == "hips_world@master_scale");
}

TEST_CASE("traversal resolve: missing attributes are reported where they are missing") {
  Hero hero;
  CHECK(hero.plugs("./control@rol") == "RIG0423");
  CHECK(has(hero.hint("./control@rol"), "roll"));
  CHECK(hero.plugs("./control@roll.x") == "RIG0423");
  CHECK(hero.plugs("./control@translate.w") == "RIG0423");
  CHECK(hero.plugs("./*@roll") == "RIG0423");  // the zero has none
  CHECK(hero.plugs("./control@gone | ./control@roll") == "RIG0423");
}

TEST_CASE("traversal resolve: the first choice that finds anything counts") {
  Hero hero;
  CHECK(hero.names("arm_l.hand | arm_l.wrist") == "wrist_l");
  CHECK(hero.names("arm_l.elbow | arm_l.wrist") == "elbow_l");
  CHECK(hero.names("leg_l | spine[9] | ..") == "shoulder_l");
  CHECK(hero.names("leg_l | leg_r") == "RIG0420");
}

TEST_CASE("traversal resolve: optional selectors may be empty, but not wrong") {
  Hero hero;
  const auto empty = hero.resolve("leg_l.toe?", "elbow_l");
  REQUIRE(empty);
  CHECK(empty->nodes.empty());
  CHECK_FALSE(empty->absent_rig);
  CHECK(hero.diagnostics.all().empty());
  CHECK(hero.names("spine[9]?") == "");
  CHECK(hero.names("arm_l.wrist?") == "wrist_l");
  CHECK(hero.names("leg_l.toe | arm_l.wrist ?") == "wrist_l");
  CHECK(hero.plugs("./control@rol?") == "RIG0423");
}

TEST_CASE("traversal resolve: a rig that is not there is a warning and counts as left out") {
  Hero hero;
  for (const char* text : {"sword:handle/control", "sword:handle/control?", "leg_l | sword:grip"}) {
    CAPTURE(text);
    const auto found = hero.resolve(text, "elbow_l");
    REQUIRE(found);
    CHECK(found->absent_rig);
    CHECK(found->nodes.empty());
    CHECK(test::codes(hero.diagnostics) == "RIG0426");
    CHECK(hero.diagnostics.ok());
  }
  CHECK(hero.names("sword:grip | arm_l.wrist") == "wrist_l");
}

TEST_CASE("traversal resolve: what finds nothing tells which part fails, with a suggestion") {
  Hero hero;
  CHECK(hero.names("arm_r.elbow") == "RIG0420");
  CHECK(has(hero.hint("arm_r.elbow"), "there is no local group \"arm_r\""));
  CHECK(has(hero.hint("arm_r.elbow"), "arm_l"));
  CHECK(has(hero.hint("spin"), "spine"));
  CHECK(has(hero.hint("arm_l.elbw"), "group \"arm_l\" has no label \"elbw\""));
  CHECK(has(hero.hint("arm_l.elbw"), "elbow"));
  CHECK(has(hero.hint("./fk_chain"), "what has been made there: control.control"));
  CHECK(has(hero.hint("./control#gimbal"), "control.control"));
  CHECK(has(hero.hint("./control", "prop"), "nothing has been made there yet"));
}

TEST_CASE("traversal resolve: nodes are described by what they are") {
  Hero hero;
  const auto text = [&](const std::string& selector) {
    return traversal::describe(hero.rig.scene(), hero.resolve(selector, "elbow_l")->nodes.front());
  };
  CHECK(text(".") == "arm_l.elbow (joint \"elbow_l\")");
  CHECK(text("./control") == "arm_l.elbow/control.control (control \"elbow_l_control\")");
  CHECK(text("../control#gimbal") ==
        "arm_l.shoulder/control#gimbal.control (control \"shoulder_l_control\")");
  CHECK(text("spine[1]") == "spine (joint \"spine_2\")");
  CHECK(traversal::describe(hero.rig.scene(), hero.joint("prop")) == "prop (joint \"prop\")");
}
