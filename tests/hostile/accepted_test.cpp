// SPDX-License-Identifier: MIT
// What rigc does not read it does not judge: files that others find fault with, and files that are
// only odd, are read; every file of the corpus is.
#include <doctest/doctest.h>

#include "cli/process_helpers.h"
#include "hostile/hostile_helpers.h"

using namespace rigc::test;
namespace fs = std::filesystem;

TEST_CASE("hostile accepted: what is odd where rigc does not look") {
  const std::string deep = repeated("[", 500) + repeated("]", 500);
  const std::string long_name = "\"" + repeated("x", 1'000'000) + "\"";
  expect({{"name_number", {"/nodes/{joint}/name", "5"}, 0},
          {"name_empty", {"/nodes/{joint}/name", "\"\""}, 0},
          {"name_control_characters", {"/nodes/{joint}/name", R"("\u0000\u001b[31m")"}, 0},
          {"name_long", {"/nodes/{joint}/name", long_name.c_str()}, 0},
          {"names_of_skins", {"/skins/0/name", "null"}, 0},
          {"name_of_clip", {"/animations/0/name", "{}"}, 0},
          {"extras_deep", {"/nodes/{joint}/extras", deep.c_str()}, 0},
          {"extras_number", {"/nodes/{joint}/extras", "1"}, 0},
          {"extras_null", {"/extras", "null"}, 0},
          {"big_integer", {"/extras", "123456789012345678901234567890"}, 0},
          {"weights_text", {"/nodes/{joint}/weights", "\"heavy\""}, 0},
          {"weights_too_many", {"/nodes/{joint}/weights", "[1, 2, 3]"}, 0},
          {"unknown_property", {"/nodes/{joint}/colour", "[]"}, 0},
          {"unknown_extension", {"/nodes/{joint}/extensions", R"({"VENDOR_x": [[[]]]})"}, 0},
          {"required_by_others", {"/extensionsRequired", R"(["VENDOR_material"])"}, 0},
          {"buffer_view_target", {"/bufferViews/{ibm_view}/target", "7"}, 0},
          {"min_wrong", {"/accessors/{times}/min", "[1e30]"}, 0},
          {"max_text", {"/accessors/{times}/max", "\"10\""}, 0},
          {"rotation_not_unit", {"/nodes/{joint}/rotation", "[0, 0, 0, 3]"}, 0},
          {"scale_zero", {"/nodes/{joint}/scale", "[0, 0, 0]"}, 0},
          {"scale_negative", {"/nodes/{joint}/scale", "[-1, 1, 1]"}, 0},
          {"index_as_real", {"/scene", "0.0"}, 0},
          {"image_outside", {"/images", R"([{"uri": "../../etc/passwd"}])"}, 0},
          {"image_http", {"/images", R"([{"uri": "http://localhost/a.png"}])"}, 0},
          {"texture_beyond", {"/textures", R"([{"source": 99, "sampler": -4}])"}, 0},
          {"material_odd", {"/materials", R"([{"alphaMode": 7, "pbrMetallicRoughness": []}])"}, 0},
          {"scene_twice", {"/scenes/0/nodes", "[0, 0]"}, 0},
          {"pointer_into_material",
           {"/animations/0/channels/{channel}/target", R"({"path": "pointer",
            "extensions": {"KHR_animation_pointer": {"pointer": "/materials/99/emissiveFactor"}}})"},
           0},
          {"channel_without_node", {"/animations/0/channels/{channel}/target/node", nullptr}, 0},
          {"vrm_bone_unset",
           {"/extensions/VRM/humanoid/humanBones", R"([{"bone": "hips", "node": -1}])"},
           0}},
         "accepted");
}

TEST_CASE("hostile accepted: every file of the corpus") {
  const fs::path corpus = corpus_folder();
  if (corpus.empty()) {
    MESSAGE("the corpus is not here");
    return;
  }
  std::size_t count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(corpus)) {
    const std::string extension = entry.path().extension();
    if (extension != ".glb" && extension != ".gltf" && extension != ".vrm" && extension != ".vrma")
      continue;
    INFO(entry.path().string());
    for (const char* command : {"inspect", "check"}) {
      const Outcome outcome = run_rigc({command, entry.path().string()});
      INFO(outcome.err);
      CHECK(outcome.err.find("error[") == std::string::npos);
      CHECK(outcome.status == 0);
    }
    ++count;
  }
  CHECK(count > 30);
}
