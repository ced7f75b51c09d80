// SPDX-License-Identifier: MIT
// Every humanoid of the corpus gets the biped, by the map that detection finds or by one written
// for it; odd skeletons are rigged or refused with a reason.
#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <map>

#include "base/files.h"
#include "gltf/rig.h"
#include "pipeline/build.h"
#include "pipeline/character_helpers.h"
#include "pipeline/map.h"
#include "support/corpus.h"

namespace rigc {
namespace {

using nlohmann::ordered_json;

pipeline::BuildRequest request_for(const std::string& model, const std::string& map = {}) {
  pipeline::BuildRequest request;
  request.template_file = test::templates_folder() + "/biped.yaml";
  request.paths.templates = {test::templates_folder()};
  request.model = model;
  request.map = map;
  return request;
}

std::string out_of(const std::string& model, const std::string& what) {
  return test::test_out(what + "_" + stem_of(model) + ".glb");
}

/// Xbot's names and nodes, changed; written as a new character.
template <class Change>
std::string changed_xbot(const std::string& name, Change change) {
  const std::string model = test::corpus_file("mixamo_Xbot_blender/Xbot.glb");
  if (model.empty()) return {};
  test::Character xbot = test::load_glb(model);
  change(xbot.json);
  const std::string path = test::test_out(name + ".glb");
  test::save_glb(xbot, path);
  test::made_from(path, path);
  return path;
}

/// How far the knees stand before the lines from hips to ankles, and the balls before the ankles.
double legs_forward(const tags::TaggedSkeleton& skeleton) {
  double sum = 0;
  for (const char* leg : {"leg_l", "leg_r"}) {
    std::map<std::string, math::Vec3> at;
    for (std::size_t i = 0; i < skeleton.joints.size(); ++i)
      if (skeleton.joints[i].ids.local == leg)
        at[skeleton.joints[i].ids.label] = skeleton.world(i).origin;
    const math::Vec3 line = at["ankle"] - at["hip"];
    const math::Vec3 knee = at["knee"] - at["hip"];
    const double share = dot(knee, line) / dot(line, line);
    sum += dot(knee - line * share, skeleton.character.forward);
    if (at.count("ball")) sum += dot(at["ball"] - at["ankle"], skeleton.character.forward);
  }
  return sum;
}

std::vector<int> numbers(const Diagnostics& diagnostics) {
  std::vector<int> out;
  for (const Diagnostic& diagnostic : diagnostics.all()) out.push_back(diagnostic.code->number);
  return out;
}

std::string map_file(const std::string& name, const std::string& text) {
  const std::string path = test::test_out(name + ".yaml");
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

}  // namespace

TEST_CASE("pipeline humanoids: every one of the corpus gets the biped by its map") {
  for (const test::Humanoid& humanoid : test::humanoids()) {
    CAPTURE(humanoid.file);
    const std::string model = test::corpus_file(humanoid.file);
    if (model.empty()) continue;
    const std::string out = out_of(model, "humanoid");
    Diagnostics diagnostics;
    const auto built =
        pipeline::build(request_for(model, test::user_map(humanoid)), out, diagnostics);
    test::made_from(out, model);
    REQUIRE_MESSAGE(built, render(diagnostics, false));
    CHECK(built->fit.map == humanoid.fitted_with);
    CHECK(built->fit.matched.size() == humanoid.matched);
    CHECK(built->fit.missing.empty());
    CHECK(built->skipped == 0);
    CHECK_MESSAGE(legs_forward(built->rig.skeleton) > 0, "sides or facing are wrong");
  }
}

TEST_CASE(
    "pipeline humanoids: without its user map none of the others is rigged wrong in silence") {
  for (const test::Humanoid& humanoid : test::humanoids()) {
    if (humanoid.map.empty()) continue;
    CAPTURE(humanoid.file);
    const std::string model = test::corpus_file(humanoid.file);
    if (model.empty()) continue;
    const std::string out = out_of(model, "unmapped");
    Diagnostics diagnostics;
    CHECK_FALSE(pipeline::build(request_for(model), out, diagnostics));
    REQUIRE(numbers(diagnostics) == std::vector<int>{341});
    CHECK(diagnostics.all()[0].hint.find("comes nearest") != std::string::npos);
    CHECK(diagnostics.all()[0].hint.find("rigc map") != std::string::npos);
    CHECK_FALSE(file_exists(out));
  }
}

TEST_CASE("pipeline humanoids: the guessed map of each gives the bones of its real one") {
  for (const test::Humanoid& humanoid : test::humanoids()) {
    CAPTURE(humanoid.file);
    const std::string model = test::corpus_file(humanoid.file);
    if (model.empty()) continue;
    Diagnostics diagnostics;
    const auto real = pipeline::prepare(request_for(model, test::user_map(humanoid)), diagnostics);
    REQUIRE(real);
    const auto guess = pipeline::guess_map(request_for(model), "guess.yaml", diagnostics);
    REQUIRE_MESSAGE(guess, render(diagnostics, false));
    CHECK(guess->guess.fits == humanoid.map.empty());
    const std::string file = map_file("guess_" + stem_of(model), guess->yaml);
    const auto again = pipeline::prepare(request_for(model, file), diagnostics);
    REQUIRE_MESSAGE(again, render(diagnostics, false));
    std::size_t same = 0;
    for (const auto& match : again->fit.matched)
      same += std::any_of(real->fit.matched.begin(), real->fit.matched.end(), [&](const auto& own) {
        return own.joint == match.joint && own.node == match.node;
      });
    CHECK(same == humanoid.matched);
  }
}

TEST_CASE("pipeline humanoids: a character without any names is rigged by the map of a guess") {
  const std::string model = changed_xbot("nameless", [](ordered_json& json) {
    for (auto& node : json["nodes"]) node.erase("name");
  });
  if (model.empty()) return;
  Diagnostics diagnostics;
  CHECK_FALSE(pipeline::build(request_for(model), out_of(model, "none"), diagnostics));
  CHECK(numbers(diagnostics) == std::vector<int>{341});
  Diagnostics second;
  const auto guess = pipeline::guess_map(request_for(model), "nameless.yaml", second);
  REQUIRE(guess);
  CHECK(guess->yaml.find("/nodes/") != std::string::npos);
  const std::string out = out_of(model, "guessed");
  const auto built =
      pipeline::build(request_for(model, map_file("nameless", guess->yaml)), out, second);
  test::made_from(out, model);
  REQUIRE_MESSAGE(built, render(second, false));
  CHECK(built->fit.matched.size() == 67);
  CHECK(numbers(second) == std::vector<int>{910});  // its eyes have no weights
}

TEST_CASE("pipeline humanoids: of bones with one name the map gives each by its node") {
  const std::string model = changed_xbot("duplicates", [](ordered_json& json) {
    for (auto& node : json["nodes"]) node["name"] = "Bone";
  });
  if (model.empty()) return;
  Diagnostics diagnostics;
  const auto guess = pipeline::guess_map(request_for(model), "d.yaml", diagnostics);
  REQUIRE(guess);
  CHECK(guess->yaml.find("one of several \"Bone\"") != std::string::npos);
  const std::string out = out_of(model, "guessed");
  const auto built =
      pipeline::build(request_for(model, map_file("duplicates", guess->yaml)), out, diagnostics);
  test::made_from(out, model);
  REQUIRE_MESSAGE(built, render(diagnostics, false));
  CHECK(built->fit.matched.size() == 67);
}

TEST_CASE("pipeline humanoids: a missing required joint is an error with the bones there are") {
  const std::string model = changed_xbot("renamed", [](ordered_json& json) {
    for (auto& node : json["nodes"])
      if (node.value("name", "") == "mixamorig:LeftForeArm") node["name"] = "mixamorig:LeftFourArm";
  });
  if (model.empty()) return;
  const std::string out = out_of(model, "missing");
  Diagnostics diagnostics;
  CHECK_FALSE(pipeline::build(request_for(model, "mixamo"), out, diagnostics));
  REQUIRE(numbers(diagnostics) == std::vector<int>{343});
  CHECK(diagnostics.all()[0].hint.find("LeftFourArm") != std::string::npos);
  Diagnostics second;
  CHECK_FALSE(pipeline::build(request_for(model), out, second));
  CHECK(numbers(second) == std::vector<int>{341});
  CHECK(second.all()[0].hint.find("arm_l_elbow") != std::string::npos);
  CHECK_FALSE(file_exists(out));
}

TEST_CASE("pipeline humanoids: two skins on one skeleton are one skeleton") {
  const std::string model = changed_xbot("two_skins", [](ordered_json& json) {
    json["skins"].push_back(json["skins"][0]);
    for (auto& node : json["nodes"])
      if (node.contains("skin")) {
        node["skin"] = 1;
        break;
      }
  });
  if (model.empty()) return;
  Diagnostics diagnostics;
  const std::string out = out_of(model, "rigged");
  const auto built = pipeline::build(request_for(model), out, diagnostics);
  test::made_from(out, model);
  REQUIRE_MESSAGE(built, render(diagnostics, false));
  CHECK(built->fit.matched.size() == 67);
}

TEST_CASE("pipeline humanoids: a VRM stays itself under any names of its nodes") {
  for (const char* file : {"vrm0_catbot_unigltf/catbot.vrm", "vrm1_Example/Example.vrm"}) {
    const std::string model = test::corpus_file(file);
    if (model.empty()) continue;
    CAPTURE(file);
    Diagnostics diagnostics;
    const auto real = pipeline::prepare(request_for(model), diagnostics);
    REQUIRE_MESSAGE(real, render(diagnostics, false));
    test::Character character = test::load_glb(model);
    auto& nodes = character.json["nodes"];
    std::vector<std::string> names;
    for (const auto& node : nodes) names.push_back(node.value("name", ""));
    for (std::size_t i = 0; i < names.size(); ++i) nodes[i]["name"] = names[names.size() - 1 - i];
    const std::string shuffled = test::test_out("shuffled_" + stem_of(model) + ".glb");
    test::save_glb(character, shuffled);
    test::made_from(shuffled, shuffled);
    const auto again = pipeline::prepare(request_for(shuffled), diagnostics);
    REQUIRE_MESSAGE(again, render(diagnostics, false));
    CHECK(again->fit.map == "vrm");
    REQUIRE(again->fit.matched.size() == real->fit.matched.size());
    for (std::size_t i = 0; i < again->fit.matched.size(); ++i) {
      CHECK(again->fit.matched[i].joint == real->fit.matched[i].joint);
      CHECK(again->fit.matched[i].node == real->fit.matched[i].node);
    }
  }
}

TEST_CASE("pipeline humanoids: a user's map is told where it does nothing") {
  const std::string model = test::corpus_file("mixamo_Xbot_blender/Xbot.glb");
  if (model.empty()) return;
  const std::string text = test::bytes_of(test::templates_folder() + "/maps/mixamo.yaml");
  const std::string file =
      map_file("mine", text + "  torso.hipz: Hips\n  head_tip.x: mixamorig:Head_Endd\n");
  Diagnostics diagnostics;
  CHECK(pipeline::prepare(request_for(model, file), diagnostics));
  CHECK(diagnostics.ok());
  const std::vector<int> found = numbers(diagnostics);
  CHECK(std::count(found.begin(), found.end(), 382) == 2);
  CHECK(std::count(found.begin(), found.end(), 383) >= 1);
}

}  // namespace rigc
