// SPDX-License-Identifier: MIT
// Edits of templates, by name, where the shot is the point: several rigs, values without keys,
// zeros that turn, what another program appended.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>

#include "pipeline/build.h"
#include "pipeline/character_helpers.h"
#include "pipeline/named_edits_helpers.h"

namespace rigc {
namespace {

using nlohmann::ordered_json;
using test::control;
using test::fk_arm;
using test::ik_fk_arm;
using test::kConverted;
using test::kRounding;
using test::Shot;
using test::Story;

ordered_json& node_of(test::Character& file, const gltf::Rig& rig, scene::NodeId id) {
  return file.json["nodes"][static_cast<std::size_t>(rig.nodes[id.index])];
}

/// A second rig of the template in the file.
void add_hero(const std::string& template_file, const std::string& path,
              const std::string& global) {
  Diagnostics diagnostics;
  pipeline::BuildRequest request;
  request.template_file = template_file;
  request.global = global;
  auto prepared = pipeline::prepare(request, diagnostics);
  REQUIRE_MESSAGE(prepared, render(diagnostics, false));
  prepared->rig_id = 1;
  std::size_t skipped = 0;
  auto rig = pipeline::run_commands(*prepared, prepared->catalogue, {}, skipped, diagnostics);
  REQUIRE(rig);
  const Shot shot = test::read_shot(path);
  gltf::Patch patch(*shot.file);
  std::uint64_t bytes = 0;
  REQUIRE(gltf::write_rig(patch, *rig, -1, diagnostics));
  REQUIRE(pipeline::write_output(patch, *shot.file, path, bytes, diagnostics));
}

std::string rig_text(const Shot& shot, std::size_t index) {
  return std::string(shot.file->root()["extensions"]["RIGC_rig"]["rigs"].items()[index].text());
}

}  // namespace

TEST_CASE("named edits: of two heroes in a shot only one is updated") {
  Story s("two_heroes");
  test::write_text(s.folder + "/main.yaml", fk_arm(1));
  test::build_rig(s.folder + "/main.yaml", s.shot, "", "ada");
  add_hero(s.folder + "/main.yaml", s.shot, "bob");
  test::animate(s.shot, 12);
  for (const std::size_t updated : {0u, 1u}) {
    const std::size_t other = 1 - updated;
    test::write_text(s.folder + "/main.yaml", ik_fk_arm(2 + static_cast<int>(updated)));
    pipeline::UpdateSettings settings;
    settings.rigs = {updated == 0 ? "ada" : "bob"};
    s.update(settings);
    CHECK(s.orphans() == 0);
    CHECK(s.after.rigs[updated].skeleton.templates.front().version ==
          2 + static_cast<int>(updated));
    CHECK(rig_text(s.before, other) == rig_text(s.after, other));
    CHECK(s.before.rigs[other].nodes == s.after.rigs[other].nodes);
    for (const int node : s.before.rigs[other].nodes) {
      if (node < 0) continue;
      const auto at = static_cast<std::size_t>(node);
      CHECK(s.before.file->root()["nodes"].items()[at].text() ==
            s.after.file->root()["nodes"].items()[at].text());
    }
    bool exact = false;
    CHECK(test::motion_difference(s.before, s.after, updated == 0 ? "bob" : "ada", &exact) == 0);
    CHECK(exact);
    CHECK(test::motion_difference(s.before, s.after, settings.rigs.front()) < kRounding);
  }
}

TEST_CASE("named edits: a switch and a pose that have no keys") {
  Story s("unkeyed");
  test::write_biped(s.folder, 1);
  s.build("biped.yaml", 13, {0, 0, 0, 1});
  test::Character character = test::load_character(s.shot);
  const gltf::Rig& rig = s.original.rigs.front();
  ordered_json& settings = node_of(character, rig, control(rig, "arm_l", "wrist", "settings"));
  settings["extras"]["ik_fk"] = 1.0;
  ordered_json& ik = node_of(character, rig, control(rig, "arm_l", "wrist", "ik"));
  ik["translation"] = {0.1, -0.2, 0.3};
  ordered_json& shoulder = node_of(character, rig, control(rig, "arm_r", "shoulder", "fk"));
  shoulder["rotation"] = {0, 0, 0.6, 0.8};
  test::save_glb(character, s.shot);
  const std::vector<ordered_json> set = {settings, ik, shoulder};

  const std::vector<std::string> before = test::keys_of(test::read_shot(s.shot));
  CHECK(before.size() == 3);
  for (int number = 2; number <= 4; ++number) {
    // A version with another control, and one without it again.
    const test::TextEdit more{"biped.yaml", "        with: {size: 1.1,",
                              "        with: {size: 1.2,"};
    test::write_biped(
        s.folder, number,
        number % 2 ? std::vector<test::TextEdit>{} : std::vector<test::TextEdit>{more});
    s.update();
    CHECK(test::differences(before, test::keys_of(s.after)) == "");
    bool exact = false;
    CHECK(test::motion_difference(s.before, s.after, "", &exact) == 0);
    CHECK(exact);
    test::Character now = test::load_character(s.shot);
    const gltf::Rig& next = s.after.rigs.front();
    CHECK(node_of(now, next, control(next, "arm_l", "wrist", "settings"))["extras"]["ik_fk"] ==
          1.0);
    CHECK(node_of(now, next, control(next, "arm_l", "wrist", "ik"))["translation"] ==
          set[1]["translation"]);
    CHECK(node_of(now, next, control(next, "arm_r", "shoulder", "fk"))["rotation"] ==
          set[2]["rotation"]);
  }
}

namespace {

/// A joint with axes of its own, whose control has those of the character or of the joint.
std::string turned(int number, const std::string& orient) {
  return fmt::format(R"(rigc: 1
name: turned
version: {}
joints:
  - name: base
    at: [0, 1, 0]
    rotate: [20, -35, 50]
    local: body
    label: base
    tags:
      - command: control
        with: {{orient: {}, translate: on}}
  - name: tip
    parent: base
    at: [0.3, 1.4, 0.2]
    rotate: [-70, 10, 15]
    local: body
    label: tip
    tags:
      - command: control
        with: {{orient: {}, translate: on}}
)",
                     number, orient, orient);
}

}  // namespace

