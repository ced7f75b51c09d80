// SPDX-License-Identifier: MIT
// Expanding: parts, names, groups, parameters, uids and opposites.
#include "templates/expand.h"

#include <doctest/doctest.h>

#include <set>

#include "tags/dump.h"
#include "templates/templates_helpers.h"

using namespace rigc;
using namespace rigc::templates;
using namespace rigc::templates::testing;

namespace {

const char* const kLimb =
    "parameters: {size: {type: length, default: 0.2}, tips: {type: int, default: 1, min: 0}}\n"
    "needs: [room]\n"
    "joints:\n"
    "  - name: upper\n"
    "    at: [1, 0, 0]\n"
    "    local: limb\n"
    "    label: upper\n"
    "    tags:\n"
    "      - command: control\n"
    "        with: {size: $size, parent: \"room.door/control | limb.upper/control#x\", name: knob, "
    "local: extra}\n"
    "      - command: expression\n"
    "        was: [lower/old]\n"
    "        with: {to: limb.upper@translate.x, value: \"{extra/control@rotate.x} + "
    "{room.door@translate.x}\"}\n"
    "  - {name: lower, parent: upper, at: [2, 0, 0], local: limb, label: lower, uid: "
    "1111111111111111}\n"
    "  - {name: tip, parent: lower, at: [3, 0, 0], local: tips, label: tip, if: $tips >= 1}\n"
    "  - {name: nail, parent: tip, at: [3.1, 0, 0], local: tips, label: nail}\n";

const char* const kBody =
    "joints:\n"
    "  - {name: door, at: [0, 0, 0], local: hall, label: door, tags: [{command: control}]}\n"
    "parts:\n"
    "  - {template: limb, as: limb_l, attach: door, groups: {room: hall}, with: {size: 0.5}}\n"
    "  - {template: limb, as: limb_r, attach: hall.door, groups: {room: hall}, with: {tips: 0}, "
    "mirror: x}\n";

struct Case {
  Diagnostics diagnostics;
  std::optional<Expanded> expanded;
  explicit Case(const std::string& folder_name, const std::string& body = kBody,
                const std::string& limb = kLimb) {
    const Folder folder(folder_name);
    folder.write("limb.yaml", with_head(limb, "limb"));
    expanded = expand_file(folder.write("body.yaml", with_head(body, "body")), diagnostics);
  }
  const ExpandedJoint& joint(const std::string& name) const {
    for (const ExpandedJoint& candidate : expanded->joints)
      if (candidate.tagged.name == name) return candidate;
    FAIL("no joint ", name);
    return expanded->joints[0];
  }
};

std::string argument(const ExpandedJoint& joint, std::size_t command, const char* name) {
  return joint.tagged.commands[command].find(name)->text;
}

std::uint64_t name_uid(std::string a, const std::string& path, const std::string& joint) {
  a.push_back('\0');
  a += path;
  a.push_back('\0');
  return hash64(a + joint);
}

}  // namespace

TEST_CASE("templates expand: names, groups and selectors of parts") {
  Case c("expand_names");
  REQUIRE_MESSAGE(c.expanded, render(c.diagnostics, false));
  const ExpandedJoint& upper = c.joint("limb_l_upper");
  CHECK(upper.tagged.ids == Identifiers{"body", "limb_l", "upper"});
  CHECK(c.joint("limb_l_tip").tagged.ids.local == "limb_l_tips");
  CHECK(argument(upper, 0, "parent") == "hall.door/control | limb_l.upper/control#x");
  CHECK(argument(upper, 0, "local") == "limb_l_extra");
  CHECK(argument(upper, 0, "name") == "limb_l_knob");
  CHECK(argument(upper, 1, "to") == "limb_l.upper@translate.x");
  CHECK(argument(upper, 1, "value") == "{limb_l_extra/control@rotate.x} + {hall.door@translate.x}");
  CHECK(upper.tagged.commands[0].find("size")->number == 0.5);
  CHECK(c.joint("limb_r_upper").tagged.commands[0].find("size")->number == 0.2);
  CHECK(c.expanded->joints[static_cast<std::size_t>(upper.tagged.parent)].tagged.name == "door");
  CHECK(c.expanded->skeleton.templates.size() == 2);
  CHECK(c.expanded->skeleton.templates[1].file == "limb");
  CHECK(upper.tagged.template_index == 1);
}

TEST_CASE("templates expand: what a condition takes away takes along what hangs below it") {
  Case c("expand_absent");
  REQUIRE(c.expanded);
  std::set<std::string> names;
  for (const ExpandedJoint& joint : c.expanded->joints) names.insert(joint.tagged.name);
  CHECK(names.contains("limb_l_nail"));
  CHECK_FALSE(names.contains("limb_r_tip"));
  CHECK_FALSE(names.contains("limb_r_nail"));
  CHECK(c.joint("limb_l_nail").opposite == -1);
}

