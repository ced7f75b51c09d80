// SPDX-License-Identifier: MIT
// rigc status as people and scripts meet it.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "cli/json_helpers.h"
#include "cli/process_helpers.h"

namespace fs = std::filesystem;
using rigc::test::Outcome;
using rigc::test::run_rigc;

namespace {

std::string lamp(int version, const std::string& more = {}) {
  return "rigc: 1\nname: lamp\nversion: " + std::to_string(version) + "\n" + more + R"(joints:
  - name: base
    at: [0, 1, 0]
    local: lamp
    tags: [{command: control}]
)";
}

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A folder with a template and shots that were made from its version 1.
fs::path shots(const std::string& name) {
  const fs::path folder = rigc::test::fresh_folder(name);
  write(folder / "studio/lamp.yaml", lamp(1));
  fs::create_directories(folder / "shots/010");
  for (const char* shot : {"shots/010/a.glb", "shots/010/b.gltf", "shots/020.glb"}) {
    const Outcome built =
        run_rigc({"build", "studio/lamp.yaml", "-o", shot, "--global", "desk"}, {folder, {}});
    REQUIRE(built.status == 0);
  }
  write(folder / "shots/notes.txt", "no rig");
  return folder;
}

}  // namespace

TEST_CASE("cli status: a folder of shots before and after the template moves on") {
  const fs::path folder = shots("status_folder");
  const Outcome same =
      run_rigc({"status", "shots", "--templates", "studio", "--exit-code"}, {folder, {}});
  CHECK(same.status == 0);
  CHECK(same.err.empty());
  CHECK(has(same.out, "shots/010/a.glb   desk  lamp      1        nothing\n"));
  CHECK(has(same.out, "3 files, 3 rigs, 3 need nothing\n"));

  write(folder / "studio/lamp.yaml", lamp(2));
  const Outcome newer =
      run_rigc({"status", "shots", "--templates", "studio", "--exit-code"}, {folder, {}});
  CHECK(newer.status == 1);
  CHECK(newer.err.empty());
  CHECK(has(newer.out, "shots/020.glb     desk  lamp      1 -> 2   update: lamp 1 -> 2\n"));
  CHECK(run_rigc({"status", "shots", "--templates", "studio"}, {folder, {}}).status == 0);

  write(folder / "studio/lamp.yaml", lamp(1, "description: Other.\n"));
  write(folder / "studio/led.yaml", lamp(3, "was: [lamp]\n").replace(14, 4, "led"));
  const Outcome changed =
      run_rigc({"status", "shots/020.glb", "--templates", "studio"}, {folder, {}});
  CHECK(has(changed.out, "rebuild: lamp changed without a new version (fork led 3: --to led)"));

  fs::remove_all(folder / "studio");
  const Outcome gone = run_rigc({"status", "shots", "--exit-code"}, {folder, {}});
  CHECK(gone.status == 0);  // nothing would change
  CHECK(has(gone.out, "cannot: no template lamp is found"));
}

TEST_CASE("cli status: one JSON document, whatever the number of jobs") {
  const fs::path folder = shots("status_json");
  write(folder / "studio/lamp.yaml", lamp(2));
  const Outcome one =
      run_rigc({"status", "shots", "--templates", "studio", "--json", "--jobs", "1"}, {folder, {}});
  const Outcome four =
      run_rigc({"status", "shots", "--templates", "studio", "--json", "--jobs", "4"}, {folder, {}});
  CHECK(one.out == four.out);
  const auto at = [&](const std::string& pointer) { return rigc::test::json_at(one.out, pointer); };
  CHECK(at("/files/0/file") == "\"shots/010/a.glb\"");
  CHECK(at("/files/1/file") == "\"shots/010/b.gltf\"");
  const std::string rig = "/files/0/rigs/0/";
  CHECK(at(rig + "global") == "\"desk\"");
  CHECK(at(rig + "template") == "\"lamp\"");
  CHECK(at(rig + "action") == "\"update\"");
  CHECK(at(rig + "templates/0/version") == "1");
  CHECK(at(rig + "templates/0/found") == "2");
  CHECK(at(rig + "templates/0/state") == "\"newer\"");
  CHECK(at(rig + "modules/0/name") == "\"control\"");
  CHECK(at(rig + "modules/0/state") == "\"current\"");
  CHECK(at(rig + "orphans") == "[]");
  CHECK(at("/summary/update") == "3");
  CHECK(at("/summary/errors") == "0");
}

TEST_CASE("cli status: bad files are reported, the others are told") {
  const fs::path folder = shots("status_bad");
  write(folder / "shots/broken/cut.glb", "glTF");
  write(folder / "shots/plain.gltf", R"({"asset":{"version":"2.0"}})");
  const Outcome outcome =
      run_rigc({"status", "shots", "none.glb", "--templates", "studio"}, {folder, {}});
  CHECK(outcome.status == 3);  // none.glb is not there
  CHECK(has(outcome.err, "cut.glb"));
  CHECK(has(outcome.err, "none.glb"));
  CHECK(has(outcome.out,
            "6 files, 3 rigs, 3 need nothing, 1 file without a rig, 2 files with errors\n"));
  CHECK(run_rigc({"status", "shots/broken"}, {folder, {}}).status == 1);
  CHECK(run_rigc({"status"}, {folder, {}}).status == 2);
  CHECK(run_rigc({"status", "shots/plain.gltf"}, {folder, {}}).out ==
        "1 file, 0 rigs, 1 file without a rig\n");
}