TEST_CASE("named edits: the zero of a control turns, and its keys with it") {
  Story s("turned");
  s.build_text(turned(1, "character"), 14, {3, 1.0, 1.0, 6, 0});
  SUBCASE("the motion stays, and so do the keys after the way back") {
    s.update_text(turned(2, "joint"));
    CHECK(s.orphans() == 0);
    CHECK(s.rules() == "identity");
    CHECK(test::motion_difference(s.before, s.after, "") < kConverted);
    s.update_text(turned(3, "character"));
    CHECK(test::motion_difference(s.original, s.after, "") < kConverted);
  }
  SUBCASE("a scale about axes that are gone is said") {
    test::animate(s.shot, 16, {1, 1.0, 0, 4, 1});
    s.update_text(turned(2, "joint"));
    const auto report = nlohmann::json::parse(s.result.json)["rigs"][0];
    CHECK(report["inexact"].size() == 2);
    CHECK(report["inexact"][0] == "body.base/control.control@scale");
    CHECK(s.orphans() == 0);
  }
  SUBCASE("keep-local leaves the keys and lets the motion change") {
    test::write_text(s.folder + "/main.yaml", turned(2, "joint"));
    pipeline::UpdateSettings settings;
    settings.keep_local = true;
    s.update(settings);
    CHECK(s.orphans() == 0);
    CHECK(test::differences(test::keys_of(s.before), test::keys_of(s.after)) == "");
    CHECK(test::motion_difference(s.before, s.after, "") > 0.01);
  }
}

