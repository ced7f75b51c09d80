// SPDX-License-Identifier: MIT
// JSON Schemas. What they accept and reject is tested by tools/node/check_templates.mjs.
#include "pipeline/schema.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "pipeline/character_helpers.h"
#include "pipeline/codes.h"
#include "pipeline/reference.h"

namespace rigc {
namespace {

using Json = nlohmann::json;

Json schema_of(const std::string& name, const pipeline::Paths& paths = {}) {
  Diagnostics diagnostics;
  const auto text = pipeline::schema(name, paths, diagnostics);
  REQUIRE_MESSAGE(text, render(diagnostics, false));
  return Json::parse(*text);
}

/// Calls `visit` with each object under a key `properties`, with the key's path.
template <class Visit>
void each_property(const Json& schema, const std::string& path, Visit visit) {
  if (!schema.is_structured()) return;
  for (const auto& [key, value] : schema.items()) {
    const std::string at = path + "/" + key;
    if (key == "properties")
      for (const auto& [name, property] : value.items()) visit(at + "/" + name, property);
    each_property(value, at, visit);
  }
}

constexpr const char* kModule = R"(module: bounce
version: 3
title: Bounce
category: tests
summary: Bounces.
implementation: control
parameters:
  - {name: height, type: length, unit: metre, required: true, min: -1, max: 2, help: How high.}
  - {name: speed, type: float, default: 1, min: 0.5, help: How fast.}
  - {name: turns, type: float, default: 1, min: 0, max: 9, help: How often.}
  - {name: slope, type: float, default: 1, min: 0, max: 9, help: How steep.}
  - {name: floor, type: node, required: true, help: On what.}
changes:
  - {version: 2, parameter: height, was: size}
  - {version: 2, parameter: turns, max_was: 20}
  - {version: 2, parameter: slope, factor: 0.1}
  - {version: 3, parameter: floor, default_was: ..}
)";

pipeline::Paths user_modules() {
  const std::string folder = test::test_out("schema_modules");
  std::filesystem::create_directories(folder);
  std::ofstream(folder + "/bounce.yaml", std::ios::binary) << kModule;
  pipeline::Paths paths;
  paths.modules = {folder};
  return paths;
}

}  // namespace

TEST_CASE("pipeline schema: everything that a template can say is explained") {
  for (const char* name : {"template", "map", "module"}) {
    const Json schema = schema_of(name);
    CHECK(schema["$schema"] == "http://json-schema.org/draft-07/schema#");
    std::size_t count = 0;
    each_property(schema, "", [&](const std::string& path, const Json& property) {
      // Conditions and their consequences say nothing that is not said elsewhere.
      if (path.find("/if/") != std::string::npos || path.find("/then/") != std::string::npos)
        return;
      if (path.find("/anyOf/") != std::string::npos) return;
      INFO(name << path);
      CHECK(property.value("markdownDescription", "") != "");
      ++count;
    });
    CHECK(count >= 9);
  }
}

TEST_CASE("pipeline schema: references lead somewhere") {
  const Json schema = schema_of("template");
  std::size_t count = 0;
  const auto visit = [&](const auto& self, const Json& node) -> void {
    if (!node.is_structured()) return;
    if (node.is_object() && node.contains("$ref")) {
      const std::string target = node["$ref"];
      INFO(target);
      CHECK(schema.contains(Json::json_pointer(target.substr(1))));
      ++count;
    }
    for (const auto& [key, value] : node.items()) self(self, value);
  };
  visit(visit, schema);
  CHECK(count > 30);
}

TEST_CASE("pipeline schema: modules of a user's folder") {
  const Json schema = schema_of("template", user_modules());
  const Json& names = schema["definitions"]["command"]["properties"]["command"]["enum"];
  CHECK(std::count(names.begin(), names.end(), "bounce") == 1);
  CHECK(schema["properties"]["modules"]["properties"]["bounce"]["maximum"] == 3);
  const Json& with = schema["definitions"]["with_bounce"];
  // A template in centimetres may say -100 to 200.
  CHECK(with["properties"]["height"]["minimum"] == -100);
  CHECK(with["properties"]["height"]["maximum"] == 200);
  CHECK(with["properties"]["speed"]["minimum"] == 0.5);
  CHECK(with["properties"]["speed"]["default"] == 1);
  // Templates that are pinned to earlier versions write values of those.
  CHECK(with["properties"]["turns"]["minimum"] == 0);
  CHECK_FALSE(with["properties"]["turns"].contains("maximum"));
  CHECK_FALSE(with["properties"]["slope"].contains("minimum"));
  // The earlier name serves templates that are pinned to the earlier version.
  CHECK(with["properties"]["size"].contains("deprecationMessage"));
  CHECK(with["required"].empty());
  CHECK(schema_of("bounce", user_modules()) == with);
}

TEST_CASE("pipeline schema: the reference of a module tells its changes") {
  Diagnostics diagnostics;
  const auto text = pipeline::modules("bounce", user_modules(), false, diagnostics);
  REQUIRE(text);
  CHECK(text->find("  version 2: height was called size\n  version 2: turns went up to 20\n") !=
        std::string::npos);
  const auto json = pipeline::modules("bounce", user_modules(), true, diagnostics);
  REQUIRE(json);
  CHECK(Json::parse(*json)["changes"] ==
        Json::parse(R"([{"version": 2, "parameter": "height", "was": "size"},
                        {"version": 2, "parameter": "turns", "max_was": 20},
                        {"version": 2, "parameter": "slope", "factor": 0.1},
                        {"version": 3, "parameter": "floor", "default_was": ".."}])"));
}

TEST_CASE("pipeline schema: a name that is none") {
  Diagnostics diagnostics;
  CHECK_FALSE(pipeline::schema("templat", {}, diagnostics));
  REQUIRE(diagnostics.all().size() == 1);
  CHECK(diagnostics.all()[0].code->number == pipeline::codes::kNoSuchModule.number);
  CHECK(diagnostics.all()[0].hint == "did you mean \"template\"?");
}

}  // namespace rigc
