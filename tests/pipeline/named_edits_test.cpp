// SPDX-License-Identifier: MIT
// Edits of templates that riggers make, by name: none loses a key, and nothing moves that should
// not.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>

#include "pipeline/build.h"
#include "pipeline/character_helpers.h"
#include "pipeline/named_edits_helpers.h"
#include "scene/edit.h"

namespace rigc {
namespace {

using nlohmann::ordered_json;
using test::replaced;
using test::Shot;
using test::Story;

/// Rounding of joints whose place is computed anew, in heights of the character.
constexpr double kRounding = 1e-12;
/// The same where keys are converted, which are floats.
constexpr double kConverted = 1e-6;

/// A chest with an arm that FK controls turn.
const char* const kArm = R"(rigc: 1
name: story
version: 1
joints:
  - name: chest
    at: [0, 1.4, 0]
    local: body
    label: chest
    tags:
      - command: control
        with: {size: 0.4}
  - name: shoulder
    parent: chest
    at: [0.2, 1.4, 0]
    local: arm
    label: shoulder
    tags:
      - command: fk_chain
        with: {joints: [arm.shoulder, arm.elbow, arm.wrist], size: 0.2}
  - name: elbow
    parent: shoulder
    at: [0.5, 1.4, -0.04]
    local: arm
    label: elbow
  - name: wrist
    parent: elbow
    at: [0.8, 1.4, 0]
    local: arm
    label: wrist
)";

std::string version(int number, const std::string& text) {
  return replaced(text, "version: 1\n", fmt::format("version: {}\n", number));
}

/// kArm with the limb that has FK and IK.
std::string ik_fk_arm(int number) {
  return replaced(
      version(number, kArm),
      "fk_chain\n        with: {joints: [arm.shoulder, arm.elbow, arm.wrist], size: 0.2}",
      "ik_fk_limb\n        with: {start: arm.shoulder, middle: arm.elbow, end: "
      "arm.wrist, bend: backward}");
}

scene::NodeId control(const gltf::Rig& rig, const std::string& local, const std::string& label,
                      const std::string& role) {
  for (const scene::NodeId id : rig.scene.nodes()) {
    const scene::Node& node = rig.scene[id];
    if (node.kind == scene::Kind::control && node.ids.local == local && node.ids.label == label &&
        node.identity.role == role)
      return id;
  }
  FAIL("no control " << local << "." << label << " " << role);
  return {};
}

ordered_json& node_of(test::Character& file, const gltf::Rig& rig, scene::NodeId id) {
  return file.json["nodes"][static_cast<std::size_t>(rig.nodes[id.index])];
}

/// Largest distance of the joints of some groups between two shots, over all clips, in heights.
double motion_of(const Shot& a, const Shot& b, const std::vector<std::string>& groups) {
  double largest = 0;
  const gltf::Rig &first = a.rigs.front(), &second = b.rigs.front();
  for (int clip = -1; clip < static_cast<int>(a.clips.size()); ++clip) {
    for (double time = 0; time < 3; time += 0.37) {
      const auto p = test::pose_at(a, first, clip, time), q = test::pose_at(b, second, clip, time);
      for (const tags::TaggedJoint& joint : first.skeleton.joints) {
        if (std::find(groups.begin(), groups.end(), joint.ids.local) == groups.end()) continue;
        largest = std::max(largest, math::length(p.at(joint.key).origin - q.at(joint.key).origin));
      }
    }
  }
  return largest / first.skeleton.character.height;
}

}  // namespace