TEST_CASE("templates expand: opposites and mirrored flags") {
  Case c("expand_opposites");
  REQUIRE(c.expanded);
  const ExpandedJoint& left = c.joint("limb_l_upper");
  const ExpandedJoint& right = c.joint("limb_r_upper");
  CHECK(left.tagged.mirror.opposite == right.tagged.key);
  CHECK(right.tagged.mirror.opposite == left.tagged.key);
  CHECK_FALSE(left.tagged.mirror.mirrored);
  CHECK(right.tagged.mirror.mirrored);
  CHECK(c.joint("door").tagged.mirror.opposite.uid == 0);

  Diagnostics diagnostics;
  const auto plain = expand_text(
      with_head("joints:\n  - name: eye_l\n  - name: eye_r\n  - name: left_ear\n  - name: nose\n"),
      diagnostics);
  REQUIRE(plain);
  CHECK(plain->joints[0].opposite == 1);
  CHECK(plain->joints[1].opposite == 0);
  CHECK(plain->joints[2].opposite == -1);
  CHECK(plain->joints[3].opposite == -1);
}

TEST_CASE("templates expand: uids come from template, part path and name, or are written") {
  Case c("expand_uids");
  REQUIRE(c.expanded);
  CHECK(c.joint("door").tagged.key.uid == name_uid("body", "", "door"));
  CHECK(c.joint("limb_l_upper").tagged.key.uid == name_uid("body", "limb_l", "upper"));
  std::string bytes = "limb_l";
  bytes.push_back('\0');
  CHECK(c.joint("limb_l_lower").tagged.key.uid == hash64(bytes + "1111111111111111"));
  CHECK(c.joint("limb_r_lower").tagged.key.uid != c.joint("limb_l_lower").tagged.key.uid);
  CHECK(c.joint("limb_l_upper").tagged.commands[1].was ==
        std::vector<std::string>{hex16(hash64(bytes + "1111111111111111")) + "/old"});
}

TEST_CASE("templates expand: renames of joints, parts and templates keep uids") {
  Case before("expand_before");
  std::string body = kBody;
  body.replace(body.find("as: limb_l"), 10, "as: left, was: [limb_l]");
  body = "was: [body]\n" + body;
  body.replace(body.find("name: door"), 10, "name: gate, was: [door]");
  body.replace(body.find("attach: door"), 12, "attach: gate");
  std::string limb = kLimb;
  limb.replace(limb.find("name: upper"), 11, "name: top\n    was: [upper]");
  limb.replace(limb.find("parent: upper"), 13, "parent: top");
  Diagnostics diagnostics;
  const Folder folder("expand_after");
  folder.write("limb.yaml", with_head(limb, "limb"));
  const auto after = expand_file(folder.write("fork.yaml", with_head(body, "fork")), diagnostics);
  REQUIRE_MESSAGE(after, render(diagnostics, false));
  std::set<JointKey> old_keys, new_keys;
  for (const ExpandedJoint& joint : before.expanded->joints) old_keys.insert(joint.tagged.key);
  for (const ExpandedJoint& joint : after->joints) new_keys.insert(joint.tagged.key);
  CHECK(old_keys == new_keys);
  for (const ExpandedJoint& joint : after->joints)
    if (joint.tagged.name == "left_top") {
      const std::vector<JointKey>& was = joint.tagged.was;
      CHECK(was.size() == 7);
      CHECK(was.back().uid == name_uid("fork", "left", "top"));
    }
}

TEST_CASE("templates expand: the same template gives the same text, whatever folder it lies in") {
  Case a("expand_same_a"), b("expand_same_b");
  REQUIRE(a.expanded);
  Diagnostics diagnostics;
  const auto placed_a = place(*a.expanded, diagnostics);
  const auto placed_b = place(*b.expanded, diagnostics);
  REQUIRE(placed_a);
  REQUIRE(placed_b);
  CHECK(tags::dump(*placed_a) == tags::dump(*placed_b));
}

