// SPDX-License-Identifier: MIT
// The command line as people and programs meet it: usage, exit status, JSON, where output goes, and
// that the same input gives the same bytes wherever and however rigc is started.
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

const char* const kTemplate = R"(rigc: 1
name: lever
version: 1
joints:
  - name: base
    at: [0, 1, 0]
    local: lever
    label: base
    tags:
      - command: control
        with: {shape: circle, size: 0.3}
  - name: tip
    parent: base
    at: [0, 2, 0]
    local: lever
    label: tip
)";

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
}

std::string with_unknown_module() {
  std::string text = kTemplate;
  return text.replace(text.find("command: control"), 16, "command: contrl");
}

std::size_t files_in(const fs::path& folder) {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& entry : fs::recursive_directory_iterator(folder)) ++count;
  return count;
}

fs::path biped() { return rigc::test::source_folder() / "templates/biped.yaml"; }

}  // namespace

TEST_CASE("cli: --version and --help go to stdout and succeed") {
  const Outcome version = run_rigc({"--version"});
  CHECK(version.status == 0);
  CHECK(version.out == "rigc 0.1.0\n");
  CHECK(version.err.empty());
  const Outcome help = run_rigc({"--help"});
  CHECK(help.status == 0);
  CHECK(help.err.empty());
  for (const char* command :
       {"build", "check", "plan", "inspect", "query", "bake", "modules", "schema"}) {
    INFO(command);
    CHECK(help.out.find(std::string("\n  ") + command + " ") != std::string::npos);
    const Outcome own = run_rigc({command, "--help"});
    CHECK(own.status == 0);
    CHECK(own.out.find("--json") != std::string::npos);
  }
}

TEST_CASE("cli: wrong usage gives status 2, an explanation on stderr and nothing on stdout") {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{},
        {"frobnicate"},
        {"build"},
        {"build", "x.yaml"},
        {"build", "x.yaml", "-o", "x.glb", "--no-such-option"},
        {"bake", "x.glb", "-o"},
        {"bake", "x.glb", "-o", "y.glb", "--start", "soon"},
        {"--json"}}) {
    const Outcome outcome = run_rigc(arguments);
    INFO("after " << arguments.size() << " arguments: " << outcome.err);
    CHECK(outcome.status == 2);
    CHECK_FALSE(outcome.err.empty());
    CHECK(outcome.out.empty());
  }
}

TEST_CASE("cli: errors in the work give status 1 and write nothing") {
  const fs::path folder = rigc::test::fresh_folder("errors");
  write(folder / "in/lever.yaml", with_unknown_module());
  fs::create_directories(folder / "broken");
  const std::string out = (folder / "broken/lever.glb").string();
  const Outcome build = run_rigc({"build", "lever.yaml", "-o", out}, {folder / "in", {}});
  CHECK(build.status == 1);
  CHECK(build.err.find("lever.yaml:10:") == 0);
  CHECK(build.err.find(": error[RIG0236]: ") != std::string::npos);
  CHECK(build.err.find("\"control\"") != std::string::npos);  // did you mean
  CHECK(build.out.empty());
  CHECK(files_in(folder / "broken") == 0);
  CHECK(files_in(folder / "in") == 1);

  write(folder / "broken/lever.glb", "precious");
  CHECK(run_rigc({"build", "lever.yaml", "-o", out}, {folder / "in", {}}).status == 1);
  CHECK(rigc::test::file_text(out) == "precious");
  CHECK(run_rigc({"check", "lever.yaml"}, {folder / "in", {}}).status == 1);
  CHECK(run_rigc({"bake", "lever.yaml", "-o", out}, {folder / "in", {}}).status == 1);
  CHECK(run_rigc({"inspect", "lever.yaml"}, {folder / "in", {}}).status == 1);
  CHECK(rigc::test::file_text(out) == "precious");
}

