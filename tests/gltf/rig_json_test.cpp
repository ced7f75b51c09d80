// SPDX-License-Identifier: MIT
// RIGC_rig's text: everything comes back, and lies are found.
#include "gltf/rig_json.h"

#include <doctest/doctest.h>

#include "base/files.h"
#include "file_helpers.h"
#include "gltf/rig_codes.h"
#include "gltf/rig_places.h"
#include "rig_helpers.h"
#include "scene/random_edits.h"

using namespace rigc;
using namespace rigc::gltf;
using namespace rigc::gltf::test;

namespace {

std::optional<Rig> read(const std::string& text, Diagnostics& diagnostics) {
  const auto document = json::parse(text, "rig.glb", 0, diagnostics);
  INFO(render(diagnostics, false));
  REQUIRE(document);
  return from_json(document->root(), "rig.glb", diagnostics);
}

/// The sample as text, for tests that spoil it.
std::string sample_text() {
  Diagnostics diagnostics;
  Rig rig = sample_rig(diagnostics);
  rig.nodes.assign(rig.scene.size(), -1);
  return to_json(rig, diagnostics.sources());
}

std::string first_error(const std::string& text) {
  Diagnostics diagnostics;
  CHECK_FALSE(read(text, diagnostics));
  REQUIRE(diagnostics.errors() > 0);
  return std::to_string(diagnostics.all()[0].code->number) + " " +
         diagnostics.all()[0].place.pointer;
}

}  // namespace

TEST_CASE("gltf rig_json: everything comes back") {
  Diagnostics diagnostics;
  Rig rig = sample_rig(diagnostics);
  rig.nodes.assign(rig.scene.size(), -1);
  for (std::size_t i = 0; i < rig.nodes.size(); ++i) rig.nodes[i] = static_cast<int>(i) - 1;
  rig.ancestor = 2;
  for (const int node : {3, 4, 5, 9, 11, 12}) rig.owned.goes.nodes.add(node);
  rig.owned.stays.accessors.add(7);
  CHECK(rig.owned.goes.nodes.runs == std::vector<Range>{{3, 3}, {9, 1}, {11, 2}});
  const std::string text = to_json(rig, diagnostics.sources());
  const auto back = read(text, diagnostics);
  INFO(render(diagnostics, false));
  REQUIRE(back);
  CHECK(back->scene.dump() == rig.scene.dump());
  CHECK(back->nodes == rig.nodes);
  CHECK(back->ancestor == 2);
  CHECK(back->owned == rig.owned);
  CHECK(back->modules == rig.modules);
  CHECK(back->skeleton.character.unit == 100);
  CHECK(back->skeleton.shapes[0].lines == rig.skeleton.shapes[0].lines);
  CHECK(back->scene[with_role(*back, "control")].module == "control");
  const tags::TaggedJoint& was = rig.skeleton.joints.back();
  const tags::TaggedJoint& is = back->skeleton.joints.back();
  CHECK(is.key == was.key);
  CHECK(is.was == was.was);
  CHECK(is.rest == was.rest);
  CHECK(is.mirror.opposite == was.mirror.opposite);
  CHECK(is.template_parent == was.template_parent);
  CHECK(is.commands[0].with == was.commands[0].with);
  CHECK(is.commands[0].feature == 1);
  CHECK(diagnostics.sources().name(is.commands[0].span.file) == "parts/arm.yaml");
  CHECK(is.commands[0].span.line == 9);
  // What is not compared one by one is in the text.
  CHECK(to_json(*back, diagnostics.sources()) == text);
}

TEST_CASE("gltf rig_json: a feature's and a command's tags come back") {
  Diagnostics diagnostics;
  const auto back = read(sample_text(), diagnostics);
  REQUIRE(back);
  const tags::TaggedJoint& joint = back->skeleton.joints.back();
  CHECK(joint.features.size() == 2);
  CHECK(joint.features[0].switch_name == "arms");
  CHECK_FALSE(joint.features[0].on);
  CHECK_FALSE(joint.commands[0].on);
  CHECK(joint.commands[0].stage == "finish");
  CHECK(joint.commands[0].comment == "moves \n it");
  CHECK(joint.commands[0].was == std::vector<std::string>{"elbow/main"});
  CHECK(back->settings.features.size() == 2);
  CHECK(back->settings.rest == "walk@0.5");
  CHECK_FALSE(back->settings.groups[0].second);
  CHECK(back->commands[1].file == "lamp.yaml");
  CHECK(back->commands[1].line == 12);
}

