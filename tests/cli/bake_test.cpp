// SPDX-License-Identifier: MIT
// rigc bake as its users run it: one file, many, threads, what it says.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "clip_helpers.h"
#include "json_helpers.h"
#include "process_helpers.h"

namespace fs = std::filesystem;

namespace rigc::test {
namespace {

/// A folder with two rigs, one below the other, and a file without a rig.
fs::path shots(const std::string& name) {
  const fs::path folder = fresh_folder(name);
  fs::create_directories(folder / "shots" / "act2");
  const std::string biped = (source_folder() / "templates" / "biped.yaml").string();
  REQUIRE(run_rigc({"build", biped, "-o", "shots/a.glb"}, {folder, {}}).status == 0);
  fs::copy_file(folder / "shots/a.glb", folder / "shots/act2/b.glb");
  REQUIRE(run_rigc({"bake", "shots/a.glb", "-o", "shots/plain.glb"}, {folder, {}}).status == 0);
  return folder;
}

/// A rod in FK; its IK control is keyed, which moves no joint. `turned`: its FK controls rest so.
fs::path still_rod(const std::string& name, bool turned) {
  const fs::path folder = fresh_folder(name);
  std::ofstream(folder / "rod.yaml", std::ios::binary) << R"(rigc: 1
name: rod
version: 1
joints:
  - name: upper
    at: [0, 1.2, 0]
    local: arm
    label: upper
    tags:
      - {command: ik_fk_limb, with: {start: ., middle: arm.lower, end: arm.end, ik_fk: 0}}
  - {name: lower, parent: upper, at: [0.3, 1.3, -0.05], local: arm, label: lower}
  - {name: end, parent: lower, at: [0.5, 1.2, 0], local: arm, label: end}
)";
  const Outcome built = run_rigc({"build", "rod.yaml", "-o", "rod.gltf"}, {folder, {}});
  REQUIRE_MESSAGE(built.status == 0, built.err);
  auto document = nlohmann::json::parse(file_text(folder / "rod.gltf"));
  std::size_t ik = 0;
  for (auto& node : document["nodes"]) {
    if (node.value("name", "") == "end_ik")
      ik = static_cast<std::size_t>(&node - &document["nodes"][0]);
    if (turned && node.value("name", "") == "lower_fk") node["rotation"] = {0, 0.6, 0, 0.8};
  }
  REQUIRE(ik > 0);
  std::ofstream(folder / "rod.gltf", std::ios::binary) << animated(document.dump(), ik);
  return folder;
}

}  // namespace

TEST_CASE("cli bake: an output must be named") {
  const Outcome run = run_rigc({"bake", "x.glb"});
  CHECK(run.status == 2);
  CHECK(run.err.find("--out-dir") != std::string::npos);
  CHECK(run.out.empty());
}

TEST_CASE("cli bake: --jobs is a number of threads") {
  for (const char* jobs : {"0", "-1", "1.5", "nan"}) {
    const Outcome run = run_rigc({"bake", "x.glb", "-o", "y.glb", "--jobs", jobs});
    CHECK(run.status == 1);
    CHECK(run.err.find("RIG0814") != std::string::npos);
  }
}

TEST_CASE("cli bake: folders go into another, mirrored, the same for any number of jobs") {
  const fs::path folder = shots("bake_many");
  for (const char* jobs : {"1", "3"}) {
    const std::string out = std::string("out") + jobs;
    const Outcome run =
        run_rigc({"bake", "shots", "--out-dir", out, "--jobs", jobs, "--report", out + ".json"},
                 {folder, {}});
    INFO(run.err);
    CHECK(run.status == 0);
    CHECK(run.out.find("2 changed") != std::string::npos);
    CHECK(run.out.find("1 skipped") != std::string::npos);
    CHECK(fs::exists(folder / out / "a.glb"));
    CHECK(fs::exists(folder / out / "act2" / "b.glb"));
    CHECK_FALSE(fs::exists(folder / out / "plain.glb"));
    const std::string report = file_text(folder / (out + ".json"));
    CHECK(json_at(report, "/command") == "\"bake\"");
    CHECK(json_at(report, "/settings/fps") == "\"30\"");
    CHECK(json_at(report, "/files/0/outcome") == "\"changed\"");
    CHECK(json_at(report, "/files/0/clips") == "[]");
    CHECK(json_at(report, "/totals/skipped") == "1");
  }
  CHECK(file_text(folder / "out1/a.glb") == file_text(folder / "out3/a.glb"));
  CHECK(file_text(folder / "out1/a.glb") == file_text(folder / "shots/plain.glb"));
  // Where it is done, --resume does nothing again.
  const Outcome again = run_rigc(
      {"bake", "shots", "--out-dir", "out1", "--report", "r.json", "--resume", "out1.json"},
      {folder, {}});
  CHECK(again.status == 0);
  const Outcome other = run_rigc(
      {"bake", "shots", "--out-dir", "out1", "--fps", "24", "--resume", "out1.json"}, {folder, {}});
  CHECK(other.status == 1);
  CHECK(other.err.find("RIG0812") != std::string::npos);
}

TEST_CASE("cli bake: a file that cannot be read fails alone") {
  const fs::path folder = shots("bake_fails");
  fs::create_directories(folder / "broken");
  fs::copy_file(folder / "shots/a.glb", folder / "broken/a.glb");
  std::ofstream(folder / "broken/torn.glb") << "no model";
  const Outcome run = run_rigc({"bake", "broken", "--out-dir", "out"}, {folder, {}});
  CHECK(run.status == 1);
  CHECK(run.out.find("torn.glb") != std::string::npos);
  CHECK(fs::exists(folder / "out/a.glb"));
  CHECK_FALSE(fs::exists(folder / "out/torn.glb"));
}

TEST_CASE("cli bake: one file without a rig is an error") {
  const fs::path folder = shots("bake_none");
  const Outcome run = run_rigc({"bake", "shots/plain.glb", "-o", "x.glb"}, {folder, {}});
  CHECK(run.status == 1);
  CHECK(run.err.find("RIG0754") != std::string::npos);
  CHECK_FALSE(fs::exists(folder / "x.glb"));
}

TEST_CASE("cli bake: a clip in which nothing moves keeps its name and its length") {
  for (const bool turned : {false, true}) {
    CAPTURE(turned);
    const fs::path folder = still_rod(turned ? "bake_posed" : "bake_still", turned);
    for (const std::string rig : {"", "--keep-rig"}) {
      std::vector<std::string> command{"bake", "rod.gltf", "-o", "still.gltf"};
      if (!rig.empty()) command.push_back(rig);
      const Outcome run = run_rigc(command, {folder, {}});
      REQUIRE_MESSAGE(run.status == 0, run.err);
      const auto document = nlohmann::json::parse(file_text(folder / "still.gltf"));
      REQUIRE(document["animations"].size() == 1);
      const auto& clip = document["animations"][0];
      CHECK(clip.value("name", "") == "rise");
      double end = 0;
      for (const auto& sampler : clip["samplers"]) {
        const auto& times = document["accessors"][sampler["input"].get<std::size_t>()];
        end = std::max(end, times["max"][0].get<double>());
      }
      CHECK(end == 1);
      for (const auto& channel : clip["channels"]) CHECK(channel["target"].contains("node"));
    }
  }
}

}  // namespace rigc::test