namespace {

/// What another program adds behind our elements: a prop in a control's hand with a mesh and a clip
/// of its own, and a light.
void append_others(const std::string& path, int control_node) {
  test::Character file = test::load_character(path);
  ordered_json& json = file.json;
  const auto view = [&](const std::vector<float>& numbers) {
    json["bufferViews"].push_back({{"buffer", 0},
                                   {"byteOffset", file.bin.size()},
                                   {"byteLength", numbers.size() * sizeof(float)}});
    file.bin.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(float));
    return json["bufferViews"].size() - 1;
  };
  const auto accessor = [&](const std::vector<float>& numbers, const char* type, int width) {
    const std::size_t count = numbers.size() / static_cast<std::size_t>(width);
    ordered_json made = {{"bufferView", view(numbers)}, {"componentType", 5126}};
    made["count"] = count;
    made["type"] = type;
    if (width == 1) {
      made["min"] = {numbers.front()};
      made["max"] = {numbers.back()};
    } else {
      made["min"] = {-1, -1, -1};
      made["max"] = {1, 1, 1};
    }
    json["accessors"].push_back(made);
    return json["accessors"].size() - 1;
  };
  const std::size_t corners = accessor({-1, -1, -1, 1, -1, 0, 0, 1, 1}, "VEC3", 3);
  const std::size_t times = accessor({0, 0.5f, 1.25f}, "SCALAR", 1);
  const std::size_t places = accessor({0, 0, 0, 1, 1, 1, -1, -1, -1}, "VEC3", 3);
  json["meshes"].push_back(
      {{"name", "sword"}, {"primitives", {{{"attributes", {{"POSITION", corners}}}}}}});
  json["nodes"].push_back({{"name", "sword"}, {"mesh", json["meshes"].size() - 1}});
  const std::size_t sword = json["nodes"].size() - 1;
  json["nodes"].push_back({{"name", "light"}, {"extras", {{"lumen", 800}}}});
  const std::size_t light = json["nodes"].size() - 1;
  json["nodes"][static_cast<std::size_t>(control_node)]["children"].push_back(sword);
  json["nodes"][static_cast<std::size_t>(control_node)]["extras"]["note"] = "held by Ada";
  json["scenes"][0]["nodes"].push_back(light);
  ordered_json clip = {{"name", "swing"}};
  clip["channels"] = {{{"sampler", 0}, {"target", {{"node", sword}, {"path", "translation"}}}}};
  clip["samplers"] = {{{"input", times}, {"output", places}}};
  json["animations"].push_back(clip);
  json["buffers"][0]["byteLength"] = file.bin.size();
  test::save_glb(file, path);
}

/// Bytes of an accessor's view.
std::string data_of(const test::Character& file, std::size_t accessor) {
  const ordered_json& view =
      file.json["bufferViews"][file.json["accessors"][accessor]["bufferView"].get<std::size_t>()];
  return file.bin.substr(view.value("byteOffset", std::size_t{0}), view["byteLength"]);
}

}  // namespace

TEST_CASE("named edits: what another program appended behind ours stays as it is") {
  Story s("appended");
  s.build_text(fk_arm(1), 15);
  const gltf::Rig& rig = s.original.rigs.front();
  const int hand = rig.nodes[control(rig, "arm", "wrist", "fk").index];
  append_others(s.shot, hand);
  const test::Character before = test::load_character(s.shot);
  const std::size_t sword = before.json["nodes"].size() - 2, light = sword + 1;
  const auto check = [&](const char* what) {
    INFO(what);
    const test::Character after = test::load_character(s.shot);
    REQUIRE(after.json["nodes"].size() > light);
    CHECK(after.json["nodes"][sword] == before.json["nodes"][sword]);
    CHECK(after.json["nodes"][light] == before.json["nodes"][light]);
    CHECK(after.json["animations"].back() == before.json["animations"].back());
    const std::size_t mesh = before.json["meshes"].size() - 1;
    CHECK(after.json["meshes"][mesh] == before.json["meshes"][mesh]);
    for (std::size_t i = before.json["accessors"].size() - 3; i < before.json["accessors"].size();
         ++i) {
      CHECK(after.json["accessors"][i] == before.json["accessors"][i]);
      CHECK(data_of(after, i) == data_of(before, i));
    }
    // It hangs under the same control, wherever that is now.
    const gltf::Rig& now = s.after.rigs.front();
    const int holder = now.nodes[control(now, "arm", "wrist", "fk").index];
    const ordered_json& node = after.json["nodes"][static_cast<std::size_t>(holder)];
    const ordered_json& children = node["children"];
    CHECK(std::find(children.begin(), children.end(), sword) != children.end());
    CHECK(node["extras"]["note"] == "held by Ada");
    const ordered_json& roots = after.json["scenes"][0]["nodes"];
    CHECK(std::find(roots.begin(), roots.end(), light) != roots.end());
  };
  s.update_text(ik_fk_arm(2));
  CHECK(s.orphans() == 0);
  CHECK(test::motion_difference(s.before, s.after, "") < kRounding);
  check("more nodes");
  s.update_text(fk_arm(3));
  check("fewer nodes");
  CHECK(test::differences(test::keys_of(s.original), [&] {
          auto keys = test::keys_of(s.after);
          std::erase_if(keys,
                        [](const std::string& line) { return line.rfind("? swing", 0) == 0; });
          return keys;
        }()) == "");
}

}  // namespace rigc