TEST_CASE("cli: status 3 where the file system refuses") {
  const fs::path folder = rigc::test::fresh_folder("refused");
  write(folder / "lever.yaml", kTemplate);
  const Outcome no_folder =
      run_rigc({"build", "lever.yaml", "-o", "no/such/folder/x.glb"}, {folder, {}});
  CHECK(no_folder.status == 3);
  CHECK(no_folder.err.find("error[RIG") != std::string::npos);
  CHECK(run_rigc({"inspect", "missing.glb"}, {folder, {}}).status == 3);
  CHECK(run_rigc({"bake", "missing.glb", "-o", "x.glb"}, {folder, {}}).status == 3);
  fs::create_directories(folder / "folder.glb");
  CHECK(run_rigc({"inspect", "folder.glb"}, {folder, {}}).status == 3);
  CHECK(run_rigc({"build", "lever.yaml", "-o", "folder.glb"}, {folder, {}}).status == 3);
}

TEST_CASE("cli: mistakes on the command line are named") {
  const fs::path folder = rigc::test::fresh_folder("named");
  write(folder / "lever.yaml", kTemplate);
  const rigc::test::Surroundings here{folder, {}};
  REQUIRE(run_rigc({"build", "lever.yaml", "-o", "lever.glb"}, here).status == 0);
  REQUIRE(run_rigc({"bake", "lever.glb", "-o", "baked.glb"}, here).status == 0);
  struct Mistake {
    std::vector<std::string> arguments;
    std::string code;
  };
  for (const Mistake& mistake : {
           Mistake{{"build", "no_such_template", "-o", "x.glb"}, "RIG0290"},
           {{"build", "lever.yaml", "-o", "x.fbx"}, "RIG0759"},
           {{"query", "baked.glb", "lever.base"}, "RIG0754"},
           {{"query", "lever.glb", "lever.base/control | | x"}, "RIG0150"},
           {{"bake", "lever.glb", "-o", "x.glb", "--start", "2", "--end", "1"}, "RIG0757"},
           {{"bake", "lever.glb", "-o", "x.glb", "--clip", "walk"}, "RIG0755"},
           {{"query", "lever.glb", "prop:lever.base"}, "RIG0760"},
           {{"modules", "contrl"}, "RIG0761"},
       }) {
    const Outcome outcome = run_rigc(mistake.arguments, here);
    INFO(mistake.code << " in\n" << outcome.err);
    CHECK(outcome.status == 1);
    const auto printed = rigc::test::printed_diagnostics(outcome.err, "");
    REQUIRE(printed.size() == 1);
    CHECK(printed[0].text.find(mistake.code) != std::string::npos);
    CHECK_FALSE(fs::exists(folder / "x.glb"));
    CHECK_FALSE(fs::exists(folder / "x.fbx"));
  }
}

TEST_CASE("cli: --json prints one JSON document and nothing else") {
  const fs::path folder = rigc::test::fresh_folder("json");
  write(folder / "lever.yaml", kTemplate);
  write(folder / "bad.yaml", with_unknown_module());
  const rigc::test::Surroundings here{folder, {}};
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"build", "lever.yaml", "-o", "lever.glb", "--json"},
        {"check", "lever.yaml", "--json"},
        {"plan", "lever.yaml", "--json"},
        {"plan", "lever.yaml", "--program", "--json"},
        {"plan", "lever.glb", "--program", "--json"},
        {"inspect", "lever.glb", "--json"},
        {"query", "lever.glb", "lever.base/control", "--json"},
        {"bake", "lever.glb", "-o", "baked.glb", "--json"},
        {"modules", "--json"},
        {"modules", "control", "--json"},
        {"schema", "control", "--json"},
        {"schema", "template"},
        {"schema", "map"},
        {"schema", "module"},
        {"schema", "RIGC_rig", "--json"}}) {
    INFO(arguments.front());
    const Outcome outcome = run_rigc(arguments, here);
    INFO(outcome.err);
    CHECK(outcome.status == 0);
    CHECK(rigc::test::is_json(outcome.out));
  }
  const Outcome bad = run_rigc({"check", "bad.yaml", "lever.yaml", "--json"}, here);
  CHECK(bad.status == 1);
  CHECK(rigc::test::is_json(bad.out));
  CHECK(rigc::test::json_at(bad.out, "/files/0/errors") == "1");
  CHECK(rigc::test::json_at(bad.out, "/files/1/errors") == "0");
}

