// SPDX-License-Identifier: MIT
// Files that ask for memory or time out of proportion to their size.
#include <doctest/doctest.h>

#include "hostile/hostile_helpers.h"

using namespace rigc::test;

namespace {

std::string with(const std::string& member) {
  return R"({"asset": {"version": "2.0"}, )" + member + "}";
}

std::string list(const std::string& element, std::size_t count) {
  return "[" + repeated(element + ",", count - 1) + element + "]";
}

}  // namespace

TEST_CASE("hostile counts: elements") {
  const auto folder = broken_folder("counts");
  struct Text {
    const char* name;
    std::string text;
    int code;
    std::string place;
    Ask ask = Ask::inspect;
  };
  const std::string accessor = R"({"componentType":5126,"count":1,"type":"SCALAR"})";
  const std::string zeros = with(R"("extras": )" + list("0", 3'000'000));
  // 1,048,576 and 3 in each 32 bytes; the root, asset, version and extras are values too.
  const std::size_t allowed = 1'048'576 + zeros.size() / 32 * 3 - 4;
  char values_place[32];
  std::snprintf(values_place, sizeof values_place, "@0x%zx", zeros.find('[') + 1 + 2 * allowed);
  const Text rows[] = {
      {"values", zeros, 61, values_place},
      {"nodes", with(R"("nodes": )" + list("{}", 1'000'000)), 693, "#/nodes"},
      {"accessors", with(R"("accessors": )" + list(accessor, 100'000)), 0, ""},
      {"views", with(R"("bufferViews": )" + list("{}", 1'000'000)), 693, "#/bufferViews"},
      {"scenes", with(R"("scenes": )" + list("{}", 900'000)), 693, "#/scenes"},
      {"wrong_nodes", with(R"("nodes": )" + list("0", 100'000)), 655, "#/nodes/0"},
      {"wrong_children", with(R"("nodes": [{"children": )" + list("1", 1'000'000) + "}]"), 657,
       "#/nodes/0/children/0"},
      {"keys",
       with(R"("extras": {)" +
            [] {
              std::string members;
              for (int i = 0; i < 300'000; ++i) members += "\"" + std::to_string(i) + "\":0,";
              return members + "\"7\":0}";
            }()),
       64, "@0x30a8c3"},
      {"joints", with(R"("nodes": [{}], "skins": [{"joints": )" + list("0", 1'000'000) + "}]"), 675,
       "#/skins/0"},
      {"zeros",
       with(
           R"("accessors": [{"componentType": 5126, "count": 4000000000, "type": "SCALAR"}], "nodes": [{}],
          "animations": [{"samplers": [{"input": 0, "output": 0}], "channels": [{"sampler": 0, "target": {"node": 0, "path": "weights"}}]}])"),
       0, ""},
      {"zero_times",
       with(R"("accessors": [{"componentType": 5126, "count": 4000000000, "type": "SCALAR"},
          {"componentType": 5126, "count": 4000000000, "type": "VEC3"}], "nodes": [{}],
          "animations": [{"samplers": [{"input": 0, "output": 1}], "channels": [{"sampler": 0, "target": {"node": 0, "path": "scale"}}]}])"),
       672, "#/accessors/0"},
      {"shared_zeros",
       with(
           R"("accessors": [{"componentType": 5126, "count": 1, "type": "SCALAR"},
          {"componentType": 5126, "count": 5000000, "type": "SCALAR"}], "nodes": [{}],
          "animations": [{"samplers": [{"input": 1, "output": 1}], "channels": )" +
           list(
               R"({"sampler": 0, "target": {"path": "pointer", "extensions": {"KHR_animation_pointer": {"pointer": "/nodes/0/extras/a"}}}})",
               100) +
           "}]"),
       679, "#/accessors/1"},
  };
  for (const Text& row : rows) {
    const auto file = folder / (std::string(row.name) + ".gltf");
    write_file(file, row.text);
    expect(row.ask, file, {row.code, row.place, 1, row.code == 0});
  }
}

TEST_CASE("hostile counts: what a build has to go through") {
  const auto folder = broken_folder("build_counts");
  Victim victim = small_victim();
  auto& nodes = victim.json["nodes"];
  for (std::size_t i = 0; i < 20'000; ++i) nodes[1]["children"].push_back(nodes.size() + i);
  for (std::size_t i = 0; i < 20'000; ++i) nodes.push_back({{"name", "bone"}});
  expect({"bones", {"/asset/copyright", "\"\""}, 709, "/nodes/0", Ask::build}, victim, folder);
}

TEST_CASE("hostile counts: hierarchies as deep as they are long are read") {
  const auto folder = broken_folder("deep_hierarchy");
  std::string nodes = "{}";
  for (int i = 1; i < 50'000; ++i) nodes += ",{\"children\":[" + std::to_string(i - 1) + "]}";
  const std::string text =
      with("\"nodes\": [" + nodes + "], \"skins\": [{\"joints\": [0, 49999]}]");
  write_file(folder / "chain.gltf", text);
  expect(Ask::inspect, folder / "chain.gltf", {0, "", 0, true});
  write_file(folder / "ring.gltf",
             with("\"nodes\": [" + ("{\"children\":[49999]}" + nodes.substr(2)) + "]"));
  expect(Ask::inspect, folder / "ring.gltf", {661, "#/nodes/0"});
}