TEST_CASE("named edits: fk_chain becomes ik_fk_limb, and back") {
  Story s("ik_fk");
  s.build_text(kArm, 1);
  s.update_text(ik_fk_arm(2));
  CHECK(s.orphans() == 0);
  CHECK(s.rules() == "replaces");
  // The new limb stands at FK: what was keyed plays on.
  CHECK(test::motion_difference(s.before, s.after, "") < kRounding);

  SUBCASE("without other keys the way back gives the same file's keys and motion") {
    s.update_text(version(3, kArm));
    CHECK(s.orphans() == 0);
    CHECK(s.rules() == "replaces");
    CHECK(test::differences(test::keys_of(s.original), test::keys_of(s.after)) == "");
    bool exact = false;
    CHECK(test::motion_difference(s.original, s.after, "", &exact) == 0);
    CHECK(exact);
  }
  SUBCASE("keys of IK wait while the limb has none") {
    test::animate(s.shot, 2, {1, 1.0, 1.0, 4});
    const Shot posed = test::read_shot(s.shot);
    s.update_text(version(3, kArm));
    CHECK(s.orphans() > 0);
    s.update_text(ik_fk_arm(4));
    CHECK(s.orphans() == 0);
    CHECK(test::differences(test::keys_of(posed), test::keys_of(s.after)) == "");
    bool exact = false;
    CHECK(test::motion_difference(posed, s.after, "", &exact) == 0);
    CHECK(exact);
  }
}

TEST_CASE("named edits: the biped's arms from plain FK to IK/FK by their features") {
  Story s("biped_ik_fk");
  const test::TextEdit ikfk{"biped.yaml", "kind: limb, title: IK/FK, switches",
                            "kind: limb, title: IK/FK, default: off, switches"},
      fk{"biped.yaml", "title: Plain FK, default: off,", "title: Plain FK,"};
  test::write_biped(s.folder, 1, {ikfk, fk});
  s.build("biped.yaml", 3);
  test::write_biped(s.folder, 2);
  s.update();
  CHECK(s.orphans() == 0);
  CHECK(s.rules() == "replaces");
  // The legs' limbs stand at IK by default: here at FK, because that is what was keyed.
  const auto report = nlohmann::json::parse(s.result.json)["rigs"][0];
  CHECK(report["set"] == nlohmann::json::array({"leg_l.ankle/ik_fk_limb#limb.settings@ik_fk",
                                                "leg_r.ankle/ik_fk_limb#limb.settings@ik_fk"}));
  CHECK(test::motion_difference(s.before, s.after, "") < kRounding);
  test::write_biped(s.folder, 3, {ikfk, fk});
  s.update();
  CHECK(s.orphans() == 0);
  CHECK(test::differences(test::keys_of(s.original), test::keys_of(s.after)) == "");
  bool exact = false;
  CHECK(test::motion_difference(s.original, s.after, "", &exact) == 0);
  CHECK(exact);
}

TEST_CASE("named edits: legs at IK come back at IK") {
  Story s("biped_fk_and_back");
  test::write_biped(s.folder, 1);
  s.build("biped.yaml", 17);
  const test::TextEdit ikfk{"biped.yaml", "kind: limb, title: IK/FK, switches",
                            "kind: limb, title: IK/FK, default: off, switches"},
      fk{"biped.yaml", "title: Plain FK, default: off,", "title: Plain FK,"};
  test::write_biped(s.folder, 2, {ikfk, fk});
  s.update();
  CHECK(s.orphans() > 0);
  test::write_biped(s.folder, 3, {ikfk, fk});
  s.update();
  test::write_biped(s.folder, 4);
  s.update();
  CHECK(s.orphans() == 0);
  CHECK(test::differences(test::keys_of(s.original), test::keys_of(s.after)) == "");
  bool exact = false;
  CHECK(test::motion_difference(s.original, s.after, "", &exact) == 0);
  CHECK(exact);
}