TEST_CASE("templates expand: features of parts join the catalogue, the outer default counts") {
  const std::string limb =
      "features: {look: {kind: display, switches: [in]}, own: {kind: limb}}\n"
      "joints:\n  - name: a\n    tags:\n      - {feature: look, switch: in, commands: [{command: "
      "control}]}\n"
      "      - {feature: look, on: on, commands: [{command: control, id: b, with: {drive: "
      "off}}]}\n";
  const std::string body =
      "features: {look: {kind: display, default: off, title: Look}}\n"
      "parts: [{template: limb, as: x}]\n";
  Case c("expand_features", body, limb);
  REQUIRE_MESSAGE(c.expanded, render(c.diagnostics, false));
  const auto& features = c.expanded->skeleton.features;
  REQUIRE(features.size() == 2);
  CHECK(features[0].title == "Look");
  CHECK(features[0].switches == std::vector<std::string>{"in"});
  CHECK(features[1].name == "own");
  const tags::TaggedJoint& joint = c.expanded->joints[0].tagged;
  CHECK_FALSE(joint.features[0].on);
  CHECK(joint.features[1].on);

  Case clash("expand_feature_clash",
             "features: {look: {kind: limb}}\nparts: [{template: limb, as: x}]\n", limb);
  CHECK_FALSE(clash.expanded);
  CHECK(numbers(clash.diagnostics) == std::vector<int>{235});

  Case undeclared(
      "expand_undeclared",
      "features: {look: {kind: limb}}\nparts: [{template: limb, as: x}, {template: limb, as: y}]\n",
      "joints: [{name: a, tags: [{feature: loko, commands: [{command: control}]}]}]\n");
  CHECK_FALSE(undeclared.expanded);
  CHECK(numbers(undeclared.diagnostics) == std::vector<int>{233});
}

TEST_CASE("templates expand: values of parameters are checked where they arrive") {
  const std::string limb =
      "parameters: {shape: {type: string, default: circle}, n: {type: int, max: 3}}\n"
      "joints: [{name: a, tags: [{command: control, with: {size: $shape}}]}]\n";
  Case missing("expand_missing", "parts: [{template: limb, as: x}]\n", limb);
  CHECK(numbers(missing.diagnostics) == std::vector<int>{271});
  Case range("expand_range", "parts: [{template: limb, as: x, with: {n: 4}}]\n", limb);
  CHECK(numbers(range.diagnostics) == std::vector<int>{272});
  Case type("expand_type", "parts: [{template: limb, as: x, with: {n: 1}}]\n", limb);
  CHECK(numbers(type.diagnostics) == std::vector<int>{272});
  CHECK_FALSE(type.expanded);
}

TEST_CASE(
    "templates expand: circles through parts, deep nesting and explosions end with an error") {
  Case circle("expand_circle",
              "joints: [{name: a, parent: x_b}]\nparts: [{template: limb, as: x, attach: a}]\n",
              "joints: [{name: b}]\n");
  CHECK(numbers(circle.diagnostics) == std::vector<int>{226});

  const Folder folder("expand_deep");
  for (int i = 0; i < 20; ++i) {
    const std::string next = "t" + std::to_string(i + 1);
    folder.write(
        "t" + std::to_string(i) + ".yaml",
        with_head("parts: [{template: " + next + ", as: a}, {template: " + next + ", as: b}]\n",
                  "t" + std::to_string(i)));
  }
  folder.write("t20.yaml", with_head("joints: [{name: a}]\n", "t20"));
  Diagnostics diagnostics;
  CHECK_FALSE(expand_file(folder.path() + "/t0.yaml", diagnostics));
  for (const int number : numbers(diagnostics)) CHECK(number == 294);
}

TEST_CASE("templates expand: a selector that names the template's own rig means this rig") {
  Diagnostics diagnostics;
  const auto expanded = expand_text(
      with_head("joints:\n  - name: a\n    local: a\n    tags:\n      - {command: control, with: "
                "{parent: 'case:a'}}\n"
                "      - {command: control, id: other, with: {drive: off, parent: 'prop:a'}}\n"),
      diagnostics);
  REQUIRE(expanded);
  CHECK(argument(expanded->joints[0], 0, "parent") == "a");
  CHECK(argument(expanded->joints[0], 1, "parent") == "prop:a");
}

TEST_CASE("templates expand: the biped's hands have as many fingers as asked for") {
  for (int fingers = 0; fingers <= 5; ++fingers) {
    const Folder folder("expand_fingers");
    Diagnostics diagnostics;
    const auto expanded = expand_file(
        folder.write("one.yaml",
                     with_head("joints: [{name: chest, local: spine, label: chest}]\n"
                               "parts: [{template: parts/arm, as: arm_l, attach: chest, "
                               "groups: {spine: spine, torso: spine, head: spine, root: spine}, "
                               "with: {fingers: " +
                               std::to_string(fingers) + "}}]\n")),
        diagnostics, {template_folder()});
    REQUIRE_MESSAGE(expanded, render(diagnostics, false));
    // each finger but the thumb has a metacarpal
    CHECK(expanded->joints.size() ==
          static_cast<std::size_t>(5 + 4 * fingers + (fingers > 1 ? fingers - 1 : 0)));
  }
}