TEST_CASE("gltf rig_json: random scenes come back") {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    Diagnostics diagnostics;
    Rig rig;
    rig.skeleton.global = "random";
    for (std::uint32_t command = 0; command < 4; ++command) {
      rig.commands.push_back({{}, "joint", "id", "module", true, "", 0});
      scene::Journal journal;
      rigc::test::RandomEdits(rig.scene, seed * 4 + command, true)
          .run(journal, nullptr, 60, command);
    }
    rig.nodes.assign(rig.scene.size(), -1);
    const std::string text = to_json(rig, diagnostics.sources());
    const auto back = read(text, diagnostics);
    INFO(render(diagnostics, false));
    REQUIRE(back);
    CHECK(back->scene.dump() == rig.scene.dump());
    CHECK(to_json(*back, diagnostics.sources()) == text);
  }
}

TEST_CASE("gltf rig_json: names of files say nothing about where a rig was built") {
  const std::vector<std::string> names = reference_names({{"biped", 1, "/home/x/t/biped.yaml", ""},
                                                          {"arm", 1, "parts/arm", ""},
                                                          {"hand", 1, "hand", ""},
                                                          {"leg", 1, "../other/leg", ""}});
  CHECK(names == std::vector<std::string>{"biped.yaml", "parts/arm", "hand", "leg"});
  CHECK(portable_name("/home/x/t/biped.yaml", names) == "biped.yaml");
  CHECK(portable_name("biped.yaml", names) == "biped.yaml");
  CHECK(portable_name("templates/parts/arm.yaml", names) == "parts/arm.yaml");
  CHECK(portable_name("/usr/share/rigc/templates/parts/arm.yaml", names) == "parts/arm.yaml");
  CHECK(portable_name("templates/parts/hand.yaml", names) == "hand.yaml");
  CHECK(portable_name("../lib/forearm.yaml", names) == "forearm.yaml");
  CHECK(portable_name("/abs/else.yaml", {}) == "else.yaml");
}

