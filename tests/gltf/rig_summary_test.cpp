// SPDX-License-Identifier: MIT
// Summaries of rigs say what the rigs say, and are read past everything else.
#include "gltf/rig_summary.h"

#include <doctest/doctest.h>

#include "file_helpers.h"
#include "gltf/rig.h"
#include "gltf/rig_codes.h"
#include "rig_helpers.h"

using namespace rigc;
using namespace rigc::gltf;
using namespace rigc::gltf::test;

namespace {

std::string json_of(Rig& rig, const std::string& name) {
  return std::string(written(empty_file(), rig, name).json.text());
}

std::optional<std::vector<RigSummary>> read(const std::string& json, Diagnostics& diagnostics,
                                            bool binary = true) {
  const std::string path = make_folder("broken/summary") + (binary ? "/rig.glb" : "/rig.gltf");
  write_bytes(path, binary ? glb(json, "") : json);
  return read_rig_summaries(path, diagnostics);
}

std::vector<RigSummary> good(const std::string& json, bool binary = true) {
  Diagnostics diagnostics;
  const auto rigs = read(json, diagnostics, binary);
  INFO(render(diagnostics, false));
  REQUIRE(rigs);
  CHECK(diagnostics.all().empty());
  return *rigs;
}

constexpr const char* kTwoRigs =
    R"({"nodes":[{"extensions":{"RIGC_rig":{"rigs":[1]}},"name":"}]\"{\\"}],"extensions":{"other":
{"rigs":[{"id":"a"}]},"RIGC_rig":{"before":{"bin":4},"rigs":[{"id":3,"name":"lamp","global":"desk",
"nodes":[{"name":"[\""},[[]]],"templates":[{"name":"lamp","version":7,"digest":"00000000000000ff",
"file":"lamp.yaml"},{"name":"arm","version":2,"file":"parts/arm"}],"settings":{"rest":"nodes"},
"modules":[{"name":"control","version":1}],"orphans":[{"node":4,"identity":"3:1:1:main:control:0",
"name":"wrist_ctl","local":"arm_l","label":"wrist","attributes":[{"name":"roll","flavour":"number"},
{"name":"bend","flavour":"number"}]}]},
{"id":1,"name":"x","global":"y","settings":{}}],"version":1}},"asset":{"version":"2.0"}} )";

}  // namespace

TEST_CASE("gltf rig_summary: says what the whole reader says") {
  Diagnostics diagnostics;
  Rig rig = sample_rig(diagnostics);
  const std::string json = json_of(rig, "summary");
  for (const bool binary : {true, false}) {
    const auto rigs = good(json, binary);
    REQUIRE(rigs.size() == 1);
    const RigSummary& summary = rigs[0];
    CHECK(summary.id == rig.id);
    CHECK(summary.name == rig.skeleton.name);
    CHECK(summary.global == rig.skeleton.global);
    CHECK(summary.modules == rig.modules);
    CHECK(summary.settings.rest == rig.settings.rest);
    CHECK(summary.settings.features.size() == rig.settings.features.size());
    CHECK(summary.orphans.empty());
    REQUIRE(summary.templates.size() == rig.skeleton.templates.size());
    for (std::size_t i = 0; i < summary.templates.size(); ++i) {
      CHECK(summary.templates[i].name == rig.skeleton.templates[i].name);
      CHECK(summary.templates[i].version == rig.skeleton.templates[i].version);
      CHECK(summary.templates[i].digest == rig.skeleton.templates[i].digest);
      CHECK(summary.templates[i].file == rig.skeleton.templates[i].file);
    }
  }
}

TEST_CASE("gltf rig_summary: several rigs, orphans, keys elsewhere that look the same") {
  const auto rigs = good(kTwoRigs);
  REQUIRE(rigs.size() == 2);
  CHECK(rigs[0].id == 1);
  CHECK(rigs[0].templates.empty());
  CHECK(rigs[1].global == "desk");
  CHECK(rigs[1].settings.rest == "nodes");
  REQUIRE(rigs[1].templates.size() == 2);
  CHECK(rigs[1].templates[1].file == "parts/arm");
  REQUIRE(rigs[1].orphans.size() == 1);
  CHECK(rigs[1].orphans[0].name == "wrist_ctl");
  CHECK(rigs[1].orphans[0].local == "arm_l");
  CHECK(rigs[1].orphans[0].label == "wrist");
  CHECK(rigs[1].orphans[0].attributes == std::vector<std::string>{"roll", "bend"});
  CHECK(good(R"({"asset":{"version":"2.0"}})").empty());
  CHECK(good("{}").empty());
}

