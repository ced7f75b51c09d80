// SPDX-License-Identifier: MIT
// A RIGC_rig that lies about itself: about its version, its joints, its scene, its connections,
// what its solvers compute, and the nodes that it says it has.
#include <doctest/doctest.h>

#include "hostile/hostile_helpers.h"

using namespace rigc::test;

namespace {

void expect_rig(const std::vector<Row>& rows, const std::string& name) {
  const auto folder = broken_folder(name);
  for (const Row& row : rows) expect(row, rig_victim(), folder);
}

}  // namespace

TEST_CASE("hostile rig: what it is and who made it") {
  const std::string many_rigs = "[" + repeated("{},", 1024) + "{}]";
  expect_rig(
      {{"version_99", {"/extensions/RIGC_rig/version", "99"}, 700},
       {"version_0", {"/extensions/RIGC_rig/version", "0"}, 700},
       {"version_text", {"/extensions/RIGC_rig/version", R"("1")"}, 700},
       {"version_missing", {"/extensions/RIGC_rig/version", nullptr}, 700, "/extensions/RIGC_rig"},
       {"extension_array", {"/extensions/RIGC_rig", "[]"}, 700},
       {"rigs_missing", {"/extensions/RIGC_rig/rigs", nullptr}, 701, "/extensions/RIGC_rig"},
       {"rigs_object", {"/extensions/RIGC_rig/rigs", "{}"}, 701},
       {"rigs_too_many", {"/extensions/RIGC_rig/rigs", many_rigs.c_str()}, 709},
       {"rig_number", {"/{rig}", "0"}, 701},
       {"rig_empty", {"/{rig}", "{}"}, 701},
       {"id_negative", {"/{rig}/id", "-1"}, 702},
       {"id_huge", {"/{rig}/id", "1e30"}, 701},
       {"id_text", {"/{rig}/id", R"("0")"}, 701},
       {"id_other", {"/{rig}/id", "5"}, 704, "/{rig}/nodes/0/identity"},
       {"name_missing", {"/{rig}/name", nullptr}, 701, "/{rig}"},
       {"global_number", {"/{rig}/global", "1"}, 701},
       {"digest_bad", {"/{rig}/templates/0/digest", R"("not a digest")"}, 704},
       {"template_version_negative", {"/{rig}/templates/0/version", "-7"}, 702},
       {"templates_object", {"/{rig}/templates", "{}"}, 701},
       {"character_missing", {"/{rig}/character", nullptr}, 701, "/{rig}"},
       {"character_no_up", {"/{rig}/character/up", "[0, 1]"}, 708},
       {"character_unit_zero", {"/{rig}/character/unit", "0"}, 708, "/{rig}/character"},
       {"character_unit_overflow", {"/{rig}/character/unit", "1e999"}, 66, "@0"},
       {"settings_missing", {"/{rig}/settings", nullptr}, 701, "/{rig}"},
       {"settings_feature",
        {"/{rig}/settings/features", R"([{"name": "ikfk"}])"},
        701,
        "/{rig}/settings/features/0"},
       {"modules_text", {"/{rig}/modules", R"("control")"}, 701},
       {"files_numbers", {"/{rig}/files", "[1]"}, 701, "/{rig}/files/0"},
       {"place_beyond_files", {"/{rig}/joints/0/at", "[77, 1, 1]"}, 702, "/{rig}/joints/0/at/0"},
       {"place_short", {"/{rig}/joints/0/at", "[0]"}, 701},
       {"ancestor_negative", {"/{rig}/ancestor", "-1"}, 702},
       {"owned_missing", {"/{rig}/owned", nullptr}, 701, "/{rig}"},
       {"owned_text", {"/{rig}/owned/goes/nodes", "\"all\""}, 701},
       {"owned_odd", {"/{rig}/owned/goes/nodes", "[5, 9, 3]"}, 701},
       {"owned_negative", {"/{rig}/owned/goes/nodes", "[-5, 9]"}, 702, "/{rig}/owned/goes/nodes/0"},
       {"owned_overflows",
        {"/{rig}/owned/goes/nodes", "[2000000000, 2000000000]"},
        702,
        "/{rig}/owned/goes/nodes/1"},
       {"commands_missing", {"/{rig}/commands", nullptr}, 701, "/{rig}"},
       {"command_holder", {"/{rig}/commands/0/holder", R"("hips")"}, 704},
       {"shape_points",
        {"/{rig}/shapes", R"([{"name": "s", "lines": [[0, 1]]}])"},
        708,
        "/{rig}/shapes/0/lines/0"}},
      "rig");
}