TEST_CASE("named edits: a clavicle comes between chest and arm") {
  SUBCASE("small") {
    Story s("clavicle");
    s.build_text(kArm, 4);
    std::string text = replaced(version(2, kArm), "  - name: shoulder\n    parent: chest\n",
                                "  - name: clavicle\n    parent: chest\n    at: [0.05, 1.4, 0.03]\n"
                                "    orient: {aim: +y, toward: shoulder}\n"
                                "    local: arm\n    label: clavicle\n    tags:\n"
                                "      - command: control\n        with: {orient: character}\n"
                                "  - name: shoulder\n    parent: clavicle\n");
    s.update_text(text);
    CHECK(s.orphans() == 0);
    CHECK(s.rules() == "");
    CHECK(test::motion_difference(s.before, s.after, "") < kRounding);
  }
  SUBCASE("biped") {
    Story s("biped_clavicle");
    test::write_biped(s.folder, 1, test::without_clavicle());
    // Nobody may key scales of these controls; a joint under a scaled one moves on.
    s.build("biped.yaml", 5, {2, 0.6, 0.3, 6, 0});
    test::write_biped(s.folder, 2);
    s.update();
    CHECK(s.orphans() == 0);
    CHECK(s.rules() == "");
    CHECK(test::motion_difference(s.before, s.after, "") < kRounding);
    const auto report = nlohmann::json::parse(s.result.json)["rigs"][0];
    CHECK(report["joints_added"] == nlohmann::json::array({"arm_l_clavicle", "arm_r_clavicle"}));
    CHECK(report["largest_mm"].get<double>() < 1e-9);
  }
}

TEST_CASE("named edits: a command moves to another joint and says what it was") {
  const std::string command =
      "      - command: fk_chain\n"
      "        with: {joints: [arm.shoulder, arm.elbow, arm.wrist], size: 0.2}\n";
  Story s("moved_command");
  s.build_text(kArm, 6);
  std::string text = replaced(version(2, kArm), "    tags:\n" + command, "");
  text = replaced(text, "        with: {size: 0.4}\n",
                  "        with: {size: 0.4}\n" + command + "        was: [shoulder/fk_chain]\n");
  s.update_text(text);
  CHECK(s.orphans() == 0);
  CHECK(s.rules() == "was");
  bool exact = false;
  CHECK(test::motion_difference(s.before, s.after, "", &exact) == 0);
  CHECK(exact);
  // The next version need not say it again.
  s.update_text(replaced(replaced(text, "        was: [shoulder/fk_chain]\n", ""), "version: 2",
                         "version: 3"));
  CHECK(s.orphans() == 0);
  CHECK(s.rules() == "");
}

TEST_CASE("named edits: a command that made nodes for several joints moves to one of them") {
  // The chest is no longer part of the chain: its keys have no successor, and must not go to the
  // shoulder, which holds the command now.
  const std::string chain = "joints: [arm.shoulder, arm.elbow, arm.wrist]";
  const std::string command =
      "      - command: fk_chain\n        with: {" + chain + ", size: 0.2}\n";
  std::string first = replaced(kArm, "    tags:\n" + command, "");
  first = replaced(
      first, "      - command: control\n        with: {size: 0.4}\n",
      replaced(command, chain, "joints: [body.chest, arm.shoulder, arm.elbow, arm.wrist]"));
  Story s("shorter_command");
  s.build_text(first, 7);
  std::string next =
      replaced(version(2, kArm), "size: 0.2}\n", "size: 0.2}\n        was: [chest/fk_chain]\n");
  next = replaced(next, "    tags:\n      - command: control\n        with: {size: 0.4}\n", "");
  s.update_text(next);
  CHECK(s.orphans() == 1);
  CHECK(s.after.rigs.front().orphans.front().ids.label == "chest");
}

