// SPDX-License-Identifier: MIT
// The biped's features: all of them together and each off in turn, on the bare template and on
// every humanoid of the corpus; what each changes; keys that come back with them.
#include <doctest/doctest.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

#include "pipeline/build.h"
#include "pipeline/character_helpers.h"
#include "pipeline/named_edits_helpers.h"
#include "pipeline/shot_helpers.h"
#include "scene/access.h"
#include "support/corpus.h"

namespace rigc {
namespace {

using Features = std::vector<std::string>;

/// Made in place of another feature, not with it.
const std::map<std::string, std::string> kInPlaceOf{
    {"fk", "ikfk"}, {"spine_ik", "spine_fk"}, {"chain", "strand_fk"}};

pipeline::Built build(const Features& features, const std::string& out,
                      const std::string& model = {}, const std::string& map = {},
                      const std::string& name = "biped") {
  pipeline::BuildRequest request;
  request.template_file = test::templates_folder() + "/" + name + ".yaml";
  request.paths.templates = {test::templates_folder()};
  request.model = model;
  request.map = map;
  request.features = features;
  Diagnostics diagnostics;
  auto built = pipeline::build(request, test::test_out(out), diagnostics);
  REQUIRE_MESSAGE(built, render(diagnostics, false));
  if (!model.empty()) test::made_from(test::test_out(out), model);
  return *std::move(built);
}

/// The template's features that can all be on together.
std::vector<std::string> catalogue(const std::string& of = "biped") {
  std::vector<std::string> names;
  for (const auto& feature : build({}, "features_default.glb", {}, {}, of).rig.skeleton.features)
    if (!kInPlaceOf.count(feature.name)) names.push_back(feature.name);
  return names;
}

Features all_on(const std::string& except = {}, const std::string& of = "biped") {
  Features features;
  for (const std::string& name : catalogue(of))
    features.push_back(name + (name == except ? "=off" : "=on"));
  return features;
}

/// Every control, every attribute that was added to one, and what is locked on it.
std::set<std::string> keyable(const gltf::Rig& rig) {
  std::set<std::string> out;
  for (const scene::NodeId id : rig.scene.nodes()) {
    const scene::Node& node = rig.scene[id];
    if (node.kind != scene::Kind::control) continue;
    const std::string identity = to_text(node.identity);
    out.insert(identity);
    if (const unsigned locked = scene::bits_at(rig.scene, id, scene::control::kLocked))
      out.insert(identity + " locked " + std::to_string(locked));
    for (const scene::UserAttribute& attribute : node.user)
      out.insert(identity + "@" + attribute.name);
  }
  return out;
}

/// Each that a template has in place of another changes controls.
void check_places(const std::set<std::string>& all, const std::string& of = "biped") {
  const std::vector<std::string> names = catalogue(of);
  for (const auto& pair : kInPlaceOf) {
    if (std::find(names.begin(), names.end(), pair.second) == names.end()) continue;
    CAPTURE(pair.first);
    Features features = all_on(pair.second, of);
    features.push_back(pair.first + "=on");
    CHECK(keyable(build(features, "features_other.glb", {}, {}, of).rig) != all);
  }
}

}  // namespace

TEST_CASE("pipeline features: all of the biped's together, and each off in turn changes controls") {
  const auto all = keyable(build(all_on(), "features_all.glb").rig);
  for (const std::string& name : catalogue()) {
    if (name == "proxy") continue;  // meshes, no controls
    CAPTURE(name);
    const auto without = keyable(build(all_on(name), "features_without.glb").rig);
    CHECK(without != all);
    // Nothing comes for it, but what it took the place of.
    if (name != "ikfk" && name != "spine_fk")
      CHECK(std::includes(all.begin(), all.end(), without.begin(), without.end()));
  }
  check_places(all);
}

TEST_CASE("pipeline features: one side alone") {
  for (const std::string name : {"ikfk", "spaces", "fingers"}) {
    CAPTURE(name);
    const auto rig = build({"arm_l/" + name + "=off"}, "features_side.glb").rig;
    CHECK(keyable(rig) != keyable(build({}, "features_default.glb").rig));
  }
}

TEST_CASE("pipeline features: a group's setting reaches the groups that were made beneath it") {
  const auto controls = [](const gltf::Rig& rig) {
    std::set<std::pair<std::string, std::string>> out;  // with the group that each is in
    for (const scene::NodeId id : rig.scene.nodes())
      if (rig.scene[id].kind == scene::Kind::control)
        out.emplace(to_text(rig.scene[id].identity), rig.scene[id].ids.local);
    return out;
  };
  const auto changed = [&](const gltf::Rig& a, const gltf::Rig& b) {
    const auto left = controls(a), right = controls(b);
    std::vector<std::pair<std::string, std::string>> both;
    std::set_symmetric_difference(left.begin(), left.end(), right.begin(), right.end(),
                                  std::back_inserter(both));
    std::set<std::string> groups;
    for (const auto& control : both) groups.insert(control.second);
    return groups;
  };
  const auto hand = [](const std::string& arm, bool settings) {
    std::set<std::string> groups;
    for (const char* finger : {"thumb", "index", "middle", "ring", "pinky"})
      groups.insert(arm + "_hand_" + finger);
    if (settings) groups.insert(arm);
    return groups;
  };
  const auto plain = build({}, "features_default.glb").rig;
  const auto off = build({"arm_r/fingers=off"}, "features_side.glb").rig;
  CHECK(changed(off, plain) == hand("arm_r", true));
  const auto on = build({"arm_l/fingertips=on"}, "features_side.glb").rig;
  CHECK(changed(on, plain) == hand("arm_l", false));
  // The nearest group's counts, in whatever order.
  for (const Features& features :
       {Features{"arm_l_hand/fingers=off", "fingers=on", "arm_l_hand_index/fingers=on"},
        Features{"arm_l_hand_index/fingers=on", "arm_l_hand/fingers=off", "fingers=on"}}) {
    auto fingers = hand("arm_l", false);
    fingers.erase("arm_l_hand_index");
    CHECK(changed(build(features, "features_side.glb").rig, plain) == fingers);
  }
  // A rig's own file knows as much.
  const std::string path = test::test_out("features_again.glb");
  build({}, "features_again.glb");
  pipeline::RebuildRequest request;
  request.features = {"arm_r/fingers=off"};
  test::rebuild(path, request);
  CHECK(changed(test::read_shot(path).rigs.front(), plain) == hand("arm_r", true));
}

TEST_CASE("pipeline features: all of them on every humanoid of the corpus") {
  const Features all = all_on();
  for (const test::Humanoid& humanoid : test::humanoids()) {
    CAPTURE(humanoid.file);
    const std::string model = test::corpus_file(humanoid.file);
    if (model.empty()) continue;
    const auto built = build(all, "features_humanoid.glb", model, test::user_map(humanoid));
    const auto plain = build({}, "features_humanoid_default.glb", model, test::user_map(humanoid));
    CHECK(keyable(built.rig).size() > keyable(plain.rig).size());
  }
}

TEST_CASE("pipeline features: each off in turn on a character") {
  const std::string model = test::corpus_file("mixamo_Xbot_blender/Xbot.glb");
  if (model.empty()) return;
  const auto all = keyable(build(all_on(), "features_xbot.glb", model).rig);
  for (const std::string& name : catalogue()) {
    if (name == "proxy") continue;
    CAPTURE(name);
    CHECK(keyable(build(all_on(name), "features_xbot_without.glb", model).rig) != all);
  }
}

TEST_CASE("pipeline features: the quadruped's, alone and on the creatures of the corpus") {
  const std::string name = "quadruped";
  const auto all = keyable(build(all_on({}, name), "features_four.glb", {}, {}, name).rig);
  for (const std::string& feature : catalogue(name)) {
    if (feature == "proxy") continue;  // meshes, no controls
    CAPTURE(feature);
    const auto without = build(all_on(feature, name), "features_four_without.glb", {}, {}, name);
    CHECK(keyable(without.rig) != all);
  }
  check_places(all, name);
  const std::map<std::string, std::string> creatures{{"khronos_Fox/Fox.glb", "fox"},
                                                     {"godot_enemy/enemy.glb", "enemy"}};
  for (const auto& [file, map] : creatures) {
    const std::string model = test::corpus_file(file);
    if (model.empty()) continue;
    const std::string user_map = std::string(RIGC_SOURCE_DIR) + "/tests/maps/" + map + ".yaml";
    const auto plain = build({}, "features_creature.glb", model, user_map, name);
    const auto full = build(all_on({}, name), "features_creature_all.glb", model, user_map, name);
    CHECK(keyable(full.rig).size() > keyable(plain.rig).size());
  }
}

TEST_CASE("pipeline features: keys go with a feature and come back with it") {
  test::Story story("features_keys");
  test::write_biped(story.folder, 1);
  story.build("biped.yaml", 71, {1, 0.5, 0.3, 3, 0});
  for (const std::string name :
       {"spaces", "foot_roll", "auto_pole", "auto_clavicle", "fingers", "fingertips", "layers"}) {
    CAPTURE(name);
    for (const char* state : {"=off", "=on"}) {
      pipeline::RebuildRequest request;
      request.features = {name + state};
      test::rebuild(story.shot, request);
      CHECK(test::differences(test::keys_of(story.original),
                              test::keys_of(test::read_shot(story.shot))) == "");
    }
    CHECK(test::motion_difference(story.original, test::read_shot(story.shot), "") < 1e-6);
  }
}

}  // namespace rigc