TEST_CASE("hostile rig: joints") {
  expect_rig(
      {{"joints_missing", {"/{rig}/joints", nullptr}, 701, "/{rig}"},
       {"joint_array", {"/{rig}/joints/1", "[]"}, 701},
       {"joint_no_name", {"/{rig}/joints/1/name", nullptr}, 701, "/{rig}/joints/1"},
       {"joint_key_bad", {"/{rig}/joints/1/key", R"("g000000000000000")"}, 704},
       {"joint_key_long", {"/{rig}/joints/1/key", R"("0000000000000000+99999999999")"}, 704},
       {"joint_keys_twice",
        {"/{rig}/joints/1",
         R"({"name": "x", "key": "0000000000000001"}, {"name": "y", "key": "0000000000000001"})"},
        705,
        "/{rig}/joints/2/key"},
       {"joint_own_parent", {"/{rig}/joints/1/parent", "1"}, 702},
       {"joint_later_parent", {"/{rig}/joints/1/parent", "5"}, 702},
       {"joint_parent_negative", {"/{rig}/joints/1/parent", "-2"}, 702},
       {"joint_template_beyond", {"/{rig}/joints/1/template", "3"}, 702},
       {"joint_rest_short", {"/{rig}/joints/1/translation", "[1]"}, 708},
       {"joint_rest_text",
        {"/{rig}/joints/1/translation", R"([0, "1", 2])"},
        701,
        "/{rig}/joints/1/translation/1"},
       {"joint_rotation_zero", {"/{rig}/joints/1/rotation", "[0, 0, 0, 0]"}, 708},
       {"joint_was", {"/{rig}/joints/1/was", R"(["x"])"}, 704, "/{rig}/joints/1/was/0"},
       {"joint_tag_feature_beyond", {"/{rig}/joints/0/commands/0/feature", "4"}, 702},
       {"joint_tags_twice",
        {"/{rig}/joints/0/commands", R"([{"module": "a", "id": "x"}, {"module": "a", "id": "x"}])"},
        705,
        "/{rig}/joints/0/commands/1"},
       {"foreign_node_negative", {"/{rig}/joints/0/foreign_node", "-1"}, 702},
       {"joint_of_other_rig",
        {"/{rig}/nodes/1/identity", R"("0:00000000000000aa")"},
        702,
        "/{rig}/nodes/1"}},
      "joints");
}

