// SPDX-License-Identifier: MIT
// rigc transfer as its users run it: what it writes, says, and refuses.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/clip_helpers.h"
#include "cli/process_helpers.h"

namespace fs = std::filesystem;

namespace rigc::test {
namespace {

constexpr const char* kLamp = R"(rigc: 1
name: lamp
version: 1
joints:
  - name: base
    at: [0, 1, 0]
    local: lamp
    label: base
    tags:
      - command: control
  - name: shade
    parent: base
    at: [0, 2, 0]
    local: lamp
    label: shade
)";

void write(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

std::size_t node_named(const nlohmann::json& document, const std::string& name) {
  const auto& nodes = document["nodes"];
  const auto at = std::find_if(nodes.begin(), nodes.end(),
                               [&](const auto& node) { return node.value("name", "") == name; });
  REQUIRE(at != nodes.end());
  return static_cast<std::size_t>(at - nodes.begin());
}

/// A folder with `lamp.gltf`, a rig whose clip "rise" moves one of its joints.
fs::path lamp_rising(const std::string& name, const std::string& joint) {
  const fs::path folder = fresh_folder(name);
  write(folder / "lamp.yaml", kLamp);
  REQUIRE(run_rigc({"build", "lamp.yaml", "-o", "lamp.gltf"}, {folder, {}}).status == 0);
  const std::string built = file_text(folder / "lamp.gltf");
  write(folder / "lamp.gltf", animated(built, node_named(nlohmann::json::parse(built), joint)));
  return folder;
}

std::vector<std::size_t> animated_nodes(const fs::path& file) {
  const auto document = nlohmann::json::parse(file_text(file));
  std::vector<std::size_t> nodes;
  for (const auto& channel : document["animations"][0]["channels"])
    nodes.push_back(channel["target"]["node"]);
  return nodes;
}

}  // namespace

TEST_CASE("cli transfer: a clip on a joint becomes one on its control, and the text says so") {
  const fs::path folder = lamp_rising("transfer_lamp", "base");
  const Outcome run = run_rigc({"transfer", "lamp.gltf", "-o", "shot.gltf"}, {folder, {}});
  REQUIRE_MESSAGE(run.status == 0, run.err);
  CHECK(run.err.empty());
  for (const char* part :
       {"shot.gltf: 1 clip, ", "\"rise\": 2 frames, 1 controls, 1 channels, ",
        "off at keys by up to ", "between keys by up to ", " mm (", "\"base\" at"})
    CHECK_MESSAGE(run.out.find(part) != std::string::npos, run.out);
  const auto document = nlohmann::json::parse(file_text(folder / "shot.gltf"));
  CHECK(animated_nodes(folder / "shot.gltf") ==
        std::vector<std::size_t>{node_named(document, "base_control")});
  REQUIRE(run_rigc({"bake", "shot.gltf", "-o", "back.gltf"}, {folder, {}}).status == 0);
  const auto back = nlohmann::json::parse(file_text(folder / "back.gltf"));
  CHECK(animated_nodes(folder / "back.gltf") == std::vector<std::size_t>{node_named(back, "base")});
}

TEST_CASE("cli transfer: --json says the same, with names in full") {
  const fs::path folder = lamp_rising("transfer_json", "base");
  const Outcome run =
      run_rigc({"transfer", "lamp.gltf", "-o", "shot.gltf", "--json"}, {folder, {}});
  REQUIRE_MESSAGE(run.status == 0, run.err);
  const auto report = nlohmann::json::parse(run.out);
  CHECK(report["file"] == "shot.gltf");
  CHECK(report["bytes"] == fs::file_size(folder / "shot.gltf"));
  CHECK(report["limbs"].empty());
  const auto& clip = report["clips"][0];
  CHECK(clip["name"] == "rise");
  CHECK(clip["passed_through"] == false);
  CHECK(clip["frames"] == 2);
  CHECK(clip["frames_added"] == 0);
  CHECK(clip["kept_joints"].empty());
  CHECK(clip["untouched_joints"].empty());
  for (const char* where : {"at_keys", "between_keys"}) {
    CHECK(clip[where]["mm"] < 1e-3);
    CHECK(clip[where]["percent_of_height"] < 1e-4);
  }
}

TEST_CASE("cli transfer: a clip on joints that no control moves passes through") {
  const fs::path folder = lamp_rising("transfer_shade", "shade");
  const Outcome run = run_rigc({"transfer", "lamp.gltf", "-o", "shot.gltf"}, {folder, {}});
  REQUIRE_MESSAGE(run.status == 0, run.err);
  CHECK(run.out.find("\"rise\": as it was") != std::string::npos);
  CHECK(animated_nodes(folder / "shot.gltf") == animated_nodes(folder / "lamp.gltf"));
}

TEST_CASE("cli transfer: wrong usage and mistakes write nothing") {
  const fs::path folder = lamp_rising("transfer_refused", "base");
  write(folder / "shot.gltf", "precious");
  const Surroundings here{folder, {}};
  const auto count_files = [&] {
    return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
  };
  const auto before = count_files();
  CHECK(run_rigc({"transfer", "lamp.gltf"}, here).status == 2);
  CHECK(run_rigc({"transfer", "-o", "shot.gltf"}, here).status == 2);
  CHECK(run_rigc({"transfer", "missing.gltf", "-o", "shot.gltf"}, here).status == 3);
  struct Mistake {
    std::vector<std::string> options;
    std::string code;
  };
  for (const Mistake& mistake : {Mistake{{"--clip", "rize"}, "RIG0755"},
                                 {{"--fps", "0"}, "RIG0757"},
                                 {{"--start", "1", "--end", "0.5"}, "RIG0757"},
                                 {{"--start", "-1"}, "RIG0600"},
                                 {{"--tolerance", "-1"}, "RIG0757"},
                                 {{"--tolerance", "nan"}, "RIG0757"},
                                 {{"--limb", "arm_l=ik"}, "RIG0784"},
                                 {{"--limb", "arm_l"}, "RIG0784"}}) {
    std::vector<std::string> arguments{"transfer", "lamp.gltf", "-o", "shot.gltf"};
    arguments.insert(arguments.end(), mistake.options.begin(), mistake.options.end());
    const Outcome run = run_rigc(arguments, here);
    INFO(mistake.options[1] << ": " << run.err);
    CHECK(run.status == 1);
    CHECK(run.err.find(mistake.code) != std::string::npos);
    CHECK(run.out.empty());
  }
  CHECK(file_text(folder / "shot.gltf") == "precious");
  CHECK(count_files() == before);
  fs::remove(folder / "shot.gltf");  // no glTF: the validator need not see it
}

}  // namespace rigc::test