TEST_CASE("gltf rig_json: lies are found, each at its place") {
  struct Case {
    const char* from;
    const char* to;
    const char* error;
  };
  const Case cases[] = {
      {R"({"id":0,)", R"({"id":"0",)", "701 /id"},
      {R"("character":)", R"("caracter":)", "701 "},
      {R"("settings":)", R"("setings":)", "701 "},
      {R"("owned":)", R"("oned":)", "701 "},
      {R"("unit":100)", R"("unit":-1)", "708 /character"},
      {R"("name":"tip","key")", R"("name":7,"key")", "701 /joints/2/name"},
      {R"("parent":1,"template_parent")", R"("parent":2,"template_parent")",
       "702 /joints/2/parent"},
      {R"("template":1)", R"("template":2)", "702 /joints/2/template"},
      {R"("feature":1)", R"("feature":2)", "702 /joints/2/commands/0/feature"},
      {R"("kind":"expression")", R"("kind":"expresion")", "703 /nodes/9/kind"},
      {R"("code":"$0 * 2 < 3")", R"("kode":"$0 * 2 < 3")", "703 /nodes/9/values/kode"},
      {R"("code":"$0 * 2 < 3")", R"("code":5)", "701 /nodes/9/values/code"},
      {R"("flavour":"integer")", R"("flavour":"int")", "703 /nodes/7/user/2/flavour"},
      {R"("name":"roll")", R"("name":"ik_fk")", "705 /nodes/7/user/1/name"},
      {R"("name":"roll")", R"("name":"rigc")", "704 /nodes/7/user/1/name"},
      {R"("inputs":[0])", R"("inputs":0)", "708 /nodes/9/values/inputs"},
      {R"(["inputs[0]",7,"ik_fk"])", R"(["inputs[1]",7,"ik_fk"])", "707 /nodes/9/inputs/0/0"},
      {R"(["inputs[0]",7,"ik_fk"])", R"(["output",7,"ik_fk"])", "707 /nodes/9/inputs/0/0"},
      {R"(["inputs[0]",7,"ik_fk"])", R"(["inputs[0]",7,"ik"])", "707 /nodes/9/inputs/0/2"},
      {R"(["inputs[0]",7,"ik_fk"])", R"(["inputs[0]",7,"translate"])", "707 /nodes/9/inputs/0"},
      {R"(["inputs[0]",7,"ik_fk"])", R"(["inputs[0]",99,"ik_fk"])", "702 /nodes/9/inputs/0/1"},
      {R"(["inputs[0]",7,"ik_fk"])", R"(["inputs[0]",7,"ik_fk"],["inputs[0]",7,"roll"])",
       "705 /nodes/9/inputs/1/0"},
      {R"(["inputs[0]",7,"ik_fk"])", R"(["inputs[0]",8])", "701 /nodes/9/inputs/0"},
      {R"("children":[6])", R"("children":[7])", "706 /nodes/10/children/0"},
      {R"("children":[6])", R"("children":[6,6])", "706 /nodes/10/children/1"},
      {R"("children":[6])", R"("children":[])", "706 /nodes/10/children"},
      {R"(,"children":[6])", "", "706 /nodes/6/parent"},
      {R"("command":1,"parent":3)", R"("command":1,"parent":6)", "706 /nodes/6"},
      {R"("command":1,"parent":3)", R"("command":2,"parent":3)", "702 /nodes/10/command"},
      {R"("identity":"0:77f228ca67e63e45:77f228ca67e63e45:aim:late:0")",
       R"("identity":"0:77f228ca67e63e45:77f228ca67e63e45:aim:zero:0")", "705 /nodes/10/identity"},
      {R"("identity":"0:77f228ca67e63e45:77f228ca67e63e45:aim:late:0")",
       R"("identity":"1:77f228ca67e63e45:77f228ca67e63e45:aim:late:0")", "704 /nodes/10/identity"},
      {R"("identity":"0:77f228ca67e63e45:77f228ca67e63e45:aim:late:0")", R"("identity":"late")",
       "704 /nodes/10/identity"},
      {R"("key":"83629ab85e092fcd")", R"("key":"83629ab85e092fce")", "702 /nodes/1"},
      {R"("key":"83629ab85e092fcd")", R"("key":"77f228ca67e63e45")", "705 /joints/2/key"},
      {R"("translate":[0,1,0])", R"("translate":[0,1])", "708 /nodes/5/values/translate"},
      {R"("on":false,"feature":1)", R"("on":0,"feature":1)", "701 /joints/2/commands/0/on"},
      {R"("goes":{})", R"("goes":{"nodes":[1]})", "701 /owned/goes/nodes"},
      {R"("files":["parts/arm.yaml","lamp.yaml"])", R"("files":["lamp.yaml"])",
       "702 /joints/2/at/0"},
  };
  const std::string text = sample_text();
  for (const Case& c : cases) {
    INFO(std::string(c.from), " became ", std::string(c.to));
    CHECK(first_error(replaced(text, c.from, c.to)) == std::string(c.error));
  }
}

TEST_CASE("rig schema: names every kind of node") {
  Diagnostics diagnostics;
  const std::string path = std::string(RIGC_SOURCE_DIR) + "/docs/schema/RIGC_rig.schema.json";
  const auto text = read_file(path, json::kMostBytes, diagnostics);
  REQUIRE(text);
  const auto schema = json::parse(*text, path, 0, diagnostics);
  REQUIRE(schema);
  std::vector<std::string> named;
  for (const json::Value& kind :
       schema->root()["$defs"]["node"]["properties"]["kind"]["enum"].items()) {
    named.push_back(kind.string().value_or(""));
  }
  std::vector<std::string> kinds;
  for (int kind = 0; kind < static_cast<int>(scene::Kind::count); ++kind) {
    kinds.emplace_back(scene::spec(static_cast<scene::Kind>(kind)).name);
  }
  CHECK(named == kinds);
}