TEST_CASE("cli: inspect and query have the blueprint's form") {
  const fs::path folder = rigc::test::fresh_folder("inspect");
  write(folder / "lever.yaml", kTemplate);
  const rigc::test::Surroundings here{folder, {}};
  REQUIRE(run_rigc({"build", "lever.yaml", "-o", "lever.glb"}, here).status == 0);
  const std::string inspected = run_rigc({"inspect", "lever.glb", "--json"}, here).out;
  using rigc::test::json_at;
  using rigc::test::json_keys;
  CHECK(json_keys(inspected, "") == "clips rigs ");
  CHECK(json_keys(inspected, "/rigs/0") ==
        "commands controls features global groups id joints layers orphans sets template ");
  CHECK(json_keys(inspected, "/rigs/0/template") == "name version ");
  CHECK(json_keys(inspected, "/rigs/0/joints/1") == "label local name node uid ");
  CHECK(json_keys(inspected, "/rigs/0/controls/0") ==
        "attributes hidden id identity label limits local locked module name node opposite role ");
  CHECK(json_at(inspected, "/rigs/0/template/name") == "\"lever\"");
  CHECK(json_at(inspected, "/rigs/0/groups") == "[\"lever\"]");
  CHECK(json_at(inspected, "/rigs/0/joints/1/label") == "\"tip\"");
  CHECK(json_at(inspected, "/rigs/0/controls/0/module") == "\"control\"");

  const std::string found =
      run_rigc({"query", "lever.glb", "lever.base/control", "--json"}, here).out;
  CHECK(json_keys(found, "/0") == "kind label local name node ");
  CHECK(json_at(found, "/0/kind") == "\"control\"");
  CHECK(json_at(found, "/0/node") == json_at(inspected, "/rigs/0/controls/0/node"));
}

TEST_CASE("cli: the same template gives the same bytes wherever and however it is built") {
  const fs::path folder = rigc::test::fresh_folder("same");
  // A copy elsewhere, reached by other paths, in other surroundings.
  fs::create_directories(folder / "elsewhere/deep");
  fs::copy(biped().parent_path(), folder / "elsewhere/templates", fs::copy_options::recursive);
  const std::string reference = (folder / "biped.glb").string();
  const Outcome first = run_rigc({"build", biped().string(), "-o", reference});
  INFO(first.err);
  REQUIRE(first.status == 0);
  const std::string bytes = rigc::test::file_text(reference);
  REQUIRE(bytes.size() > 1000);

  struct Variant {
    std::string what;
    std::string input;
    rigc::test::Surroundings surroundings;
  };
  const Variant variants[] = {
      {"again", biped().string(), {}},
      {"a relative path", "../templates/biped.yaml", {folder / "elsewhere/deep", {}}},
      {"its own folder", "biped.yaml", {folder / "elsewhere/templates", {}}},
      {"a German locale", biped().string(), {".", {{"LC_ALL", "de_DE.UTF-8"}, {"LANG", "de_DE"}}}},
      {"a Turkish locale", biped().string(), {".", {{"LC_ALL", "tr_TR.UTF-8"}}}},
      {"another time zone", biped().string(), {".", {{"TZ", "Pacific/Kiritimati"}}}},
      {"another user", biped().string(), {".", {{"USER", "somebody"}, {"HOME", "/nonexistent"}}}},
  };
  for (const Variant& variant : variants) {
    INFO(variant.what);
    const std::string out = (folder / "elsewhere/other.glb").string();
    const Outcome outcome = run_rigc({"build", variant.input, "-o", out}, variant.surroundings);
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK(rigc::test::file_text(out) == bytes);
    fs::remove(out);
  }
}
