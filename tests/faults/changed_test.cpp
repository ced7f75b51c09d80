// SPDX-License-Identifier: MIT
// Another program changes, replaces or removes a file while a command is about to replace it: what
// the other one did is never lost, and two commands on one file do not hurt each other.
#include <doctest/doctest.h>

#include <fstream>
#include <thread>

#include "faults/fault_helpers.h"

using namespace rigc::test;
namespace fs = std::filesystem;

namespace {

constexpr const char* kTheirs = "theirs";

/// Commands that read a file in order to replace it, with the file.
std::vector<std::pair<const Command*, std::string>> replacements() {
  std::vector<std::pair<const Command*, std::string>> found;
  for (const Command& command : commands()) {
    if (command.name == "append") found.push_back({&command, "b.glb"});
    if (command.name == "bake_glb") found.push_back({&command, "a.glb"});
    if (command.name == "bake_gltf") found.push_back({&command, "a.gltf"});
    if (command.name.starts_with("update")) found.push_back({&command, command.target});
  }
  return found;
}

/// Index of the call that gives the file its new content.
std::size_t rename_of(const std::vector<std::string>& calls, const std::string& file) {
  for (std::size_t i = 0; i < calls.size(); ++i) {
    const std::string name = fs::path(calls[i]).filename();
    if (calls[i].starts_with("rename") && name.starts_with("." + file)) return i;
  }
  return calls.size();
}

}  // namespace

TEST_CASE("faults: what another program does to a file before it is replaced is not lost") {
  for (const auto& replacement : replacements()) {
    const Command* const command = replacement.first;
    const std::string& file = replacement.second;
    CAPTURE(command->name);
    const Stage stage(*command);
    const auto calls = calls_of(stage);
    const std::size_t last = rename_of(calls, file);
    REQUIRE(last < calls.size());
    const std::string path = stage.path() / file;
    for (const char* kind : {"put", "swap", "remove"}) {
      for (std::size_t i = 0; i < last; ++i) {
        CAPTURE(kind);
        CAPTURE(calls[i]);
        stage.reset();
        const std::string from = stage.path().string() + ".from";
        std::ofstream(from) << kTheirs;
        Environment environment = faulty(stage.path(), static_cast<int>(i) + 1, kind);
        environment.push_back({"RIGC_FAULT_FILE", path});
        environment.push_back({"RIGC_FAULT_FROM", from});
        const Outcome outcome = stage.run(environment);
        CAPTURE(outcome.err);
        // The other's file, or what the command made of it; where it came late, an error.
        const std::string text = file_text(path);
        if (std::string(kind) == "remove") {
          CHECK(!fs::exists(path));
          CHECK(outcome.status == 3);
        } else {
          CHECK(text.starts_with(kTheirs));
          if (text == kTheirs) CHECK(outcome.status != 0);
        }
        if (outcome.status != 0) CHECK(outcome.err.find(file) != std::string::npos);
        fs::remove(from);
      }
    }
  }
}

TEST_CASE("faults: several commands on one file wait for each other") {
  const Command& command = commands().front();
  REQUIRE(command.name == "append");
  const Stage stage(command);
  stage.reset();
  fs::create_directories(stage.path() / "backup");
  Command unkept = command;
  unkept.arguments[0] = "";
  const Stage same(unkept);
  std::vector<Outcome> outcomes(6);
  std::vector<std::thread> threads;
  for (Outcome& outcome : outcomes)
    threads.emplace_back([&] {
      std::vector<std::string> words = same.arguments();
      Surroundings surroundings;
      surroundings.environment = {{"APPEND_PACE_MS", "20"}};
      outcome = run_program(unkept.binary, words, surroundings);
    });
  for (std::thread& thread : threads) thread.join();
  for (const Outcome& outcome : outcomes) CHECK(outcome.status == 0);
  for (const auto& [name, text] : command.before)
    CHECK(stage.files().at(name) == text + std::string(outcomes.size(), '+'));
}