TEST_CASE("named edits: a chain from three to five joints, and back") {
  SUBCASE("small") {
    const std::string chain = R"(rigc: 1
name: story
version: 1
joints:
  - name: root
    at: [0, 0, 0]
    local: root
    label: root
    tags:
      - command: control
  - name: spine
    parent: root
    at: [0, 1, 0]
    chain: {count: 3, to: [0, 1.6, -0.1]}
    local: spine
    tags:
      - command: fk_chain
        with: {joints: "spine[*]"}
  - name: foot
    parent: root
    at: [0.1, 0.1, 0]
    local: leg
    label: foot
    tags:
      - command: control
)";
    Story s("spine");
    s.build_text(chain, 8);
    const std::string longer = replaced(chain, "count: 3", "count: 5");
    s.update_text(version(2, longer));
    CHECK(s.orphans() == 0);
    CHECK(s.rules() == "");
    CHECK(motion_of(s.before, s.after, {"root", "leg"}) == 0);
    CHECK(s.after.rigs.front().skeleton.joints.size() == 7);
    // Back again: what was keyed in between on the two joints waits.
    s.update_text(version(3, chain));
    CHECK(s.orphans() == 0);
    CHECK(test::differences(test::keys_of(s.original), test::keys_of(s.after)) == "");
    CHECK(test::motion_difference(s.original, s.after, "") < kRounding);
  }
  SUBCASE("biped") {
    Story s("biped_spine");
    test::write_biped(s.folder, 1);
    s.build("biped.yaml", 9);
    test::write_biped(s.folder, 2, {{"parts/spine.yaml", "count: 2", "count: 4"}});
    s.update();
    CHECK(s.orphans() == 0);
    CHECK(motion_of(s.before, s.after, {"root", "torso", "leg_l", "leg_r"}) < kRounding);
    // Without a clip and without values nothing moves at all.
    const Shot rest = test::read_shot(s.shot);
    CHECK(rest.rigs.front().skeleton.joints.size() ==
          s.before.rigs.front().skeleton.joints.size() + 2);
  }
}

TEST_CASE("named edits: a part is renamed") {
  Story s("renamed_part");
  test::write_biped(s.folder, 1);
  pipeline::BuildRequest request;
  request.template_file = s.folder + "/biped.yaml";
  request.features = {"arm_l/proxy=off", "arm_l_hand_index/fingers=off"};
  Diagnostics diagnostics;
  const auto built = pipeline::build(request, s.shot, diagnostics);
  REQUIRE_MESSAGE(built, render(diagnostics, false));
  test::animate(s.shot, 10);
  test::write_biped(s.folder, 2, {{"biped.yaml", "as: arm_l,", "as: left_arm, was: [arm_l],"}});
  s.update();
  CHECK(s.orphans() == 0);
  CHECK(s.rules() == "");
  CHECK(test::differences(test::keys_of(s.before), test::keys_of(s.after)) == "");
  bool exact = false;
  CHECK(test::motion_difference(s.before, s.after, "", &exact) == 0);
  CHECK(exact);
  // What was set for the part is set for it under its new name.
  const auto report = nlohmann::json::parse(s.result.json)["rigs"][0];
  CHECK(report["settings_dropped"].empty());
  const tags::Settings& settings = s.after.rigs.front().settings;
  REQUIRE(settings.features.size() == 2);
  CHECK(settings.features[0].group == "left_arm");
  CHECK(settings.features[1].group == "left_arm_hand_index");
}

TEST_CASE("named edits: a template is forked") {
  Story s("fork");
  test::write_biped(s.folder, 1);
  s.build("biped.yaml", 11);
  std::string fork = replaced(test::bytes_of(s.folder + "/biped.yaml"), "name: biped\nversion: 1\n",
                              "name: hero_biped\nwas: [biped]\nversion: 1\n");
  test::write_text(s.folder + "/hero_biped.yaml", fork);
  pipeline::UpdateSettings settings;
  settings.to = "hero_biped";
  s.update(settings);
  CHECK(s.orphans() == 0);
  CHECK(s.after.rigs.front().skeleton.templates.front().name == "hero_biped");
  CHECK(test::differences(test::keys_of(s.before), test::keys_of(s.after)) == "");
  bool exact = false;
  CHECK(test::motion_difference(s.before, s.after, "", &exact) == 0);
  CHECK(exact);
  // From now on the shot follows the fork.
  test::write_text(s.folder + "/hero_biped.yaml",
                   replaced(fork, "\nversion: 1\n", "\nversion: 2\n"));
  s.update();
  CHECK(s.after.rigs.front().skeleton.templates.front().version == 2);
  CHECK(s.orphans() == 0);
}

