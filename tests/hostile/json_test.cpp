// SPDX-License-Identifier: MIT
// JSON that is deep, doubled, malformed or of other types than glTF says.
#include <doctest/doctest.h>

#include "hostile/hostile_helpers.h"

using namespace rigc::test;

TEST_CASE("hostile json: nesting of 100,000") {
  const std::string arrays = repeated("[", 100'000) + repeated("]", 100'000);
  const std::string objects = repeated("{\"a\":", 100'000) + "1" + repeated("}", 100'000);
  const std::string open = repeated("[", 100'000), mixed = repeated("[{\"a\":", 50'000);
  // The value itself lies one deeper than the object that holds it.
  expect({{"arrays_in_extras", {"/extras", arrays.c_str()}, 65, "@511"},
          {"objects_in_extras", {"/extras", objects.c_str()}, 65, "@2555"},
          {"never_closed", {"/extras", open.c_str()}, 65, "@511"},
          {"arrays_in_node", {"/nodes/{joint}/extras", arrays.c_str()}, 65, "@509"},
          {"objects_in_extension", {"/nodes/{joint}/extensions", objects.c_str()}, 65, "@2545"},
          {"mixed_in_mesh", {"/meshes/0/extras", mixed.c_str()}, 65, "@1525"},
          {"arrays_as_children", {"/nodes/{joint}/children", arrays.c_str()}, 65, "@509"},
          {"arrays_in_rig", {"/extensions/RIGC_rig", arrays.c_str()}, 65, "@510"}},
         "nesting");
}

TEST_CASE("hostile json: keys twice, at every level") {
  const std::string many = "{" + [] {
    std::string members;
    for (int i = 0; i < 1000; ++i) members += "\"k" + std::to_string(i) + "\": 0, ";
    return members;
  }() + "\"k7\": 1}";
  const std::string many_at = "@" + std::to_string(many.size() - 8);
  expect({{"in_root", {"/extras", R"({}, "extras": {})"}, 64, "@4"},
          {"in_asset", {"/asset/copyright", R"("", "copyright": "")"}, 64, "@4"},
          {"in_node", {"/nodes/{joint}/children", R"([], "children": [])"}, 64, "@4"},
          {"in_skin", {"/skins/0/joints", R"([0], "joints": [0])"}, 64, "@5"},
          {"in_accessor", {"/accessors/{ibm}/count", R"(1, "count": 1)"}, 64, "@3"},
          {"in_view", {"/bufferViews/{ibm_view}/byteLength", R"(4, "byteLength": 4)"}, 64, "@3"},
          {"in_target",
           {"/animations/0/channels/{channel}/target/path", R"("rotation", "path": "scale")"},
           64,
           "@12"},
          {"in_extras", {"/nodes/{joint}/extras", R"({"a": {"b": 1, "b": 2}})"}, 64, "@15"},
          {"by_escape", {"/nodes/{joint}/extras", R"({"a": 1, "\u0061": 2})"}, 64, "@9"},
          {"empty_keys", {"/nodes/{joint}/extras", R"({"": 1, "": 2})"}, 64, "@8"},
          {"among_many", {"/extras", many.c_str()}, 64, many_at.c_str()},
          {"root_array_twice", {"/nodes", R"([], "nodes": [])"}, 64, "@4"}},
         "keys_twice");
}

