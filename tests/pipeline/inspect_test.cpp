// SPDX-License-Identifier: MIT
// What inspect tells of a rig: what can be keyed on each control, limits, layers, sets.
#include "pipeline/inspect.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "pipeline/character_helpers.h"
#include "pipeline/door_helpers.h"
#include "pipeline/motion_helpers.h"

namespace rigc {
namespace {

using Json = nlohmann::ordered_json;

Json inspected(const std::string& path) {
  Diagnostics diagnostics;
  const auto text = pipeline::inspect(path, true, diagnostics);
  REQUIRE_MESSAGE(text, render(diagnostics, false));
  return Json::parse(*text)["rigs"][0];
}

Json control(const Json& rig, const std::string& label) {
  for (const Json& found : rig["controls"])
    if (found["label"] == label) return found;
  FAIL("no control " << label);
  return {};
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("pipeline inspect: attributes are what is keyable, whole or by component") {
  const Json rig = inspected(test::door("inspect_door"));
  const Json hinge = control(rig, "hinge"), handle = control(rig, "handle");
  CHECK(hinge["attributes"] ==
        Json::parse(R"({"rotate.y": 0, "scale": [1, 1, 1], "doors_visible": 0})"));
  CHECK(handle["attributes"] == Json::parse(R"({"translate.z": 0, "sound": 0})"));
  CHECK(hinge["locked"] == Json::parse(R"(["translate.x", "translate.y", "translate.z", "rotate.x",
                                           "rotate.z"])"));
  CHECK(handle["locked"] == Json::parse(R"(["translate.x", "translate.y", "stiff"])"));
  CHECK(hinge["hidden"] == Json::array());
  CHECK(handle["hidden"] == Json::parse(R"(["sound"])"));
  CHECK(hinge["limits"] == Json::parse(R"([{"attribute": "rotate.y", "min": 0},
                                           {"attribute": "rotate.y", "max": 90}])"));
}

TEST_CASE("pipeline inspect: layers and sets, with the nodes in them") {
  const std::string path = test::door("inspect_groups");
  const Json rig = inspected(path);
  const int hinge = control(rig, "hinge")["node"];
  REQUIRE(rig["layers"].size() == 1);
  const Json& layer = rig["layers"][0];
  CHECK(layer["name"] == "doors");
  CHECK(layer["visible"] == false);
  CHECK(layer["mode"] == "reference");
  CHECK(layer["color"].size() == 3);
  CHECK(layer["switch"] == Json{{"node", hinge}, {"attribute", "doors_visible"}});
  CHECK(layer["nodes"] == Json::array({hinge}));
  REQUIRE(rig["sets"].size() == 2);
  CHECK(rig["sets"][0] == Json{{"name", "door"}, {"parent", "house"}, {"nodes", {hinge}}});
  CHECK(rig["sets"][1] == Json{{"name", "house"}, {"parent", ""}, {"nodes", Json::array()}});

  Diagnostics diagnostics;
  const auto text = pipeline::inspect(path, false, diagnostics);
  REQUIRE(text);
  CHECK(has(*text, "  layer     doors (reference) hidden, 1 nodes\n"));
  CHECK(has(*text, "  set       door in house, 1 controls\n"));
  CHECK(has(*text, "  set       house, 0 controls\n"));
}

TEST_CASE("pipeline inspect: a layer is shown as its switch stands in the file") {
  const std::string path = test::door("inspect_switch");
  test::Character changed = test::load_glb(path);
  const int hinge = test::control_of(test::door_rig(path), "hinge");
  auto& extras = changed.json["nodes"][static_cast<std::size_t>(hinge)]["extras"];
  CHECK(extras["doors_visible"] == 0);
  extras["doors_visible"] = 1;
  test::save_glb(changed, path);
  CHECK(inspected(path)["layers"][0]["visible"] == true);
}

TEST_CASE("pipeline inspect: features are as they were set, in the whole rig and in parts of it") {
  const auto rigged = test::rig_model("", "", "inspect_features", "biped.yaml", "bind",
                                      {"stretch=on", "arm_l/ikfk=off", "ikfk:legs=off"});
  const Json rig = inspected(rigged.path);
  for (const Json& feature : rig["features"]) {
    CAPTURE(feature["name"]);
    if (feature["name"] == "stretch") CHECK(feature["on"] == true);
    if (feature["name"] == "ribbons") CHECK(feature["on"] == false);
    if (feature["name"] != "ikfk") continue;
    CHECK(feature["on"] == true);
    CHECK(feature["set"] == Json::parse(R"([{"group": "arm_l", "switch": "", "on": false},
                                            {"group": "", "switch": "legs", "on": false}])"));
  }
  Diagnostics diagnostics;
  const auto text = pipeline::inspect(rigged.path, false, diagnostics);
  REQUIRE(text);
  CHECK(has(*text, "  feature   stretch (limb) on\n"));
  CHECK(has(*text, "  feature   ikfk (limb) on, off in arm_l, off for legs\n"));
}

}  // namespace rigc