namespace {

/// A second rig of the template in the file.
void add_hero(const std::string& template_file, const std::string& path,
              const std::string& global) {
  Diagnostics diagnostics;
  pipeline::BuildRequest request;
  request.template_file = template_file;
  request.global = global;
  auto prepared = pipeline::prepare(request, diagnostics);
  REQUIRE_MESSAGE(prepared, render(diagnostics, false));
  prepared->rig_id = 1;
  std::size_t skipped = 0;
  auto rig = pipeline::run_commands(*prepared, prepared->catalogue, skipped, diagnostics);
  REQUIRE(rig);
  const Shot shot = test::read_shot(path);
  gltf::Patch patch(*shot.file);
  std::uint64_t bytes = 0;
  REQUIRE(gltf::write_rig(patch, *rig, -1, diagnostics));
  REQUIRE(pipeline::write_output(patch, *shot.file, path, bytes, diagnostics));
}

std::string rig_text(const Shot& shot, std::size_t index) {
  return std::string(shot.file->root()["extensions"]["RIGC_rig"]["rigs"].items()[index].text());
}

}  // namespace

TEST_CASE("named edits: of two heroes in a shot only one is updated") {
  Story s("two_heroes");
  test::write_text(s.folder + "/main.yaml", kArm);
  test::build_rig(s.folder + "/main.yaml", s.shot, "", "ada");
  add_hero(s.folder + "/main.yaml", s.shot, "bob");
  test::animate(s.shot, 12);
  for (const std::size_t updated : {0u, 1u}) {
    const std::size_t other = 1 - updated;
    test::write_text(s.folder + "/main.yaml", ik_fk_arm(2 + static_cast<int>(updated)));
    pipeline::UpdateSettings settings;
    settings.rigs = {updated == 0 ? "ada" : "bob"};
    s.update(settings);
    CHECK(s.orphans() == 0);
    CHECK(s.after.rigs[updated].skeleton.templates.front().version ==
          2 + static_cast<int>(updated));
    CHECK(rig_text(s.before, other) == rig_text(s.after, other));
    CHECK(s.before.rigs[other].nodes == s.after.rigs[other].nodes);
    for (const int node : s.before.rigs[other].nodes) {
      if (node < 0) continue;
      const auto at = static_cast<std::size_t>(node);
      CHECK(s.before.file->root()["nodes"].items()[at].text() ==
            s.after.file->root()["nodes"].items()[at].text());
    }
    bool exact = false;
    CHECK(test::motion_difference(s.before, s.after, updated == 0 ? "bob" : "ada", &exact) == 0);
    CHECK(exact);
    CHECK(test::motion_difference(s.before, s.after, settings.rigs.front()) < kRounding);
  }
}

TEST_CASE("named edits: a switch and a pose that have no keys") {
  Story s("unkeyed");
  test::write_biped(s.folder, 1);
  s.build("biped.yaml", 13, {0, 0, 0, 1});
  test::Character character = test::load_character(s.shot);
  const gltf::Rig& rig = s.original.rigs.front();
  ordered_json& settings = node_of(character, rig, control(rig, "arm_l", "wrist", "settings"));
  settings["extras"]["ik_fk"] = 1.0;
  ordered_json& ik = node_of(character, rig, control(rig, "arm_l", "wrist", "ik"));
  ik["translation"] = {0.1, -0.2, 0.3};
  ordered_json& shoulder = node_of(character, rig, control(rig, "arm_r", "shoulder", "fk"));
  shoulder["rotation"] = {0, 0, 0.6, 0.8};
  test::save_glb(character, s.shot);
  const std::vector<ordered_json> set = {settings, ik, shoulder};

  const std::vector<std::string> before = test::keys_of(test::read_shot(s.shot));
  CHECK(before.size() == 3);
  for (int number = 2; number <= 4; ++number) {
    // A version with another control, and one without it again.
    const test::TextEdit more{"biped.yaml", "        with: {size: 1.1,",
                              "        with: {size: 1.2,"};
    test::write_biped(
        s.folder, number,
        number % 2 ? std::vector<test::TextEdit>{} : std::vector<test::TextEdit>{more});
    s.update();
    CHECK(test::differences(before, test::keys_of(s.after)) == "");
    bool exact = false;
    CHECK(test::motion_difference(s.before, s.after, "", &exact) == 0);
    CHECK(exact);
    test::Character now = test::load_character(s.shot);
    const gltf::Rig& next = s.after.rigs.front();
    CHECK(node_of(now, next, control(next, "arm_l", "wrist", "settings"))["extras"]["ik_fk"] ==
          1.0);
    CHECK(node_of(now, next, control(next, "arm_l", "wrist", "ik"))["translation"] ==
          set[1]["translation"]);
    CHECK(node_of(now, next, control(next, "arm_r", "shoulder", "fk"))["rotation"] ==
          set[2]["rotation"]);
  }
}

