// SPDX-License-Identifier: MIT
// Edits of templates that riggers make, by name: none loses a key, and nothing moves that should
// not.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>

#include "pipeline/character_helpers.h"
#include "pipeline/named_edits_helpers.h"

namespace rigc {
namespace {

using test::fk_arm;
using test::ik_fk_arm;
using test::kRounding;
using test::replaced;
using test::Shot;
using test::Story;

std::string version(int number, const std::string& text) {
  return replaced(text, "version: 1\n", fmt::format("version: {}\n", number));
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
  s.build_text(fk_arm(1), 1);
  s.update_text(ik_fk_arm(2));
  CHECK(s.orphans() == 0);
  CHECK(s.rules() == "replaces");
  // The new limb stands at FK: what was keyed plays on.
  CHECK(test::motion_difference(s.before, s.after, "") < kRounding);

  SUBCASE("without other keys the way back gives the same file's keys and motion") {
    s.update_text(fk_arm(3));
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
    s.update_text(fk_arm(3));
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

/// The biped with features on that are off by default, by their titles, and further edits.
std::vector<test::TextEdit> with_features(const std::vector<std::string>& titles,
                                          std::vector<test::TextEdit> edits = {}) {
  for (const std::string& title : titles)
    edits.push_back({"biped.yaml", "title: " + title + ", default: off", "title: " + title});
  return edits;
}

TEST_CASE("named edits: legs at IK come back at IK") {
  // Spaces, and where they are on stretch and gimbals, put attributes on FK controls that plain FK
  // has not: they wait, and what plays comes back to the same controls beside them.
  std::vector<std::string> features;
  SUBCASE("by default") {}
  SUBCASE("stretch and gimbal") { features = {"Stretch", "Gimbal controls"}; }
  Story s("biped_fk_and_back");
  test::write_biped(s.folder, 1, with_features(features));
  s.build("biped.yaml", 17);
  const test::TextEdit ikfk{"biped.yaml", "kind: limb, title: IK/FK, switches",
                            "kind: limb, title: IK/FK, default: off, switches"},
      fk{"biped.yaml", "title: Plain FK, default: off,", "title: Plain FK,"};
  test::write_biped(s.folder, 2, with_features(features, {ikfk, fk}));
  s.update();
  CHECK(s.orphans() > 0);
  test::write_biped(s.folder, 3, with_features(features, {ikfk, fk}));
  s.update();
  test::write_biped(s.folder, 4, with_features(features));
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
    s.build_text(fk_arm(1), 4);
    std::string text = replaced(fk_arm(2), "  - name: shoulder\n    parent: chest\n",
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
  // Keys of attributes lie outside their limits here too. A limb that stretches is straight at the
  // edge of its reach, where its middle moves by the root of what its end does.
  std::vector<std::string> features;
  double rounding = kRounding;
  bool biped = false;
  SUBCASE("biped") { biped = true; }
  SUBCASE("biped with stretch and gimbals") {
    biped = true;
    features = {"Stretch", "Gimbal controls"};
    rounding = 1e-7;
  }
  for (unsigned seed = 5; biped && seed < 8; ++seed) {
    CAPTURE(seed);
    Story s("biped_clavicle");
    test::write_biped(s.folder, 1, with_features(features, test::without_clavicle()));
    // Nobody may key scales of these controls; a joint under a scaled one moves on.
    s.build("biped.yaml", seed, {2, 0.6, 0.3, 6, 0});
    test::write_biped(s.folder, 2, with_features(features));
    s.update();
    CHECK(s.orphans() == 0);
    CHECK(s.rules() == "");
    CHECK(test::motion_difference(s.before, s.after, "") < rounding);
    const auto report = nlohmann::json::parse(s.result.json)["rigs"][0];
    CHECK(report["joints_added"] == nlohmann::json::array({"arm_l_clavicle", "arm_r_clavicle"}));
    CHECK(report["largest_mm"].get<double>() < 2e3 * rounding);
  }
}

TEST_CASE("named edits: a command moves to another joint and says what it was") {
  const std::string command =
      "      - command: fk_chain\n"
      "        with: {joints: [arm.shoulder, arm.elbow, arm.wrist], size: 0.2}\n";
  Story s("moved_command");
  s.build_text(fk_arm(1), 6);
  std::string text = replaced(fk_arm(2), "    tags:\n" + command, "");
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
  std::string first = replaced(fk_arm(1), "    tags:\n" + command, "");
  first = replaced(
      first, "      - command: control\n        with: {size: 0.4}\n",
      replaced(command, chain, "joints: [body.chest, arm.shoulder, arm.elbow, arm.wrist]"));
  Story s("shorter_command");
  s.build_text(first, 7);
  std::string next =
      replaced(fk_arm(2), "size: 0.2}\n", "size: 0.2}\n        was: [chest/fk_chain]\n");
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

}  // namespace rigc