TEST_CASE("hostile rig: nodes of the scene") {
  const std::string many_weights = "[" + repeated("0,", 4096) + "0]";
  const std::string deep = [] {
    std::string nodes = "[";
    for (int i = 0; i < 1100; ++i) {
      const std::string number = std::to_string(i);
      nodes +=
          (i ? ", " : "") +
          std::string(
              R"({"kind": "transform", "name": "", "command": 0, "identity": "0:0000000000000001:0000000000000001:c:r:)") +
          number + "\"";
      nodes += i ? R"(, "parent": )" + std::to_string(i - 1) + "}" : std::string("}");
    }
    return nodes + "]";
  }();
  expect_rig(
      {{"kind_unknown", {"/{rig}/nodes/{control}/kind", R"("teapot")"}, 703},
       {"kind_missing", {"/{rig}/nodes/{control}/kind", nullptr}, 701, "/{rig}/nodes/{control}"},
       {"kind_other",
        {"/{rig}/nodes/{expression}/kind", R"("remap")"},
        703,
        "/{rig}/nodes/{expression}/values/code"},
       {"identity_bad", {"/{rig}/nodes/{control}/identity", R"("0:1:2")"}, 704},
       {"identity_twice",
        {"/{rig}/nodes/1",
         "{\"kind\": \"joint\", \"name\": \"\", \"identity\": \"0:00000000000000aa\"}"},
        702,
        "/{rig}/nodes/1"},
       {"command_beyond", {"/{rig}/nodes/{control}/command", "99"}, 702},
       {"command_missing",
        {"/{rig}/nodes/{control}/command", nullptr},
        702,
        "/{rig}/nodes/{control}"},
       {"parent_itself", {"/{rig}/nodes/{control}/parent", "{control}"}, 706},
       {"parent_beyond", {"/{rig}/nodes/{control}/parent", "{scene_nodes}"}, 702},
       {"parent_cycle", {"/{rig}/nodes/0/parent", "1"}, 706},
       {"too_deep", {"/{rig}/nodes", deep.c_str()}, 706, "/{rig}/nodes/1024"},
       {"children_lie",
        {"/{rig}/nodes/0/children", "[{control}]"},
        706,
        "/{rig}/nodes/0/children/0"},
       {"children_twice", {"/{rig}/nodes/0/children", "[1, 1]"}, 706, "/{rig}/nodes/0/children/1"},
       {"children_missing", {"/{rig}/nodes/0/children", "[]"}, 706},
       {"values_array", {"/{rig}/nodes/{control}/values", "[]"}, 701},
       {"value_unknown", {"/{rig}/nodes/{control}/values/speed", "1"}, 703},
       {"value_of_output",
        {"/{rig}/nodes/{control}/values/world", "[1,0,0,0,1,0,0,0,1,0,0,0]"},
        703},
       {"value_of_other_type", {"/{rig}/nodes/{control}/values/shape", "1"}, 701},
       {"value_short", {"/{rig}/nodes/{control}/values/translate", "[1, 2]"}, 708},
       {"value_rotation_zero", {"/{rig}/nodes/{control}/values/rotation", "[0, 0, 0, 0]"}, 708},
       {"value_1e300",
        {"/{rig}/nodes/{control}/values/translate", "[1e300, 0, 0]"},
        708,
        "/{rig}/nodes/{control}/values/translate/0"},
       {"value_list", {"/{rig}/nodes/{point_constraint}/values/offsets", "{}"}, 708},
       {"values_too_many",
        {"/{rig}/nodes/{point_constraint}/values/weights", many_weights.c_str()},
        709},
       {"keyable_huge", {"/{rig}/nodes/{control}/values/keyable", "1e30"}, 708},
       {"keyable_fraction", {"/{rig}/nodes/{control}/values/keyable", "0.5"}, 708},
       {"keyable_negative", {"/{rig}/nodes/{control}/values/keyable", "-1"}, 708},
       {"locked_huge", {"/{rig}/nodes/{control}/values/locked_components", "512"}, 708},
       {"hidden_fraction", {"/{rig}/nodes/{control}/values/hidden_components", "0.5"}, 708},
       {"mirror_short", {"/{rig}/nodes/{control}/values/mirror", "[1, -1]"}, 708},
       {"mesh_parts_short", {"/{rig}/nodes/{mesh}/values/parts", "[0, 1, 2]"}, 708},
       {"mesh_no_joints",
        {"/{rig}/nodes/{mesh}/values/joints", "[]"},
        708,
        "/{rig}/nodes/{mesh}/values/parts"},
       {"points_lie", {"/{rig}/nodes/{control}/values/points", "[3, 0, 0, 0]"}, 708},
       {"points_huge", {"/{rig}/nodes/{control}/values/points", "[1e30, 0, 0, 0]"}, 708},
       {"opposite_bad", {"/{rig}/nodes/{control}/values/opposite", R"("left")"}, 704},
       {"user_rigc", {"/{rig}/nodes/{control}/user/0/name", R"("rigc")"}, 704},
       {"user_name_bad", {"/{rig}/nodes/{control}/user/0/name", R"("a b")"}, 704},
       {"user_name_of_attribute", {"/{rig}/nodes/{control}/user/0/name", R"("translate")"}, 705},
       {"user_flavour", {"/{rig}/nodes/{control}/user/0/flavour", R"("complex")"}, 703},
       {"user_value_text", {"/{rig}/nodes/{control}/user/0/value", R"("1")"}, 701},
       {"user_object", {"/{rig}/nodes/{control}/user", "{}"}, 701}},
      "scene");
}