namespace {

/// A joint with axes of its own, whose control has those of the character or of the joint.
std::string turned(int number, const std::string& orient) {
  return fmt::format(R"(rigc: 1
name: turned
version: {}
joints:
  - name: base
    at: [0, 1, 0]
    rotate: [20, -35, 50]
    local: body
    label: base
    tags:
      - command: control
        with: {{orient: {}, translate: on}}
  - name: tip
    parent: base
    at: [0.3, 1.4, 0.2]
    rotate: [-70, 10, 15]
    local: body
    label: tip
    tags:
      - command: control
        with: {{orient: {}, translate: on}}
)",
                     number, orient, orient);
}

}  // namespace

TEST_CASE("named edits: the zero of a control turns, and its keys with it") {
  Story s("turned");
  s.build_text(turned(1, "character"), 14, {3, 1.0, 1.0, 6, 0});
  SUBCASE("the motion stays, and so do the keys after the way back") {
    s.update_text(turned(2, "joint"));
    CHECK(s.orphans() == 0);
    CHECK(s.rules() == "identity");
    CHECK(test::motion_difference(s.before, s.after, "") < kConverted);
    s.update_text(turned(3, "character"));
    CHECK(test::motion_difference(s.original, s.after, "") < kConverted);
  }
  SUBCASE("a scale about axes that are gone is said") {
    test::animate(s.shot, 16, {1, 1.0, 0, 4, 1});
    s.update_text(turned(2, "joint"));
    const auto report = nlohmann::json::parse(s.result.json)["rigs"][0];
    CHECK(report["inexact"].size() == 2);
    CHECK(report["inexact"][0] == "body.base/control.control@scale");
    CHECK(s.orphans() == 0);
  }
  SUBCASE("keep-local leaves the keys and lets the motion change") {
    test::write_text(s.folder + "/main.yaml", turned(2, "joint"));
    pipeline::UpdateSettings settings;
    settings.keep_local = true;
    s.update(settings);
    CHECK(s.orphans() == 0);
    CHECK(test::differences(test::keys_of(s.before), test::keys_of(s.after)) == "");
    CHECK(test::motion_difference(s.before, s.after, "") > 0.01);
  }
}

namespace {

/// What another program adds behind our elements: a prop in a control's hand with a mesh and a clip
/// of its own, and a light.
void append_others(const std::string& path, int control_node) {
  test::Character file = test::load_character(path);
  ordered_json& json = file.json;
  const auto view = [&](const std::vector<float>& numbers) {
    json["bufferViews"].push_back({{"buffer", 0},
                                   {"byteOffset", file.bin.size()},
                                   {"byteLength", numbers.size() * sizeof(float)}});
    file.bin.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(float));
    return json["bufferViews"].size() - 1;
  };
  const auto accessor = [&](const std::vector<float>& numbers, const char* type, int width) {
    const std::size_t count = numbers.size() / static_cast<std::size_t>(width);
    ordered_json made = {{"bufferView", view(numbers)}, {"componentType", 5126}};
    made["count"] = count;
    made["type"] = type;
    if (width == 1) {
      made["min"] = {numbers.front()};
      made["max"] = {numbers.back()};
    } else {
      made["min"] = {-1, -1, -1};
      made["max"] = {1, 1, 1};
    }
    json["accessors"].push_back(made);
    return json["accessors"].size() - 1;
  };
  const std::size_t corners = accessor({-1, -1, -1, 1, -1, 0, 0, 1, 1}, "VEC3", 3);
  const std::size_t times = accessor({0, 0.5f, 1.25f}, "SCALAR", 1);
  const std::size_t places = accessor({0, 0, 0, 1, 1, 1, -1, -1, -1}, "VEC3", 3);
  json["meshes"].push_back(
      {{"name", "sword"}, {"primitives", {{{"attributes", {{"POSITION", corners}}}}}}});
  json["nodes"].push_back({{"name", "sword"}, {"mesh", json["meshes"].size() - 1}});
  const std::size_t sword = json["nodes"].size() - 1;
  json["nodes"].push_back({{"name", "light"}, {"extras", {{"lumen", 800}}}});
  const std::size_t light = json["nodes"].size() - 1;
  json["nodes"][static_cast<std::size_t>(control_node)]["children"].push_back(sword);
  json["nodes"][static_cast<std::size_t>(control_node)]["extras"]["note"] = "held by Ada";
  json["scenes"][0]["nodes"].push_back(light);
  ordered_json clip = {{"name", "swing"}};
  clip["channels"] = {{{"sampler", 0}, {"target", {{"node", sword}, {"path", "translation"}}}}};
  clip["samplers"] = {{{"input", times}, {"output", places}}};
  json["animations"].push_back(clip);
  json["buffers"][0]["byteLength"] = file.bin.size();
  test::save_glb(file, path);
}

