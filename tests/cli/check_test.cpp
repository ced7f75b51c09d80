// SPDX-License-Identifier: MIT
// rigc check as people and programs meet it: several files, folders, JSON, pins.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "cli/json_helpers.h"
#include "cli/process_helpers.h"

namespace fs = std::filesystem;
using rigc::test::Outcome;
using rigc::test::run_rigc;

namespace {

/// Two controls and an attribute, with comments that must stay.
std::string lever(const std::string& pins, const std::string& eol = "\n") {
  std::string text = "# A lever.\nrigc: 1\nname: lever\nversion: 1   # raised by hand\n" + pins +
                     R"(joints:   # two
  - name: base
    at: [0, 1, 0]
    local: lever
    label: base
    tags:
      - command: control
      - {command: attribute, with: {attribute: bend}}
  - {name: tip, parent: base, at: [0, 2, 0], local: lever, label: tip}
)";
  std::string out;
  for (char c : text) out += c == '\n' ? eol : std::string(1, c);
  return out;
}

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// What --pin makes of a text; the same after a second run.
std::string pinned(const fs::path& folder, const std::string& text) {
  write(folder / "lever.yaml", text);
  const Outcome first = run_rigc({"check", "--pin", "lever.yaml"}, {folder, {}});
  INFO(first.err << first.out);
  CHECK(first.status == 0);
  const std::string once = rigc::test::file_text(folder / "lever.yaml");
  const auto time = fs::last_write_time(folder / "lever.yaml");
  const Outcome second = run_rigc({"check", "--pin", "lever.yaml"}, {folder, {}});
  CHECK(second.status == 0);
  CHECK_FALSE(has(second.out, "pinned"));
  CHECK(rigc::test::file_text(folder / "lever.yaml") == once);
  CHECK(fs::last_write_time(folder / "lever.yaml") == time);
  return once;
}

}  // namespace

TEST_CASE("cli check: several files, each with what it is, and a summary") {
  const fs::path folder = rigc::test::fresh_folder("check");
  write(folder / "good.yaml", lever(""));
  write(folder / "bad.yaml", lever("units: inch\n"));
  write(folder / "map.yaml", "map: own\njoints: {lever.base: Base, lever.tip: ~}\n");
  const rigc::test::Surroundings here{folder, {}};
  REQUIRE(run_rigc({"build", "good.yaml", "-o", "lever.glb"}, here).status == 0);
  const Outcome good = run_rigc({"check", "good.yaml", "lever.glb", "map.yaml"}, here);
  CHECK(good.status == 0);
  CHECK(good.err.empty());
  CHECK(has(good.out, "good.yaml: template, no errors\n  lever version 1: 2 joints, 2 commands\n"));
  CHECK(has(good.out, "lever.glb: rig, no errors\n"));
  CHECK(has(good.out, "made by lever version 1"));
  CHECK(has(good.out, "map.yaml: map, no errors\n  own: 2 joints\n"));
  CHECK(has(good.out, "\n3 files checked: no errors\n"));

  const Outcome bad = run_rigc({"check", "bad.yaml", "good.yaml"}, here);
  CHECK(bad.status == 1);
  CHECK(has(bad.err, "bad.yaml:5:8: error[RIG0223]"));
  CHECK(has(bad.out, "2 files checked: 1 error\n"));
  CHECK(run_rigc({"check", "missing.yaml"}, here).status == 3);
  CHECK(run_rigc({"check", "missing.glb", "good.yaml"}, here).status == 3);
  CHECK(run_rigc({"check", "no_such_template"}, here).status == 1);
  CHECK(run_rigc({"check"}, here).status == 2);
}

TEST_CASE("cli check: --json lists every diagnostic of every file") {
  using rigc::test::json_at;
  using rigc::test::json_keys;
  const fs::path folder = rigc::test::fresh_folder("check_json");
  write(folder / "good.yaml", lever(""));
  write(folder / "bad.yaml", lever("units: inch\nglobl: x\n"));
  write(folder / "broken/cut.glb", "glTF");
  const Outcome outcome =
      run_rigc({"check", "bad.yaml", "good.yaml", "broken/cut.glb", "--json"}, {folder, {}});
  CHECK(outcome.status == 1);
  REQUIRE(rigc::test::is_json(outcome.out));
  CHECK(json_keys(outcome.out, "") == "errors files warnings ");
  CHECK(json_keys(outcome.out, "/files/0") == "diagnostics errors facts file kind pins warnings ");
  CHECK(json_at(outcome.out, "/files/0/file") == "\"bad.yaml\"");
  CHECK(json_at(outcome.out, "/files/0/errors") == "2");
  CHECK(json_keys(outcome.out, "/files/0/diagnostics/0") ==
        "code column file hint line message severity ");
  CHECK(json_at(outcome.out, "/files/0/diagnostics/0/code") == "\"RIG0048\"");
  CHECK(json_at(outcome.out, "/files/0/diagnostics/0/line") == "6");
  CHECK(json_at(outcome.out, "/files/0/diagnostics/0/severity") == "\"error\"");
  CHECK(json_at(outcome.out, "/files/1/kind") == "\"template\"");
  CHECK(json_at(outcome.out, "/files/1/diagnostics") == "[]");
  CHECK(json_at(outcome.out, "/files/2/kind") == "\"model\"");
  CHECK(json_at(outcome.out, "/files/2/errors") == "1");
}

