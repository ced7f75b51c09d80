// SPDX-License-Identifier: MIT
// --trace and --time of build, update, bake and transfer: what is in them, and that nothing else
// changes.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "cli/clip_helpers.h"
#include "cli/process_helpers.h"
#include "eval/isa.h"

namespace fs = std::filesystem;
using rigc::test::animated;
using rigc::test::file_text;
using rigc::test::Outcome;
using rigc::test::run_rigc;

namespace {

std::string lamp(int version) {
  return "rigc: 1\nname: lamp\nversion: " + std::to_string(version) + R"(
joints:
  - name: base
    at: [0, 1, 0]
    local: lamp
    label: base
    tags:
      - command: control
  - name: tip
    parent: base
    at: [0, 2, 0]
    local: lamp
    label: tip
    tags:
      - command: control
        id: tip_control
)";
}

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
}

/// A folder with the template `studio/lamp.yaml`.
fs::path studio(const std::string& name) {
  const fs::path folder = rigc::test::fresh_folder(name);
  write(folder / "studio/lamp.yaml", lamp(1));
  return folder;
}

void run(const fs::path& folder, const std::vector<std::string>& arguments) {
  const Outcome done = run_rigc(arguments, {folder, {}});
  REQUIRE_MESSAGE(done.status == 0, done.err);
}

/// Whether each span of a thread lies inside the one that was open when it began.
bool nests(const nlohmann::json& events, int thread) {
  std::vector<double> ends;
  for (const auto& event : events) {
    if (event["ph"] != "X" || event["tid"] != thread) continue;
    const double begin = event["ts"], end = begin + event["dur"].get<double>();
    while (!ends.empty() && ends.back() <= begin) ends.pop_back();
    if (!ends.empty() && end > ends.back() + 0.002) return false;  // rounding of microseconds
    ends.push_back(end);
  }
  return true;
}

/// The trace's spans, after checking what every trace must be.
nlohmann::json spans(const fs::path& file) {
  const auto document = nlohmann::json::parse(file_text(file));
  auto out = nlohmann::json::array();
  std::set<int> threads;
  for (const auto& event : document.at("traceEvents")) {
    threads.insert(event.at("tid").get<int>());
    if (event.at("ph") != "X") continue;
    CHECK(event.at("dur") >= 0);
    out.push_back(event);
  }
  for (const int thread : threads) CHECK(nests(document["traceEvents"], thread));
  return out;
}

bool has(const nlohmann::json& spans, const std::string& name) {
  return std::any_of(spans.begin(), spans.end(),
                     [&](const auto& span) { return span["name"] == name; });
}

void check_stages(const nlohmann::json& spans, const std::vector<std::string>& names) {
  for (const std::string& name : names) CHECK_MESSAGE(has(spans, name), name);
}

}  // namespace

TEST_CASE("cli trace: a build's stages and commands, and the same rig") {
  const fs::path folder = studio("trace_build");
  run(folder, {"build", "studio/lamp.yaml", "-o", "plain.glb"});
  const Outcome timed =
      run_rigc({"build", "studio/lamp.yaml", "-o", "traced.glb", "--trace", "t.json", "--time"},
               {folder, {}});
  REQUIRE(timed.status == 0);
  CHECK(file_text(folder / "plain.glb") == file_text(folder / "traced.glb"));
  const auto events = spans(folder / "t.json");
  check_stages(events, {"read template", "expand", "place", "list commands", "run commands",
                        "check evaluation", "compile", "write rig", "write file", "flush"});
  const auto command = std::find_if(events.begin(), events.end(),
                                    [](const auto& span) { return span["name"] == "tip_control"; });
  REQUIRE(command != events.end());
  CHECK((*command)["cat"] == "control");
  CHECK((*command)["args"]["joint"] == "tip");
  for (const char* line : {"stage ", "run commands ", "total ", "module ", "control "})
    CHECK_MESSAGE(timed.err.find(line) != std::string::npos, line);
}

TEST_CASE("cli trace: which instruction set ran, and the same file with each") {
  const fs::path folder = studio("trace_isa");
  std::set<std::string> rigs;
  for (const rigc::eval::Isa isa : rigc::eval::available_isas()) {
    const std::string name(rigc::eval::name(isa));
    const Outcome timed =
        run_rigc({"build", "studio/lamp.yaml", "-o", "x.glb", "--trace", "t.json", "--time"},
                 {folder, {{"RIGC_ISA", name}}});
    REQUIRE(timed.status == 0);
    CHECK(timed.err.find("\ninstruction set: " + name + "\n") != std::string::npos);
    const auto trace = nlohmann::json::parse(file_text(folder / "t.json"));
    CHECK(trace["otherData"]["instruction set"] == name);
    rigs.insert(file_text(folder / "x.glb"));
  }
  CHECK(rigs.size() == 1);
}

TEST_CASE("cli trace: a build on a model names how it was fitted") {
  const fs::path corpus = rigc::test::corpus_folder();
  if (corpus.empty()) {
    MESSAGE("no corpus: not tested");
    return;
  }
  const fs::path folder = rigc::test::fresh_folder("trace_model");
  const std::string model = (corpus / "mixamo_Xbot_blender/Xbot.glb").string();
  write(folder / "x.glb.model", model);  // whose warnings the validator lets pass
  run(folder, {"build", (rigc::test::source_folder() / "templates/biped.yaml").string(), "--model",
               model, "-o", "x.glb", "--trace", "t.json"});
  check_stages(spans(folder / "t.json"), {"read file", "read skeletons", "match bones", "fit"});
}

