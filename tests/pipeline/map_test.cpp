// SPDX-License-Identifier: MIT
// `rigc map`: YAML and JSON of a guess, its determinism, templates other than the biped.
#include "pipeline/map.h"

#include <doctest/doctest.h>

#include "pipeline/character_helpers.h"

namespace rigc {
namespace {

using nlohmann::ordered_json;

pipeline::BuildRequest request_for(const std::string& model, const std::string& name = "biped") {
  pipeline::BuildRequest request;
  request.template_file = name;
  request.paths.templates = {test::templates_folder()};
  request.model = model;
  return request;
}

}  // namespace

TEST_CASE("pipeline map: YAML and JSON say the same, every time and from every folder") {
  const std::string model = test::corpus_file("khronos_CesiumMan/CesiumMan.glb");
  if (model.empty()) return;
  Diagnostics diagnostics;
  const auto map = pipeline::guess_map(request_for(model), "some/where/my man.yaml", diagnostics);
  REQUIRE_MESSAGE(map, render(diagnostics, false));
  CHECK(diagnostics.all().empty());
  CHECK(map->yaml.find("map: my_man\n") != std::string::npos);
  CHECK(map->yaml.find(model) == std::string::npos);
  CHECK(map->yaml.find("CesiumMan.glb") != std::string::npos);
  const auto again = pipeline::guess_map(request_for(model), "my man.yaml", diagnostics);
  CHECK(again->yaml == map->yaml);
  CHECK(again->json == map->json);

  const auto json = ordered_json::parse(map->json);
  CHECK(json["map"] == "my_man");
  CHECK(json["nearest"] == "generic");
  CHECK(json["fits"] == false);
  CHECK(json["unmapped"].empty());
  std::size_t bones = 0;
  for (const auto& joint : json["joints"]) {
    for (const char* key : {"local", "label", "joint", "required", "sure", "why", "candidates"})
      CHECK(joint.contains(key));
    for (const auto& bone : joint["bones"]) {
      ++bones;
      CHECK(map->yaml.find(bone["bone"].get<std::string>()) != std::string::npos);
      CHECK(bone["node"].is_number_integer());
    }
  }
  CHECK(bones == 19);
}

TEST_CASE("pipeline map: a quadruped's bones are found by the labels of its template") {
  const std::string model = test::corpus_file("khronos_Fox/Fox.glb");
  if (model.empty()) return;
  Diagnostics diagnostics;
  const auto map = pipeline::guess_map(request_for(model, "quadruped"), "", diagnostics);
  REQUIRE_MESSAGE(map, render(diagnostics, false));
  for (const char* line :
       {"torso.hips: b_Hip_01 ", "head.head: b_Head_05 ", "front_l.shoulder: b_LeftUpperArm_09 ",
        "front_r.elbow: b_RightForeArm_07 ", "hind_l.hip: b_LeftLeg01_015 ",
        "hind_r.knee: b_RightLeg02_020 ", "tail: [b_Tail01_012, b_Tail02_013, b_Tail03_014] "})
    CHECK_MESSAGE(map->yaml.find(line) != std::string::npos, line, map->yaml);
}

TEST_CASE("pipeline map: files that are no character give their own errors") {
  Diagnostics diagnostics;
  CHECK_FALSE(pipeline::guess_map(request_for("absent.glb"), "", diagnostics));
  CHECK(diagnostics.errors() == 1);
  const std::string model = test::corpus_file("khronos_CesiumMan/CesiumMan.glb");
  if (model.empty()) return;
  Diagnostics second;
  CHECK_FALSE(pipeline::guess_map(request_for(model, "no_such_template"), "", second));
  CHECK(second.errors() == 1);
  Diagnostics third;
  auto request = request_for(model);
  request.skeleton = "nobody";
  CHECK_FALSE(pipeline::guess_map(request, "", third));
  REQUIRE(third.errors() == 1);
  CHECK(third.all()[0].code->number == 752);
}

}  // namespace rigc
