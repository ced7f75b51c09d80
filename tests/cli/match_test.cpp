// SPDX-License-Identifier: MIT
// rigc match as its users run it: what it writes, says, and refuses.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/clip_helpers.h"
#include "cli/process_helpers.h"

namespace fs = std::filesystem;

namespace rigc::test {
namespace {

/// An arm whose shoulder hangs on a control; `more` are commands of the upper arm.
std::string arm(const std::string& ik_fk, const std::string& more) {
  return R"(rigc: 1
name: crane
version: 1
joints:
  - name: base
    at: [0, 1, 0]
    local: base
    label: base
    tags:
      - command: control
  - name: upper
    parent: base
    at: [0, 1.2, 0]
    local: arm
    label: upper
    tags:
      - {command: ik_fk_limb, with: {start: ., middle: arm.lower, end: arm.end, ik_fk: )" +
         ik_fk + "}}\n" + more +
         R"(  - {name: lower, parent: upper, at: [0.3, 1.3, -0.05], local: arm, label: lower}
  - {name: end, parent: lower, at: [0.5, 1.2, 0], local: arm, label: end}
)";
}

const std::string kStretch =
    "      - {command: limb_stretch, with: {limb: arm/ik_fk_limb.settings}}\n";

std::size_t node_named(const nlohmann::json& document, const std::string& name) {
  const auto& nodes = document["nodes"];
  const auto at = std::find_if(nodes.begin(), nodes.end(),
                               [&](const auto& node) { return node.value("name", "") == name; });
  REQUIRE(at != nodes.end());
  return static_cast<std::size_t>(at - nodes.begin());
}

/// A folder with `crane.gltf`, whose clip "rise" moves a control.
fs::path crane(const std::string& name, const std::string& text, const std::string& control) {
  const fs::path folder = fresh_folder(name);
  std::ofstream(folder / "crane.yaml", std::ios::binary) << text;
  const Outcome built = run_rigc({"build", "crane.yaml", "-o", "crane.gltf"}, {folder, {}});
  REQUIRE_MESSAGE(built.status == 0, built.err);
  const std::string file = file_text(folder / "crane.gltf");
  std::ofstream(folder / "crane.gltf", std::ios::binary)
      << animated(file, node_named(nlohmann::json::parse(file), control));
  return folder;
}

/// Names of the nodes that a clip moves, with how.
std::set<std::string> targets(const fs::path& file) {
  const auto document = nlohmann::json::parse(file_text(file));
  std::set<std::string> names;
  for (const auto& channel : document["animations"][0]["channels"]) {
    const auto& target = channel["target"];
    const std::string path = target["path"];
    if (path == "pointer") {
      const std::string pointer = target["extensions"]["KHR_animation_pointer"]["pointer"];
      const std::size_t node = std::stoul(pointer.substr(std::string("/nodes/").size()));
      names.insert(document["nodes"][node]["name"].get<std::string>() + "@" +
                   pointer.substr(pointer.rfind('/') + 1));
    } else {
      const std::size_t node = target["node"];
      names.insert(document["nodes"][node]["name"].get<std::string>() + "@" + path);
    }
  }
  return names;
}

}  // namespace

TEST_CASE("cli match: IK controls get the pose and the switch, and the text says so") {
  const fs::path folder = crane("match_arm", arm("0", kStretch), "base_control");
  const Surroundings here{folder, {}};
  const Outcome run =
      run_rigc({"match", "crane.gltf", "--limb", "arm", "--to", "ik", "-o", "shot.gltf"}, here);
  REQUIRE_MESSAGE(run.status == 0, run.err);
  CHECK(run.err.empty());
  for (const char* part : {"shot.gltf: 1 clip, ", "\"rise\"", "arm to ik: ", " keys\n",
                           "off at keys by up to ", "between keys by up to "})
    CHECK_MESSAGE(run.out.find(part) != std::string::npos, run.out);
  const std::set<std::string> moved = targets(folder / "shot.gltf");
  for (const char* target : {"base_control@translation", "end_ik@translation", "end_ik@rotation",
                             "lower_pole@translation", "end_settings@ik_fk"})
    CHECK_MESSAGE(moved.contains(target), target);

  const Outcome back = run_rigc({"match", "shot.gltf", "--to", "fk", "--range", "0.25:0.75",
                                 "--fps", "10", "--clip", "rise", "-o", "back.gltf", "--json"},
                                here);
  REQUIRE_MESSAGE(back.status == 0, back.err);
  const auto report = nlohmann::json::parse(back.out);
  CHECK(report["to"] == "fk");
  const auto& limb = report["clips"][0]["limbs"][0];
  CHECK(limb["limb"] == "arm");
  CHECK(limb["frames"] == 6);
  CHECK(limb["frames_added"] == 0);
  CHECK(limb["at_keys"]["mm"].get<double>() < 0.01);
  CHECK(limb["at_keys"]["degrees"].get<double>() < 1e-3);
  CHECK(limb["at_keys"]["joint"].get<std::string>().size() > 0);
  CHECK(limb["between_keys"]["mm"].get<double>() < 1);
}

TEST_CASE("cli match: a clip of joints goes onto a limb that stretches as onto any other") {
  const fs::path folder = crane("match_transfer", arm("0", kStretch), "base");
  const Outcome run = run_rigc(
      {"transfer", "crane.gltf", "--limb", "arm=ik", "-o", "shot.gltf", "--json"}, {folder, {}});
  REQUIRE_MESSAGE(run.status == 0, run.err);
  const auto clip = nlohmann::json::parse(run.out)["clips"][0];
  CHECK(clip["at_keys"]["mm"].get<double>() < 0.01);
  CHECK(clip["at_keys"]["degrees"].get<double>() < 1e-3);
  CHECK(targets(folder / "shot.gltf").contains("end_ik@translation"));
}

TEST_CASE("cli match: a control follows another space from a time on") {
  const std::string spaces =
      "      - {command: space_switch, with: {control: arm.end/ik_fk_limb.ik, own: base, "
      "spaces: [base.base], names: [hook]}}\n";
  const fs::path folder = crane("match_space", arm("1", spaces), "end_ik");
  const Surroundings here{folder, {}};
  const std::vector<std::string> command{"match", "crane.gltf", "--control", "end_ik", "--space",
                                         "hook",  "--range",    "0.5:",      "-o",     "shot.gltf"};
  const Outcome run = run_rigc(command, here);
  REQUIRE_MESSAGE(run.status == 0, run.err);
  CHECK_MESSAGE(run.out.find("end_ik to hook: 2 frames, ") != std::string::npos, run.out);
  CHECK(targets(folder / "shot.gltf").contains("end_ik@space"));
  CHECK(targets(folder / "shot.gltf").contains("end_ik@rotation"));
  std::vector<std::string> more = command;
  more.push_back("--json");
  const auto report = nlohmann::json::parse(run_rigc(more, here).out);
  CHECK(report["to"] == "hook");
  CHECK(report["clips"][0]["limbs"][0]["at_keys"]["mm"].get<double>() < 1e-3);
}

TEST_CASE("cli match: a lock in the way is told") {
  const fs::path folder = crane(
      "match_locked",
      arm("1", "      - {command: lock, with: {attributes: arm.lower/ik_fk_limb.fk@rotate}}\n"),
      "end_ik");
  const Outcome run =
      run_rigc({"match", "crane.gltf", "--to", "fk", "-o", "shot.gltf"}, {folder, {}});
  CHECK(run.status == 0);
  CHECK_MESSAGE(run.err.find("RIG0842") != std::string::npos, run.err);
}

TEST_CASE("cli match: clips that key no control stay as they were") {
  const fs::path folder = crane("match_joints", arm("0", ""), "base_control");
  const Surroundings here{folder, {}};
  const std::string keyed = file_text(folder / "crane.gltf");
  const auto base = node_named(nlohmann::json::parse(keyed), "base");
  auto document = nlohmann::json::parse(animated(keyed, base));
  document["animations"][1]["name"] = "walk";
  std::ofstream(folder / "crane.gltf", std::ios::binary) << document.dump();

  const Outcome all = run_rigc({"match", "crane.gltf", "--to", "ik", "-o", "shot.gltf"}, here);
  REQUIRE_MESSAGE(all.status == 0, all.err);
  CHECK_MESSAGE(all.out.find("\"walk\": as it was") != std::string::npos, all.out);
  CHECK_MESSAGE(all.out.find("rigc transfer") != std::string::npos, all.out);
  const auto after = nlohmann::json::parse(file_text(folder / "shot.gltf"));
  CHECK(after["animations"][1]["channels"] == document["animations"][1]["channels"]);
  CHECK(after["animations"][0]["channels"].size() > 1);

  const Outcome named =
      run_rigc({"match", "crane.gltf", "--to", "ik", "--clip", "walk", "-o", "walk.gltf"}, here);
  CHECK(named.status == 1);
  CHECK_MESSAGE(named.err.find("RIG0844") != std::string::npos, named.err);
  document["animations"].erase(0);
  std::ofstream(folder / "crane.gltf", std::ios::binary) << document.dump();
  const Outcome none = run_rigc({"match", "crane.gltf", "--to", "ik", "-o", "walk.gltf"}, here);
  CHECK(none.status == 1);
  CHECK_MESSAGE(none.err.find("RIG0844") != std::string::npos, none.err);
  CHECK(!fs::exists(folder / "walk.gltf"));
}

TEST_CASE("cli match: a range that reaches beyond the clip does not make it longer") {
  const fs::path folder = crane("match_beyond", arm("0", ""), "base_control");
  const Surroundings here{folder, {}};
  for (const std::string fps : {"source", "10"}) {
    const Outcome run = run_rigc(
        {"match", "crane.gltf", "--to", "ik", "--range", "0.5:9", "--fps", fps, "-o", "shot.gltf"},
        here);
    CHECK(run.status == 0);
    CHECK_MESSAGE(run.err.find("RIG0845") != std::string::npos, run.err);
    const auto clips =
        nlohmann::json::parse(run_rigc({"inspect", "shot.gltf", "--json"}, here).out)["clips"];
    CHECK(clips[0]["duration"] == 1);
  }
}

TEST_CASE("cli match: refuses what makes no sense, and writes nothing") {
  const fs::path folder = crane("match_refused", arm("0", ""), "base_control");
  const Surroundings here{folder, {}};
  CHECK(run_rigc({"match", "crane.gltf", "--to", "ik"}, here).status == 2);
  CHECK(run_rigc({"match", "missing.gltf", "--to", "ik", "-o", "shot.gltf"}, here).status == 3);
  struct Mistake {
    std::vector<std::string> options;
    std::string code;
  };
  for (const Mistake& mistake :
       {Mistake{{"--to", "up"}, "RIG0841"},
        {{}, "RIG0841"},
        {{"--space", "hook"}, "RIG0841"},
        {{"--control", "end_ik"}, "RIG0841"},
        {{"--control", "end_ik", "--space", "hook", "--to", "ik"}, "RIG0841"},
        {{"--control", "end_ik", "--space", "hook"}, "RIG0843"},
        {{"--to", "ik", "--range", "1"}, "RIG0841"},
        {{"--to", "ik", "--range", "2:1"}, "RIG0841"},
        {{"--to", "ik", "--range", "-1:1"}, "RIG0841"},
        {{"--to", "ik", "--limb", "leg"}, "RIG0840"},
        {{"--to", "ik", "--clip", "rize"}, "RIG0755"},
        {{"--to", "ik", "--fps", "0"}, "RIG0757"},
        {{"--to", "ik", "--tolerance", "-1"}, "RIG0757"},
        {{"--to", "ik", "--range", "5:9"}, "RIG0841"}}) {
    std::vector<std::string> arguments{"match", "crane.gltf", "-o", "shot.gltf"};
    arguments.insert(arguments.end(), mistake.options.begin(), mistake.options.end());
    const Outcome run = run_rigc(arguments, here);
    INFO(run.err);
    CHECK(run.status == 1);
    CHECK(run.err.find(mistake.code) != std::string::npos);
    CHECK(run.out.empty());
  }
  CHECK(!fs::exists(folder / "shot.gltf"));
}

}  // namespace rigc::test