TEST_CASE("hostile rig: parts without number") {
  const std::string weights = R"("values": {"weights": [)" + repeated("0,", 999) + "0]}";
  std::string nodes = "[";
  for (int i = 0; i < 300; ++i)
    nodes += std::string(i ? "," : "") +
             R"({"kind": "point_constraint", "name": "", "command": 0, "identity": )" +
             R"("0:0000000000000001:0000000000000001:c:r:)" + std::to_string(i) + "\", " + weights +
             "}";
  nodes += "]";
  const std::string many_nodes = "[" + repeated("{},", 32768) + "{}]";
  const std::string numbers = "{\"a\": [" + repeated("0,", 600'000) + "0]}";
  const std::string tags = "[" + repeated("{},", 65536) + "{}]";
  expect_rig({{"weights", {"/{rig}/nodes", nodes.c_str()}, 709, "/{rig}/nodes/261/values/weights"},
              {"nodes", {"/{rig}/nodes", many_nodes.c_str()}, 709},
              {"arguments",
               {"/{rig}/joints/0/commands/0/with", numbers.c_str()},
               709,
               "/{rig}/joints/0/commands/0/with/a"},
              {"tags", {"/{rig}/joints/0/commands", tags.c_str()}, 709}},
             "parts");
}

TEST_CASE("hostile rig: connections") {
  const char* kInputs = "/{rig}/nodes/1/inputs";
  expect_rig(
      {{"input_unknown",
        {kInputs, R"([["speed", 0, "translate"]])"},
        707,
        "/{rig}/nodes/1/inputs/0/0"},
       {"input_is_output",
        {kInputs, R"([["world", 0, "world"]])"},
        707,
        "/{rig}/nodes/1/inputs/0/0"},
       {"input_element_beyond",
        {"/{rig}/nodes/{point_constraint}/inputs", R"([["targets[9]", 0, "world"]])"},
        707,
        "/{rig}/nodes/{point_constraint}/inputs/0/0"},
       {"input_element_huge",
        {"/{rig}/nodes/{point_constraint}/inputs", R"([["targets[99999999999]", 0, "world"]])"},
        707,
        "/{rig}/nodes/{point_constraint}/inputs/0/0"},
       {"input_component",
        {kInputs, R"([["translate.q", 0, "visible"]])"},
        707,
        "/{rig}/nodes/1/inputs/0/0"},
       {"from_unknown",
        {kInputs, R"([["translate", 0, "speed"]])"},
        707,
        "/{rig}/nodes/1/inputs/0/2"},
       {"from_beyond",
        {kInputs, R"([["translate", {scene_nodes}, "translate"]])"},
        702,
        "/{rig}/nodes/1/inputs/0/1"},
       {"from_negative",
        {kInputs, R"([["translate", -1, "translate"]])"},
        702,
        "/{rig}/nodes/1/inputs/0/1"},
       {"types_differ",
        {kInputs, R"([["translate", 0, "world"]])"},
        707,
        "/{rig}/nodes/1/inputs/0"},
       {"text_connected",
        {"/{rig}/nodes/{control}/inputs", R"([["shape", 0, "translate"]])"},
        707,
        "/{rig}/nodes/{control}/inputs/0/0"},
       {"connected_twice",
        {kInputs, R"([["translate", 0, "translate"], ["translate", 0, "scale"]])"},
        705,
        "/{rig}/nodes/1/inputs/1/0"},
       {"not_three", {kInputs, R"([["translate", 0]])"}, 701, "/{rig}/nodes/1/inputs/0"},
       {"object", {kInputs, "{}"}, 701}},
      "connections");
}