TEST_CASE("cli check: a folder stands for what is rigc's in it") {
  const fs::path folder = rigc::test::fresh_folder("check_folder");
  write(folder / "in/b/lever.yaml", lever(""));
  write(folder / "in/a.yaml", "map: own\njoints: {}\n");
  write(folder / "in/other.yaml", "services: {}\n");
  write(folder / "in/not_yaml.yaml", "rigc: 1\nname: [\n");
  write(folder / "in/.hidden/lever.yaml", lever(""));
  write(folder / "empty/readme.txt", "nothing\n");
  fs::create_directory_symlink("../in", folder / "in/loop");
  const rigc::test::Surroundings here{folder, {}};
  const Outcome outcome = run_rigc({"check", "in", "--json"}, here);
  CHECK(outcome.status == 1);
  using rigc::test::json_at;
  CHECK(json_at(outcome.out, "/files/0/file") == "\"in/a.yaml\"");
  CHECK(json_at(outcome.out, "/files/0/kind") == "\"map\"");
  CHECK(json_at(outcome.out, "/files/1/file") == "\"in/b/lever.yaml\"");
  CHECK(json_at(outcome.out, "/files/2/file") == "\"in/not_yaml.yaml\"");
  CHECK(json_at(outcome.out, "/files/2/kind") == "\"template\"");
  CHECK(json_at(outcome.out, "/files/3").empty());
  const Outcome nothing = run_rigc({"check", "empty"}, here);
  CHECK(nothing.status == 1);
  CHECK(has(nothing.err, "RIG0783"));
}

TEST_CASE("cli check: an option that may stand several times takes one word each") {
  const fs::path folder = rigc::test::fresh_folder("check_options");
  write(folder / "one.yaml", lever(""));
  write(folder / "two.yaml", lever(""));
  const Outcome outcome =
      run_rigc({"check", "--templates", ".", "one.yaml", "two.yaml"}, {folder, {}});
  CHECK(outcome.status == 0);
  CHECK(has(outcome.out, "2 files checked"));
}

TEST_CASE("cli check: --pin writes the modules that the template uses, and nothing else") {
  const fs::path folder = rigc::test::fresh_folder("pin");
  CHECK(pinned(folder, lever("")) == lever("modules: {attribute: 1, control: 1}\n"));
  CHECK(pinned(folder, lever("", "\r\n")) ==
        lever("modules: {attribute: 1, control: 1}\n", "\r\n"));
  CHECK(pinned(folder, lever("modules: {control: 1}   # kept\n")) ==
        lever("modules: {control: 1, attribute: 1}   # kept\n"));
  CHECK(pinned(folder, lever("modules: {  }\n")) ==
        lever("modules: {attribute: 1, control: 1  }\n"));
  CHECK(pinned(folder, lever("modules:\n    control: 1   # kept\n\n")) ==
        lever("modules:\n    control: 1   # kept\n    attribute: 1\n\n"));
  CHECK(pinned(folder, lever("modules: {set: 1}\n")) ==
        lever("modules: {set: 1, attribute: 1, control: 1}\n"));
  const std::string flow =
      "{rigc: 1, name: lever, version: 1, joints: [{name: a, tags: [{command: control}]}]}";
  CHECK(pinned(folder, flow) ==
        "{rigc: 1, name: lever, version: 1, modules: {control: 1}, joints: [{name: a, tags: "
        "[{command: control}]}]}");
  const std::string plain = "rigc: 1\nname: lever\njoints: [{name: a}]\nversion: 1";
  CHECK(pinned(folder, plain) == plain);
  const std::string last =
      "rigc: 1\nname: lever\njoints: [{name: a, tags: [{command: control}]}]\nversion: 1";
  CHECK(pinned(folder, last) == last + "\nmodules: {control: 1}");
}

TEST_CASE("cli check: --pin leaves files alone that it cannot pin") {
  const fs::path folder = rigc::test::fresh_folder("no_pin");
  const rigc::test::Surroundings here{folder, {}};
  write(folder / "bad.yaml", lever("units: inch\n"));
  CHECK(run_rigc({"check", "--pin", "bad.yaml"}, here).status == 1);
  CHECK(rigc::test::file_text(folder / "bad.yaml") == lever("units: inch\n"));
  write(folder / "good.yaml", lever(""));
  REQUIRE(run_rigc({"build", "good.yaml", "-o", "lever.glb"}, here).status == 0);
  const std::string rig = rigc::test::file_text(folder / "lever.glb");
  const Outcome of_rig = run_rigc({"check", "--pin", "lever.glb"}, here);
  CHECK(of_rig.status == 1);
  CHECK(has(of_rig.err, "RIG0782"));
  CHECK(rigc::test::file_text(folder / "lever.glb") == rig);
  const Outcome by_name = run_rigc({"check", "--pin", "prop"}, here);
  CHECK(by_name.status == 1);
  CHECK(has(by_name.err, "RIG0782"));
  // Pins that stand elsewhere, behind an anchor, cannot be added to in place.
  const std::string text = lever("features: &pins {}\nmodules: *pins\n");
  write(folder / "good.yaml", text);
  const Outcome elsewhere = run_rigc({"check", "--pin", "good.yaml"}, here);
  CHECK(elsewhere.status == 1);
  CHECK(has(elsewhere.err, "RIG0782"));
  CHECK(has(elsewhere.err, "modules: {attribute: 1, control: 1}"));
  CHECK(rigc::test::file_text(folder / "good.yaml") == text);
}
