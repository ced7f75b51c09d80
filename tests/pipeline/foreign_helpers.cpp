// SPDX-License-Identifier: MIT
// Additions of other programs.
#include "pipeline/foreign_helpers.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "pipeline/character_helpers.h"
#include "pipeline/shot_helpers.h"

namespace rigc::test {
namespace {

using nlohmann::ordered_json;

std::string bytes_of_view(const test::Character& character, int view) {
  const auto& json = character.json["bufferViews"][static_cast<std::size_t>(view)];
  return character.bin.substr(json.value("byteOffset", std::size_t{0}), json["byteLength"]);
}

}  // namespace

Foreign add_foreign(const std::string& path, Random& random) {
  const Shot shot = test::read_shot(path);
  test::Character character = test::load_character(path);
  ordered_json& json = character.json;
  Foreign out;
  const auto push = [&](const char* list, const std::string& text) {
    json[list].push_back(ordered_json::parse(text));
    const std::size_t index = json[list].size() - 1;
    out.texts["/" + std::string(list) + "/" + std::to_string(index)];
    return static_cast<int>(index);
  };
  const auto add_data = [&](const std::vector<float>& values, const char* type, std::size_t width) {
    character.bin.resize((character.bin.size() + 3) / 4 * 4, '\0');
    const std::size_t at = character.bin.size();
    character.bin.append(reinterpret_cast<const char*>(values.data()), values.size() * 4);
    const int view = push("bufferViews", fmt::format(R"({{"byteLength": {}, "byteOffset": {}, )"
                                                     R"("buffer": 0, "name": "theirs"}})",
                                                     values.size() * 4, at));
    out.bytes[view];
    return push("accessors",
                fmt::format(R"({{"count": {}, "componentType": 5126, "type": "{}", )"
                            R"("bufferView": {}, "min": [0, 0, 0], "max": [1, 1, 1]}})",
                            values.size() / width, type, view));
  };
  const int points = add_data({0, 0, 0, 1, 0, 0, 0, 1, 1}, "VEC3", 3);
  const int mesh =
      push("meshes", fmt::format(R"({{"extras": {{"big": 12345678901234567890}}, )"
                                 R"("primitives": [{{"attributes": {{"POSITION": {}}}}}]}})",
                                 points));
  const int lamp =
      push("nodes", fmt::format(R"({{"mesh": {}, "name": "lamp", "translation": )"
                                R"([1.0, 2e0, 0.50], "extras": {{"x": [{{}}, null]}}}})",
                                mesh));
  for (auto& scene : json["scenes"]) scene["nodes"].push_back(lamp);
  // Clips: one of theirs, and a channel in one of ours.
  character.bin.resize((character.bin.size() + 3) / 4 * 4, '\0');
  const int times = add_data({0, 1}, "SCALAR", 1);
  json["accessors"][static_cast<std::size_t>(times)]["min"] = {0};
  json["accessors"][static_cast<std::size_t>(times)]["max"] = {1};
  const int moves = add_data({0, 0, 0, 1, 1, 1}, "VEC3", 3);
  const std::string sampler = fmt::format(R"({{"output": {}, "input": {}}})", moves, times);
  const auto channel = [&](std::size_t index, const char* property) {
    return fmt::format(R"({{"target": {{"path": "{}", "node": {}}}, "sampler": {}}})", property,
                       lamp, index);
  };
  push("animations",
       fmt::format(R"({{"extras": {{"take": 3}}, "samplers": [{}], "channels": [{}]}})", sampler,
                   channel(0, "translation")));
  ordered_json& ours = json["animations"][0];
  ours["samplers"].push_back(ordered_json::parse(sampler));
  ours["channels"].push_back(ordered_json::parse(channel(ours["samplers"].size() - 1, "scale")));
  out.texts[fmt::format("/animations/0/samplers/{}", ours["samplers"].size() - 1)];
  out.texts[fmt::format("/animations/0/channels/{}", ours["channels"].size() - 1)];
  // On nodes of ours.
  const gltf::Rig& rig = shot.rigs.front();
  for (const scene::NodeId id : rig.scene.nodes()) {
    const int index = rig.nodes[id.index];
    const scene::Kind kind = rig.scene[id].kind;
    if (index < 0 || (kind != scene::Kind::control && kind != scene::Kind::joint)) continue;
    ordered_json& node = json["nodes"][static_cast<std::size_t>(index)];
    const std::string pointer = fmt::format("/nodes/{}", index);
    if (random.chance(0.4)) {
      node["extras"]["note"] = {{"by", "studio"}, {"n", 1.50}};
      out.texts[pointer + "/extras/note"];
    }
    if (random.chance(0.3)) {
      node["extensions"]["ACME_tag"] = {{"keep", {1, 2, index}}};
      out.texts[pointer + "/extensions/ACME_tag"];
    }
    if (random.chance(0.2)) {
      const int child = push("nodes", R"({"name": "hat", "translation": [0, 0.10, 0]})");
      json["nodes"][static_cast<std::size_t>(index)]["children"].push_back(child);
      out.children.emplace_back(index, child);
    }
  }
  json["extensionsUsed"].push_back("ACME_tag");
  json["extensions"]["ACME_scene"] = {{"list", {1, nullptr, "x"}}};
  json["extensionsUsed"].push_back("ACME_scene");
  out.texts["/extensions/ACME_scene"];
  json["extras"] = {{"studio", "x"}};
  out.texts["/extras"];
  json["buffers"][0]["byteLength"] = character.bin.size();
  test::save_glb(character, path);
  character = test::load_character(path);
  for (auto& [pointer, text] : out.texts)
    text = character.json.at(ordered_json::json_pointer(pointer)).dump();
  for (auto& [view, bytes] : out.bytes) bytes = bytes_of_view(character, view);
  return out;
}

std::string changes(const Foreign& foreign, const std::string& path) {
  const test::Character character = test::load_character(path);
  std::string out;
  for (const auto& [pointer, text] : foreign.texts) {
    const ordered_json::json_pointer at(pointer);
    const std::string now =
        character.json.contains(at) ? character.json.at(at).dump() : std::string("gone");
    if (now != text) out += pointer + ": " + text + " is " + now + "\n";
  }
  for (const auto& [view, bytes] : foreign.bytes)
    if (bytes_of_view(character, view) != bytes) out += fmt::format("view {}\n", view);
  const std::vector<int> parents = test::parents_of(character.json);
  for (const auto& [parent, child] : foreign.children)
    if (parents[static_cast<std::size_t>(child)] != parent)
      out += fmt::format("child {} of {} is below {}\n", child, parent,
                         parents[static_cast<std::size_t>(child)]);
  for (const char* extension : {"ACME_tag", "ACME_scene"})
    if (!foreign.texts.empty() &&
        character.json["extensionsUsed"].dump().find(extension) == std::string::npos)
      out += extension;
  return out;
}

}  // namespace rigc::test