TEST_CASE("hostile rig: what cannot be evaluated") {
  const std::string nested = '"' + repeated("(", 100'000) + "1" + repeated(")", 100'000) + '"';
  const std::string minus = '"' + repeated("-", 100'000) + "1\"";
  const std::string sum = "\"1" + repeated("+1", 100'000) + '"';
  const char* kCode = "/{rig}/nodes/{expression}/values/code";
  for (const Ask ask : {Ask::check, Ask::bake}) {
    const std::string folder = ask == Ask::check ? "evaluation" : "evaluation_in_bake";
    const char* limb = "/{rig}/nodes/{ik_two_bone}";
    const char* expression = "/{rig}/nodes/{expression}";
    expect_rig(
        {{"code_nested", {kCode, nested.c_str()}, 404, expression, ask},
         {"code_minus", {kCode, minus.c_str()}, 404, expression, ask},
         {"code_long", {kCode, sum.c_str()}, 404, expression, ask},
         {"code_empty", {kCode, "\"\""}, 400, expression, ask},
         {"code_input", {kCode, "\"$999\""}, 403, expression, ask},
         {"code_name", {kCode, "\"system(1)\""}, 401, expression, ask},
         {"code_arguments", {kCode, "\"sin(1, 2)\""}, 402, expression, ask},
         {"own_input",
          {"/{rig}/nodes/1/inputs", R"([["translate", 1, "translate"]])"},
          560,
          "/{rig}/nodes/1",
          ask},
         {"cycle",
          {"/{rig}/nodes/{control}/inputs", R"([["translate", {point_constraint}, "translate"]])"},
          560,
          "/{rig}/nodes/{control}",
          ask},
         {"remap_points",
          {"/{rig}/nodes/{remap}/values/points", "[0, 0]"},
          561,
          "/{rig}/nodes/{remap}",
          ask},
         {"remap_falling",
          {"/{rig}/nodes/{remap}/values/points", "[1, 0, 1, 0, 1, 1]"},
          561,
          "/{rig}/nodes/{remap}",
          ask},
         {"remap_interpolation",
          {"/{rig}/nodes/{remap}/values/points", "[0, 0, 1e30, 1, 1, 1]"},
          561,
          "/{rig}/nodes/{remap}",
          ask},
         {"aim_mode",
          {"/{rig}/nodes/{aim_constraint}/values/up_mode", "1e30"},
          561,
          "/{rig}/nodes/{aim_constraint}",
          ask},
         {"no_offsets",
          {"/{rig}/nodes/{point_constraint}/values/offsets", "[]"},
          561,
          "/{rig}/nodes/{point_constraint}",
          ask},
         {"limb_offsets",
          {"/{rig}/nodes/{ik_two_bone}/values/offsets", "[[0, 0, 0, 1]]"},
          561,
          limb,
          ask},
         {"chain_rests",
          {"/{rig}/nodes/{ik_chain}/values/rests", "[[0, 0, 0, 1]]"},
          561,
          "/{rig}/nodes/{ik_chain}",
          ask},
         {"chain_iterations",
          {"/{rig}/nodes/{ik_chain}/values/iterations", "1e9"},
          561,
          "/{rig}/nodes/{ik_chain}",
          ask},
         {"chain_iterations_negative",
          {"/{rig}/nodes/{ik_chain}/values/iterations", "-1"},
          561,
          "/{rig}/nodes/{ik_chain}",
          ask}},
        folder);
  }
}

TEST_CASE("hostile rig: nodes of the file") {
  const auto& nodes = rig_victim().json["nodes"];
  const std::string first = nodes[0]["extras"]["rigc"].dump();
  // Where nodes say what they are, that counts more than the index; here they do not.
  Victim unmarked = rig_victim();
  for (auto& node : unmarked.json["nodes"]) node.erase("extras");
  const auto folder = broken_folder("nodes");
  const std::vector<Row> rows = {
      {"node_beyond", {"/{rig}/nodes/0/node", "99999"}, 702, "/{rig}/nodes/0"},
      {"node_negative", {"/{rig}/nodes/0/node", "-1"}, 702},
      {"node_twice", {"/{rig}/nodes/1/node", "0"}, 705, "/nodes/0"},
      {"node_of_constraint",
       {"/{rig}/nodes/{point_constraint}/node", "0"},
       702,
       "/{rig}/nodes/{point_constraint}"},
      {"foreign_node_beyond", {"/{rig}/joints/0/foreign_node", "99999"}, 0}};
  for (const Row& row : rows) expect(row, unmarked, folder);
  expect_rig({{"index_beyond_is_outvoted", {"/{rig}/nodes/0/node", "99999"}, 0},
              {"identity_copied", {"/nodes/1/extras/rigc", first.c_str()}, 715, "/nodes/1"},
              {"identity_of_nobody", {"/nodes/1/extras/rigc", "\"7:00000000000000aa\""}, 0},
              {"identity_no_text", {"/nodes/1/extras/rigc", "7"}, 0},
              {"extras_array", {"/nodes/1/extras", "[]"}, 0},
              {"attribute_text", {"/nodes/{control_node}/extras/speed", "\"fast\""}, 0}},
             "nodes_that_say_what_they_are");
}