TEST_CASE("cli trace: an update over several files in two threads") {
  const fs::path folder = studio("trace_update");
  for (const char* shots : {"plain", "traced"})
    for (const char* file : {"/a.glb", "/b.glb", "/c.glb"}) {
      fs::create_directories(folder / shots);
      run(folder, {"build", "studio/lamp.yaml", "-o", std::string(shots) + file});
    }
  write(folder / "studio/lamp.yaml", lamp(2));
  run(folder, {"update", "plain", "--templates", "studio"});
  const Outcome timed = run_rigc(
      {"update", "traced", "--templates", "studio", "--jobs", "2", "--trace", "t.json", "--time"},
      {folder, {}});
  REQUIRE(timed.status == 0);
  CHECK(timed.err.find("total of 2 threads") != std::string::npos);
  const auto events = spans(folder / "t.json");
  std::set<std::string> files;
  for (const auto& event : events)
    if (event["cat"] == "file") files.insert(event["args"]["file"].get<std::string>());
  CHECK(files == std::set<std::string>{"traced/a.glb", "traced/b.glb", "traced/c.glb"});
  for (const char* file : {"/a.glb", "/b.glb", "/c.glb"})
    CHECK(file_text(folder / ("plain" + std::string(file))) ==
          file_text(folder / ("traced" + std::string(file))));
  check_stages(events,
               {"find files", "read rig versions", "read template", "expand", "read file",
                "read rigs", "read clips", "place", "list commands", "run commands", "match",
                "carry keys", "compare motion", "write rigs", "edit channels", "write file"});
}

TEST_CASE("cli trace: a bake's stages, and the same file") {
  const fs::path folder = studio("trace_bake");
  run(folder, {"build", "studio/lamp.yaml", "-o", "rig.gltf"});
  const Outcome looked = run_rigc({"inspect", "rig.gltf", "--json"}, {folder, {}});
  const auto node = nlohmann::json::parse(looked.out).at("rigs")[0].at("controls")[0].at("node");
  write(folder / "shot.gltf", animated(file_text(folder / "rig.gltf"), node));
  const std::vector<std::string> bake = {"bake", "shot.gltf", "--tolerance", "1", "-o"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), bake.begin(), bake.end());
    run(folder, more);
  };
  with({"plain.gltf"});
  with({"traced.gltf", "--trace", "t.json"});
  CHECK(file_text(folder / "plain.gltf") == file_text(folder / "traced.gltf"));
  const auto events = spans(folder / "t.json");
  check_stages(events, {"read file", "read rigs", "read clips", "bake clip", "compile", "evaluate",
                        "reduce", "write clips", "write file"});
  const auto clip = std::find_if(events.begin(), events.end(),
                                 [](const auto& span) { return span["name"] == "bake clip"; });
  CHECK((*clip)["args"]["clip"] == "rise");
}

TEST_CASE("cli trace: a transfer's stages, and the same file") {
  const fs::path folder = studio("trace_transfer");
  run(folder, {"build", "studio/lamp.yaml", "-o", "rig.gltf"});
  const Outcome looked = run_rigc({"inspect", "rig.gltf", "--json"}, {folder, {}});
  const auto node = nlohmann::json::parse(looked.out).at("rigs")[0].at("joints")[0].at("node");
  write(folder / "shot.gltf", animated(file_text(folder / "rig.gltf"), node));
  run(folder, {"transfer", "shot.gltf", "-o", "plain.gltf"});
  run(folder, {"transfer", "shot.gltf", "-o", "traced.gltf", "--trace", "t.json", "--time"});
  CHECK(file_text(folder / "plain.gltf") == file_text(folder / "traced.gltf"));
  check_stages(spans(folder / "t.json"), {"read file", "read rigs", "read clips", "transfer clip",
                                          "plan", "solve", "measure", "write clips", "write file"});
}

TEST_CASE("cli trace: a file that cannot be one is an error before the work") {
  const fs::path folder = studio("trace_bad");
  const auto refused = [&](const std::vector<std::string>& more, const char* code) {
    std::vector<std::string> arguments = {"build", "studio/lamp.yaml", "-o", "x.glb"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome done = run_rigc(arguments, {folder, {}});
    CHECK(done.err.find(code) != std::string::npos);
    CHECK_FALSE(fs::exists(folder / "x.glb"));
    return done.status;
  };
  CHECK(refused({"--trace", "t.glb"}, "RIG0814") == 1);
  CHECK(refused({"--trace", "nowhere/t.json"}, "RIG0005") == 3);
  fs::create_directories(folder / "folder.json");
  CHECK(refused({"--trace", "folder.json"}, "RIG00") == 3);
  run(folder, {"build", "studio/lamp.yaml", "-o", "shot.glb"});
  const Outcome same = run_rigc(
      {"update", "shot.glb", "--templates", "studio", "--report", "r.json", "--trace", "./r.json"},
      {folder, {}});
  CHECK(same.status == 1);
  CHECK(same.err.find("RIG0814") != std::string::npos);
  CHECK_FALSE(fs::exists(folder / "r.json"));
}

TEST_CASE("cli trace: work that fails leaves a trace of how far it came") {
  const fs::path folder = studio("trace_failed");
  write(folder / "studio/lamp.yaml", lamp(1) + "      - command: no_such_module\n");
  const Outcome done =
      run_rigc({"build", "studio/lamp.yaml", "-o", "x.glb", "--trace", "t.json"}, {folder, {}});
  CHECK(done.status == 1);
  CHECK_FALSE(fs::exists(folder / "x.glb"));
  const auto events = spans(folder / "t.json");
  CHECK(has(events, "read template"));
  CHECK_FALSE(has(events, "write file"));
}
