// SPDX-License-Identifier: MIT
// Features that move no vertex of a character say so, once each, and others say nothing.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>

#include "base/text.h"
#include "gltf/unmoved.h"
#include "pipeline/build.h"
#include "pipeline/character_helpers.h"
#include "pipeline/named_edits_helpers.h"

namespace rigc {
namespace {

using Texts = std::vector<std::string>;

constexpr int kMovesNothing = 910;

/// The messages of that code, without what all begin with.
Texts said(const Diagnostics& diagnostics) {
  Texts out;
  for (const Diagnostic& one : diagnostics.all())
    if (one.code->number == kMovesNothing)
      out.push_back(test::replaced(one.message, " moves no vertex of this model", ""));
  std::sort(out.begin(), out.end());
  return out;
}

struct Built {
  std::string path;
  Texts said;
};

Built build(const std::string& model, const Texts& features, bool split_weights = false,
            const std::string& map = {}) {
  pipeline::BuildRequest request;
  request.template_file = test::templates_folder() + "/biped.yaml";
  request.paths.templates = {test::templates_folder()};
  request.model = model;
  request.map = map;
  request.features = features;
  request.split_weights = split_weights;
  Diagnostics diagnostics;
  Built out;
  out.path = test::test_out("unmoved_" + (model.empty() ? "bare" : stem_of(model)) + "_rig.glb");
  REQUIRE_MESSAGE(pipeline::build(request, out.path, diagnostics), render(diagnostics, false));
  if (!model.empty()) test::made_from(out.path, model);
  out.said = said(diagnostics);
  return out;
}

Texts rebuild(const std::string& path, const Texts& features, const std::string& split = {}) {
  pipeline::RebuildRequest request;
  request.features = features;
  request.split_weights = split;
  catalog::Catalogue catalogue;
  Diagnostics diagnostics;
  REQUIRE(pipeline::add_modules({}, catalogue, diagnostics));
  REQUIRE_MESSAGE(pipeline::rebuild(request, catalogue, {path, path, ""}, diagnostics),
                  render(diagnostics, false));
  return said(diagnostics);
}

/// A character with capsules for flesh, what is left of the bare biped without its rig, and how the
/// biped finds its joints again.
struct Capsules {
  std::string model = test::test_out("unmoved_capsules.glb");
  std::string map = test::test_out("unmoved_capsules_map.yaml");
  Capsules() {
    const std::string bare = rigc::build({}, {}).path;
    std::string text = "map: capsules\njoints:\n";
    const test::Shot shot = test::read_shot(bare);
    for (const tags::TaggedJoint& joint : shot.rigs.front().skeleton.joints)
      if (joint.ids.local != "root" && joint.key.ordinal == 0 &&
          (!joint.ids.label.empty() || joint.ids.local == "spine"))
        text +=
            "  " +
            (joint.ids.label.empty() ? joint.ids.local : joint.ids.local + "." + joint.ids.label) +
            ": " + joint.name + "\n";
    test::write_text(map, text);
    Diagnostics diagnostics;
    REQUIRE(pipeline::strip({}, {bare, model, ""}, diagnostics));
  }
  /// Its eyes have no flesh.
  Built build(Texts features, bool split_weights = false) const {
    features.push_back("eyes=off");
    return rigc::build(model, features, split_weights, map);
  }
};

const std::string kLimbs = " in arm_l, arm_r, leg_l, leg_r";

}  // namespace

TEST_CASE("pipeline unmoved: a rig without a model says nothing, built or rebuilt") {
  const Built bare = build({}, {"twist=on", "ribbons=on"});
  CHECK(bare.said.empty());
  CHECK(rebuild(bare.path, {"stretch=on"}).empty());
}

TEST_CASE("pipeline unmoved: new joints do until they share weights") {
  const Capsules capsules;
  CHECK(capsules.build({}).said.empty());
  CHECK(capsules.build({"twist=on", "ribbons=on"}, true).said.empty());
  CHECK(capsules.build({"arm_l/twist=on", "stretch=on"}).said ==
        Texts{"the feature \"twist\" in arm_l"});
  const Built plain = capsules.build({"twist=on", "ribbons=on"});
  CHECK(plain.said == Texts{"the feature \"ribbons\"" + kLimbs, "the feature \"twist\"" + kLimbs});
  CHECK(rebuild(plain.path, {}, "on").empty());
  CHECK(rebuild(plain.path, {"ribbons=off"}).empty());
  CHECK(rebuild(plain.path, {}, "off") == Texts{"the feature \"twist\"" + kLimbs});
  CHECK(rebuild(plain.path, {"twist=off"}).empty());
}

TEST_CASE("pipeline unmoved: features on bones that bend nothing, on characters of the corpus") {
  const Texts all{"twist=on",  "ribbons=on", "stretch=on", "auto_hip=on", "vector_foot=on",
                  "gimbal=on", "hinges=on",  "eyes=on",    "fingers=on",  "fingertips=on"};
  const std::string hand =
      " in arm_l, arm_l_hand_index, arm_l_hand_middle, arm_l_hand_pinky, "
      "arm_l_hand_ring, arm_l_hand_thumb and 6 more groups";
  const std::string tips =
      " in arm_l_hand_index, arm_l_hand_middle, arm_l_hand_pinky, "
      "arm_l_hand_ring, arm_l_hand_thumb, arm_r_hand_index and 4 more groups";
  const std::string eyes = "the feature \"eyes\"";
  const std::vector<std::pair<std::string, Texts>> characters{
      {"mixamo_Xbot_blender/Xbot.glb", {eyes + " in head_eyes"}},
      {"gdquest_mannequiny/mannequiny-0.3.0.glb", {eyes}},  // it has none
      {"rpm_avatar_a/646d9dcdc8a5f5bddbfac913.glb", {}},
      {"vrm0_catbot_unigltf/catbot.vrm",
       {"the feature \"fingers\"" + hand, "the feature \"fingertips\"" + tips}},
      // Of rigid pieces, which hang on bones.
      {"vrm1_Example/Example.vrm",
       {eyes + " in head_eyes", "the feature \"fingers\"" + hand,
        "the feature \"fingertips\"" + tips, "the feature \"ribbons\"" + kLimbs,
        "the feature \"twist\"" + kLimbs}}};
  for (const auto& character : characters) {
    const auto& file = character.first;
    const Texts& expected = character.second;
    CAPTURE(file);
    const std::string model = test::corpus_file(file);
    if (model.empty()) continue;
    const Built built = build(model, all, true);
    CHECK(built.said == expected);
    CHECK(rebuild(built.path, {}) == expected);
  }
}

TEST_CASE("pipeline ribbon: what is weighted to a model's own twist joint follows it too") {
  const Capsules capsules;
  test::Character model = test::load_glb(capsules.model);
  auto& nodes = model.json["nodes"];
  const auto node = [&](const std::string& name) {
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (nodes[i].value("name", "") == name) return static_cast<int>(i);
    FAIL("no node " << name);
    return -1;
  };
  // The flesh of the forearm goes to a joint in its middle.
  const int elbow = node("arm_l_elbow"), roll = static_cast<int>(nodes.size());
  std::vector<float> half;
  for (const double x : nodes[static_cast<std::size_t>(node("arm_l_wrist"))]["translation"])
    half.push_back(static_cast<float>(x / 2));
  nodes.push_back({{"name", "arm_l_roll"}, {"translation", half}});
  nodes[static_cast<std::size_t>(elbow)]["children"].push_back(roll);
  for (auto& skin : model.json["skins"]) {
    const auto& matrices = model.json["accessors"][skin["inverseBindMatrices"].get<std::size_t>()];
    const auto& view = model.json["bufferViews"][matrices["bufferView"].get<std::size_t>()];
    const auto begin =
        view.value("byteOffset", std::size_t{0}) + matrices.value("byteOffset", std::size_t{0});
    for (std::size_t k = 0; k < skin["joints"].size(); ++k) {
      if (skin["joints"][k] != elbow) continue;
      skin["joints"][k] = roll;
      for (std::size_t c = 0; c < 3; ++c) {
        float x = 0;
        char* at = model.bin.data() + begin + 4 * (16 * k + 12 + c);
        std::memcpy(&x, at, 4);
        x -= half[c];
        std::memcpy(at, &x, 4);
      }
    }
  }
  const std::string path = test::test_out("unmoved_roll.glb");
  test::save_glb(model, path);
  const Built built = build(path, {"eyes=off", "ribbons=on", "twist=on"}, true, capsules.map);
  CHECK(built.said.empty());
  Diagnostics diagnostics;
  const auto file = gltf::open(built.path, diagnostics);
  REQUIRE(file);
  const gltf::Movers movers = gltf::find_movers(gltf::Patch(*file), {});
  CHECK(!movers.skinned.contains(roll));
  std::size_t pins = 0;
  for (const json::Value& child :
       file->root()["nodes"].items()[static_cast<std::size_t>(elbow)]["children"].items())
    pins += movers.skinned.contains(static_cast<int>(*child.integer())) ? 1 : 0;
  CHECK(pins >= 3);
  REQUIRE(pipeline::strip({}, {built.path, built.path, ""}, diagnostics));
  CHECK(test::bytes_of(built.path) == test::bytes_of(path));
}

TEST_CASE("rebuild: weights are shared and given back, and every key stays") {
  test::Story story("rebuild_split");
  const Capsules capsules;
  const Built built = capsules.build({"twist=on", "ribbons=on"});
  story.shot = story.folder + "/shot.glb";
  test::write_text(story.shot, test::bytes_of(built.path));
  test::animate(story.shot, 31, {1, 0.5, 0.3, 3, 0});
  story.original = test::read_shot(story.shot);
  const auto skins = [&] { return test::load_glb(story.shot).json["skins"]; };
  const auto before = skins();
  CHECK(rebuild(story.shot, {}, "on").empty());
  CHECK(skins() != before);
  CHECK(test::differences(test::keys_of(story.original),
                          test::keys_of(test::read_shot(story.shot))) == "");
  CHECK(test::motion_difference(story.original, test::read_shot(story.shot), "") < 1e-6);
  // Not said again, it stays.
  rebuild(story.shot, {});
  CHECK(skins() != before);
  rebuild(story.shot, {}, "off");
  CHECK(skins() == before);
  rebuild(story.shot, {}, "on");
  rebuild(built.path, {}, "on");
  Diagnostics diagnostics;
  for (const std::string& path : {story.shot, built.path})
    REQUIRE(pipeline::strip({}, {path, path, ""}, diagnostics));
  CHECK(skins() == test::load_glb(capsules.model).json["skins"]);
  CHECK(test::bytes_of(built.path) ==
        test::bytes_of(capsules.model));  // the shot's clips stay, empty
  pipeline::RebuildRequest request;
  request.split_weights = "maybe";
  catalog::Catalogue catalogue;
  REQUIRE(pipeline::add_modules({}, catalogue, diagnostics));
  CHECK(!pipeline::rebuild(request, catalogue, {built.path, built.path, ""}, diagnostics));
}

}  // namespace rigc
