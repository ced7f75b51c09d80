// SPDX-License-Identifier: MIT
// Completions: bash runs the script and says what it would offer; the scripts for zsh and fish are
// read by those shells where they are installed.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "cli/process_helpers.h"

namespace fs = std::filesystem;
using namespace rigc::test;

namespace {

/// A folder with something of every kind, and the script for a shell.
fs::path prepared(const std::string& shell) {
  const fs::path folder = fresh_folder("completions_" + shell) / "broken";
  fs::create_directories(folder / "models");
  for (const char* name : {"hero.glb", "hero.gltf", "hero.vrm", "hero.png", "hero.yaml",
                           "models/other one.glb", "models/notes.txt"})
    std::ofstream(folder / name) << "{}";
  const Outcome made = run_rigc({"completions", shell});
  REQUIRE(made.status == 0);
  std::ofstream(folder / "script") << made.out;
  return folder;
}

std::string find_program(const std::string& name) {
  for (const char* folder : {"/bin/", "/usr/bin/", "/usr/local/bin/"})
    if (fs::exists(folder + name)) return folder + name;
  return {};
}

/// What bash offers for the last of these words, sorted.
std::vector<std::string> offered(const fs::path& folder, const std::vector<std::string>& words) {
  std::vector<std::string> arguments = {
      "-c",
      "source ./script; rigc=$1; shift; COMP_WORDS=(\"$rigc\" \"$@\"); COMP_CWORD=$#; _rigc; "
      "printf '%s\\n' \"${COMPREPLY[@]}\"",
      "bash", rigc_binary()};
  arguments.insert(arguments.end(), words.begin(), words.end());
  const Outcome outcome = run_program(find_program("bash"), arguments, {.folder = folder});
  CHECK(outcome.status == 0);
  CHECK(outcome.err == "");
  auto lines = lines_of(outcome.out);
  std::sort(lines.begin(), lines.end());
  return lines;
}

bool has(const std::vector<std::string>& list, const std::string& word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

using Words = std::vector<std::string>;

}  // namespace

TEST_CASE("cli completions: bash offers what may stand at each place") {
  if (find_program("bash").empty()) {
    MESSAGE("no bash here");
    return;
  }
  const fs::path folder = prepared("bash");
  CHECK(offered(folder, {"bu"}) == Words{"build"});
  CHECK(has(offered(folder, {""}), "completions"));
  CHECK_FALSE(has(offered(folder, {""}), "docs"));  // hidden

  CHECK(offered(folder, {"build", "her"}) == Words{"hero.yaml"});
  CHECK(has(offered(folder, {"build", "bi"}), "biped"));
  CHECK(offered(folder, {"build", "biped", "--model", "h"}) ==
        Words{"hero.glb", "hero.gltf", "hero.vrm"});
  CHECK(offered(folder, {"build", "biped", "--model", "mod"}) == Words{"models/"});
  CHECK(offered(folder, {"build", "biped", "--model", "models/"}) == Words{"models/other one.glb"});
  CHECK(has(offered(folder, {"build", "biped", "--map", "mix"}), "mixamo"));
  CHECK(offered(folder, {"build", "biped", "--rest", "n"}) == Words{"nodes"});
  CHECK(offered(folder, {"build", "--templates", ""}) == Words{"models/"});
  CHECK(offered(folder, {"build", "biped", "--out"}) == Words{"--output"});
  CHECK(offered(folder, {"build", "biped", "--json", "-o", "hero.gl"}) ==
        Words{"hero.glb", "hero.gltf"});

  CHECK(offered(folder, {"check", "hero.glb", "hero.y"}) == Words{"hero.yaml"});
  CHECK(offered(folder, {"modules", "ik_fk"}) == Words{"ik_fk_limb"});
  CHECK(has(offered(folder, {"schema", ""}), "RIGC_rig"));
  CHECK(offered(folder, {"query", "--json", "hero.vr"}) == Words{"hero.vrm"});
  CHECK(offered(folder, {"query", "hero.glb", "h"}) == Words());  // a selector
  CHECK(offered(folder, {"completions", "z"}) == Words{"zsh"});
}

TEST_CASE("cli completions: zsh and fish can read their scripts") {
  for (const std::string shell : {"zsh", "fish"}) {
    const fs::path folder = prepared(shell);
    const std::string program = find_program(shell);
    if (program.empty()) {
      MESSAGE("no " << shell << " here");
      continue;
    }
    const Outcome outcome = run_program(program, {"-n", (folder / "script").string()});
    CHECK(outcome.status == 0);
    CHECK(outcome.err == "");
  }
  const std::string fish = find_program("fish");
  if (fish.empty()) return;
  const Outcome outcome =
      run_program(fish, {"-c", "source script; complete -C 'rigc modules ik_fk'"},
                  {.folder = prepared("fish"),
                   .environment = {{"PATH", fs::path(rigc_binary()).parent_path().string() +
                                                ":/usr/bin:/bin"}}});
  CHECK(lines_of(outcome.out) == Words{"ik_fk_limb"});
}

TEST_CASE("cli completions: names come as lists, and other words are refused") {
  const auto listed = [](const std::string& kind) {
    const Outcome outcome = run_rigc({"completions", "--names", kind});
    CHECK(outcome.status == 0);
    return lines_of(outcome.out);
  };
  CHECK(has(listed("templates"), "biped"));
  CHECK(has(listed("maps"), "mixamo"));
  CHECK(has(listed("modules"), "control"));
  const Words modules = listed("modules");
  CHECK(std::is_sorted(modules.begin(), modules.end()));
  for (const auto& arguments : {Words{"completions"}, Words{"completions", "csh"},
                                Words{"completions", "--names", "rigs"}}) {
    const Outcome outcome = run_rigc(arguments);
    CHECK(outcome.status == 1);
    CHECK(outcome.err.find("RIG0081") != std::string::npos);
    CHECK(outcome.out == "");
  }
}