/// Bytes of an accessor's view.
std::string data_of(const test::Character& file, std::size_t accessor) {
  const ordered_json& view =
      file.json["bufferViews"][file.json["accessors"][accessor]["bufferView"].get<std::size_t>()];
  return file.bin.substr(view.value("byteOffset", std::size_t{0}), view["byteLength"]);
}

}  // namespace

TEST_CASE("named edits: what another program appended behind ours stays as it is") {
  Story s("appended");
  s.build_text(kArm, 15);
  const gltf::Rig& rig = s.original.rigs.front();
  const int hand = rig.nodes[control(rig, "arm", "wrist", "fk").index];
  append_others(s.shot, hand);
  const test::Character before = test::load_character(s.shot);
  const std::size_t sword = before.json["nodes"].size() - 2, light = sword + 1;
  const auto check = [&](const char* what) {
    INFO(what);
    const test::Character after = test::load_character(s.shot);
    REQUIRE(after.json["nodes"].size() > light);
    CHECK(after.json["nodes"][sword] == before.json["nodes"][sword]);
    CHECK(after.json["nodes"][light] == before.json["nodes"][light]);
    CHECK(after.json["animations"].back() == before.json["animations"].back());
    const std::size_t mesh = before.json["meshes"].size() - 1;
    CHECK(after.json["meshes"][mesh] == before.json["meshes"][mesh]);
    for (std::size_t i = before.json["accessors"].size() - 3; i < before.json["accessors"].size();
         ++i) {
      CHECK(after.json["accessors"][i] == before.json["accessors"][i]);
      CHECK(data_of(after, i) == data_of(before, i));
    }
    // It hangs under the same control, wherever that is now.
    const gltf::Rig& now = s.after.rigs.front();
    const int holder = now.nodes[control(now, "arm", "wrist", "fk").index];
    const ordered_json& node = after.json["nodes"][static_cast<std::size_t>(holder)];
    const ordered_json& children = node["children"];
    CHECK(std::find(children.begin(), children.end(), sword) != children.end());
    CHECK(node["extras"]["note"] == "held by Ada");
    const ordered_json& roots = after.json["scenes"][0]["nodes"];
    CHECK(std::find(roots.begin(), roots.end(), light) != roots.end());
  };
  s.update_text(ik_fk_arm(2));
  CHECK(s.orphans() == 0);
  CHECK(test::motion_difference(s.before, s.after, "") < kRounding);
  check("more nodes");
  s.update_text(version(3, kArm));
  check("fewer nodes");
  CHECK(test::differences(test::keys_of(s.original), [&] {
          auto keys = test::keys_of(s.after);
          std::erase_if(keys,
                        [](const std::string& line) { return line.rfind("? swing", 0) == 0; });
          return keys;
        }()) == "");
}

}  // namespace rigc