TEST_CASE("gltf rig_summary: the rest of the text is left out, unread") {
  CHECK(without_details(R"({"a":[{"b":"}"}],"extensions":{"x":1,"RIGC_rig":{"version":1,"rigs":[{
"id":0,"nodes":[1,2],"global":"g"}]}},"c":nonsense})") ==
        R"({"extensions":{"RIGC_rig":{"version":1,"rigs":[{"id":0,"global":"g"}]}}})");
  CHECK(without_details("{ }") == "{}");
  // A key with escapes may be one of ours.
  CHECK_FALSE(without_details(R"({"\u0065xtensions":{}})"));
  CHECK(good(R"({"\u0065xtensions":{"RIGC_rig":{"version":1,"rigs":[{"id":5,"name":"a",
"global":"b","settings":{}}]}}})")[0]
            .id == 5);
  for (const char* text : {"", "[", "{", "{]", "{\"a", "{\"a\"}", "{\"a\":}", "{\"a\":1,}", "{}}",
                           "[]", "1", "{\"extensions\":{\"RIGC_rig\":{\"rigs\":[{},]}}}"}) {
    CAPTURE(text);
    CHECK_FALSE(without_details(text));
  }
}

TEST_CASE("gltf rig_summary: a text that ends anywhere is read as a whole or reported") {
  const std::string json = kTwoRigs;
  const std::size_t whole = json.find_last_not_of(' ') + 1;
  for (std::size_t size = 0; size < whole; ++size) {
    CAPTURE(size);
    CHECK_FALSE(without_details(json.substr(0, size)));
    if (size % 20 != 0) continue;
    Diagnostics diagnostics;
    CHECK_FALSE(read(json.substr(0, size), diagnostics, false));
    CHECK_FALSE(diagnostics.ok());
  }
}

TEST_CASE(
    "gltf rig_summary: of any text that is JSON, what is left out changes nothing that is left") {
  const auto parse = [](std::string text) {
    Diagnostics quiet;
    return json::parse(std::move(text), "", 0, quiet);
  };
  const auto told = [](const json::Document& document) {
    std::string out;
    const json::Value extension = document.root()["extensions"]["RIGC_rig"];
    out += extension["version"] ? extension["version"].text() : "-";
    for (const json::Value& rig : extension["rigs"].items())
      for (const char* key :
           {"id", "name", "global", "templates", "modules", "settings", "orphans"})
        out += rig[key] ? rig[key].text() : "-";
    return out;
  };
  constexpr std::string_view kBytes = "{}[]\",:\\ 0a";
  const std::string original = kTwoRigs;
  std::size_t compared = 0;
  for (std::size_t at = 0; at < original.size(); ++at) {
    for (const char byte : kBytes) {
      std::string text = original;
      text[at] = byte;
      const auto whole = parse(text);
      if (!whole) continue;
      CAPTURE(text);
      const auto rest = without_details(text);
      if (!rest) {
        CHECK(text.find('\\') != std::string::npos);
        continue;
      }
      const auto document = parse(*rest);
      REQUIRE(document);
      CHECK(told(*document) == told(*whole));
      ++compared;
    }
  }
  CHECK(compared > 1000);
}

TEST_CASE("gltf rig_summary: what is wrong is reported at its place in the file") {
  const auto wrong = [](std::string_view from, std::string_view to) {
    Diagnostics diagnostics;
    CHECK_FALSE(read(replaced(kTwoRigs, from, to), diagnostics));
    REQUIRE(diagnostics.all().size() == 1);
    const Diagnostic& only = diagnostics.all()[0];
    return std::to_string(only.code->number) + " " + only.place.pointer;
  };
  const std::string rigs = "/extensions/RIGC_rig/rigs";
  CHECK(wrong("\"version\":7", "\"version\":[]") == "701 " + rigs + "/0/templates/0/version");
  CHECK(wrong("00000000000000ff", "xyz") == "704 " + rigs + "/0/templates/0/digest");
  CHECK(wrong("\"id\":1", "\"id\":3") == "705 " + rigs + "/1/id");
  CHECK(wrong("\"id\":1", "\"id\":-3") == "702 " + rigs + "/1/id");
  CHECK(wrong("],\"version\":1}", "],\"version\":2}") == "700 /extensions/RIGC_rig/version");
  CHECK(wrong("{\"id\":1,\"name\":\"x\",\"global\":\"y\",\"settings\":{}}", "7") ==
        "701 " + rigs + "/1");
  CHECK(wrong("{\"name\":\"bend\",\"flavour\":\"number\"}", "0") ==
        "701 " + rigs + "/0/orphans/0/attributes/1");
  CHECK(wrong("\"id\":1,", "\"id\":1,\"id\":1,") == "64 ");
  Diagnostics diagnostics;
  CHECK_FALSE(read_rig_summaries("/nowhere.glb", diagnostics));
  CHECK_FALSE(diagnostics.ok());
}