TEST_CASE("hostile json: strings") {
  expect({{"invalid_utf8", {"/nodes/{joint}/name", "\"hi\xffps\""}, 62, "@3"},
          {"overlong_utf8", {"/nodes/{joint}/name", "\"\xc0\xaf\""}, 62, "@1"},
          {"surrogate_utf8", {"/nodes/{joint}/name", "\"\xed\xa0\x80\""}, 62, "@1"},
          {"too_high_utf8", {"/nodes/{joint}/name", "\"\xf4\x90\x80\x80\""}, 62, "@1"},
          {"cut_utf8", {"/nodes/{joint}/name", "\"\xe2\x82\""}, 62, "@1"},
          {"utf8_in_key", {"/nodes/{joint}/extras", "{\"\xff\": 1}"}, 62, "@2"},
          {"high_surrogate", {"/nodes/{joint}/name", R"("\ud800")"}, 63, "@1"},
          {"low_surrogate", {"/nodes/{joint}/name", R"("\udc00")"}, 63, "@1"},
          {"two_high_surrogates", {"/nodes/{joint}/name", R"("\ud800\ud800")"}, 63, "@1"},
          {"surrogate_in_key", {"/nodes/{joint}/extras", R"({"\ud800": 1})"}, 63, "@2"},
          {"control_character", {"/nodes/{joint}/name", "\"a\nb\""}, 63, "@2"},
          {"bad_escape", {"/nodes/{joint}/name", R"("\x41")"}, 63, "@1"},
          {"escape_cut", {"/nodes/{joint}/name", R"("\u00")"}, 63, "@1"}},
         "strings");
}

TEST_CASE("hostile json: root arrays of other types") {
  expect({{"nodes_object", {"/nodes", "{}"}, 655},
          {"nodes_number", {"/nodes", "5"}, 655},
          {"nodes_null", {"/nodes", "null"}, 655},
          {"node_array", {"/nodes/{joint}", "[]"}, 655},
          {"node_null", {"/nodes/{joint}", "null"}, 655},
          {"node_number", {"/nodes/{joint}", "3"}, 655},
          {"scenes_object", {"/scenes", "{}"}, 655},
          {"scene_text", {"/scenes/0", R"("main")"}, 655},
          {"meshes_text", {"/meshes", R"("mesh")"}, 655},
          {"mesh_null", {"/meshes/0", "null"}, 655},
          {"materials_object", {"/materials", "{}"}, 655},
          {"images_number", {"/images", "1"}, 655},
          {"image_view_beyond",
           {"/images", R"([{"bufferView": 9999, "mimeType": "image/png"}])"},
           657,
           "/images/0/bufferView"},
          {"textures_text", {"/textures", R"("t")"}, 655},
          {"samplers_true", {"/samplers", "true"}, 655},
          {"cameras_object", {"/cameras", "{}"}, 655},
          {"extensions_used_object", {"/extensionsUsed", "{}"}, 655},
          {"extensions_used_number", {"/extensionsUsed", "[3]"}, 655, "/extensionsUsed/0"},
          {"extensions_required_text",
           {"/extensionsRequired", R"("KHR_draco_mesh_compression")"},
           655},
          {"extensions_array", {"/extensions", "[]"}, 655},
          {"extensions_text", {"/extensions", R"("RIGC_rig")"}, 655}},
         "root");
}

TEST_CASE("hostile json: VRM humanoids that name no nodes") {
  expect({{"vrm1_beyond",
           {"/extensions/VRMC_vrm/humanoid/humanBones", R"({"hips": {"node": {nodes}}})"},
           657,
           "/extensions/VRMC_vrm/humanoid/humanBones/hips/node",
           Ask::build},
          {"vrm1_text",
           {"/extensions/VRMC_vrm/humanoid/humanBones", R"({"hips": {"node": "hips"}})"},
           655,
           "/extensions/VRMC_vrm/humanoid/humanBones/hips/node",
           Ask::build},
          {"vrm0_beyond",
           {"/extensions/VRM/humanoid/humanBones", R"([{"bone": "hips", "node": 1e9}])"},
           657,
           "/extensions/VRM/humanoid/humanBones/0/node",
           Ask::build},
          {"vrm0_fraction",
           {"/extensions/VRM/humanoid/humanBones", R"([{"bone": "hips", "node": 0.5}])"},
           655,
           "/extensions/VRM/humanoid/humanBones/0/node",
           Ask::build}},
         "humanoid");
}
