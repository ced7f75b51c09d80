// SPDX-License-Identifier: MIT
// Builds of the templates that come with rigc, and of the biped on a real character: what comes
// out, and that nothing of the character is lost.
#include "pipeline/build.h"

#include <doctest/doctest.h>

#include "base/files.h"
#include "pipeline/character_helpers.h"
#include "pipeline/check.h"
#include "pipeline/inspect.h"

namespace rigc {
namespace {

using nlohmann::ordered_json;

std::optional<pipeline::Built> build(const std::string& name, const std::string& out,
                                     const std::string& model = {}) {
  Diagnostics diagnostics;
  pipeline::BuildRequest request;
  request.template_file = test::templates_folder() + "/" + name;
  request.paths.templates = {test::templates_folder()};
  request.model = model;
  if (!model.empty()) request.features = {"eyes=off"};  // they would bend nothing, which is said
  auto built = pipeline::build(request, out, diagnostics);
  if (!model.empty()) test::made_from(out, model);
  CHECK_MESSAGE(built, render(diagnostics, false));
  CHECK_MESSAGE(diagnostics.warnings() == 0, render(diagnostics, false));
  return built;
}

/// What a node was before rigc: without our identity in its extras.
ordered_json without_identity(ordered_json node) {
  if (node.contains("extras")) {
    node["extras"].erase("rigc");
    if (node["extras"].empty()) node.erase("extras");
  }
  return node;
}

}  // namespace

TEST_CASE("pipeline build: every template that comes with rigc builds, twice to the same bytes") {
  std::vector<std::string> names;
  for (const std::string& file : list_folder(test::templates_folder())) {
    if (file.ends_with(".yaml")) names.push_back(file);
  }
  for (const std::string& tutorial : list_folder(test::templates_folder() + "/tutorial")) {
    if (tutorial.ends_with(".yaml")) names.push_back("tutorial/" + tutorial);
  }
  CHECK(names.size() >= 18);
  for (const std::string& name : names) {
    CAPTURE(name);
    const std::string out = test::test_out("template_" + stem_of(name) + ".glb");
    if (!build(name, out)) continue;
    const std::string again = test::test_out("again.glb");
    build(name, again);
    CHECK(test::bytes_of(out) == test::bytes_of(again));
    Diagnostics diagnostics;
    CHECK_MESSAGE(pipeline::check(out, {}, diagnostics), render(diagnostics, false));
  }
}

TEST_CASE(
    "pipeline build: parts can be checked alone, also those that need groups of an outer "
    "template") {
  for (const std::string& part : list_folder(test::templates_folder() + "/parts")) {
    CAPTURE(part);
    Diagnostics diagnostics;
    pipeline::Paths paths;
    paths.templates = {test::templates_folder()};
    const std::string file = test::templates_folder() + "/parts/" + part;
    CHECK_MESSAGE(pipeline::check(file, paths, diagnostics), render(diagnostics, false));
  }
}

TEST_CASE("pipeline build: inspect --json has the form that scripts rely on") {
  const std::string out = test::test_out("inspect_biped.glb");
  REQUIRE(build("biped.yaml", out));
  Diagnostics diagnostics;
  const auto text = pipeline::inspect(out, true, diagnostics);
  REQUIRE(text);
  const auto json = ordered_json::parse(*text);
  CHECK(json["clips"].is_array());
  REQUIRE(json["rigs"].size() == 1);
  const auto& rig = json["rigs"][0];
  CHECK(rig["global"] == "biped");
  CHECK(rig["template"]["name"] == "biped");
  CHECK(rig["template"]["version"].is_number_integer());
  CHECK(rig["groups"].size() >= 6);
  for (const char* list : {"groups", "features", "joints", "controls", "commands", "orphans"})
    CHECK(rig[list].is_array());
  for (const char* key : {"uid", "node", "name", "local", "label"})
    CHECK(rig["joints"][0].contains(key));
  CHECK(rig["controls"].size() > 50);
  for (const auto& control : rig["controls"]) {
    for (const char* key : {"node", "identity", "name", "local", "label", "module", "id", "role",
                            "opposite", "attributes"}) {
      CHECK(control.contains(key));
    }
  }
  const test::Character file = test::load_glb(out);
  const auto& first = rig["controls"][0];
  CHECK(file.json["nodes"][first["node"].get<std::size_t>()]["extras"]["rigc"] ==
        first["identity"]);
}

TEST_CASE("pipeline build: nothing of a real character is lost") {
  const std::string model = test::corpus_file("mixamo_Xbot_blender/Xbot.glb");
  if (model.empty()) return;
  const std::string out = test::test_out("xbot_rig.glb");
  REQUIRE(build("biped.yaml", out, model));
  const test::Character before = test::load_glb(model);
  const test::Character after = test::load_glb(out);
  CHECK(after.bin.substr(0, before.bin.size()) == before.bin);
  for (const auto& item : before.json.items()) {
    const std::string key = item.key();
    const auto& value = item.value();
    if (!value.is_array() || key == "nodes" || key == "extensionsUsed") continue;
    CAPTURE(key);
    REQUIRE(after.json[key].size() >= value.size());
    for (std::size_t i = 0; i < value.size(); ++i) {
      if (key == "buffers" && i == 0) continue;  // byteLength grew
      CHECK(after.json[key][i] == value[i]);
    }
  }
  std::size_t grew = 0;
  for (std::size_t i = 0; i < before.json["nodes"].size(); ++i) {
    ordered_json was = before.json["nodes"][i], now = without_identity(after.json["nodes"][i]);
    if (was.value("children", ordered_json::array()) !=
        now.value("children", ordered_json::array())) {
      ++grew;
      was.erase("children");
      now.erase("children");
    }
    CHECK(was == now);
  }
  CHECK(grew == 1);  // the node above the skeleton, under which the rig hangs
}

TEST_CASE("pipeline build: a skeleton that has a rig is refused and nothing is written") {
  const std::string model = test::corpus_file("mixamo_Xbot_blender/Xbot.glb");
  if (model.empty()) return;
  const std::string once = test::test_out("refused_once.glb"),
                    twice = test::test_out("refused_twice.glb");
  REQUIRE(build("biped.yaml", once, model));
  Diagnostics diagnostics;
  pipeline::BuildRequest request;
  request.template_file = test::templates_folder() + "/biped.yaml";
  request.paths.templates = {test::templates_folder()};
  request.model = once;
  CHECK_FALSE(pipeline::build(request, twice, diagnostics));
  REQUIRE(diagnostics.errors() == 1);
  CHECK(diagnostics.all().front().code->number == 753);
  CHECK_FALSE(file_exists(twice));
}

}  // namespace rigc
