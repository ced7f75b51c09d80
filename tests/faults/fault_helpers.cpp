// SPDX-License-Identifier: MIT
// Running commands while something goes wrong.
#include "faults/fault_helpers.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

namespace rigc::test {

namespace fs = std::filesystem;

fs::path faults_folder() { return fs::path(RIGC_TEST_OUT) / "faults/broken"; }

namespace {

std::string named(const char* variable) {
  const char* value = std::getenv(variable);
  REQUIRE_MESSAGE(value, variable << " is not set; run the tests by ctest");
  return value;
}

bool is_temporary(const std::string& path) {
  const std::string name = fs::path(path).filename().string();
  return name.starts_with('.') && name.find(".rigc-") != std::string::npos;
}

/// What `rigc build` makes of a template.
Files built(const std::string& name) {
  const fs::path folder = faults_folder() / "built";
  fs::remove_all(folder);
  fs::create_directories(folder);
  const Outcome outcome =
      run_rigc({"build", (source_folder() / "templates/biped.yaml").string(), "-o", folder / name});
  REQUIRE_MESSAGE(outcome.status == 0, outcome.err);
  Files files;
  for (const auto& entry : fs::directory_iterator(folder))
    files[entry.path().filename()] = file_text(entry.path());
  fs::remove_all(folder);
  return files;
}

Command append_command() {
  Command command{"append", named("APPEND_COMMAND"), {"@/backup", "", "", "1"}, "", {}, {}};
  for (const char* name : {"a.glb", "b.glb"}) {
    command.arguments.push_back(std::string("@/") + name);
    // Above 64 KB a file is copied inside the system.
    command.before[name] = std::string(name[0] == 'a' ? 1000 : 100'000, name[0]);
  }
  return command;
}

/// A rig, and its template as the next version.
Command update_command(const std::string& rig) {
  Command command{"update_" + rig.substr(2), rigc_binary(), {}, rig, built(rig), {}};
  std::string text = file_text(source_folder() / "templates/biped.yaml");
  const std::string key = "\nversion: ";
  const std::size_t at = text.find(key);
  REQUIRE(at != std::string::npos);
  text.insert(at + key.size(), "9");
  command.before["templates/biped.yaml"] = text;
  command.arguments = {"update",      "@/" + rig,    "--templates",
                       "@/templates", "--templates", (source_folder() / "templates").string(),
                       "--backup",    "@/backup"};
  return command;
}

std::vector<Command> make_commands() {
  const std::string rigc = rigc_binary();
  const std::string biped = (source_folder() / "templates/biped.yaml").string();
  std::vector<Command> list;
  list.push_back(append_command());
  list.push_back(
      {"build", rigc, {"build", biped, "-o", "@/a.glb"}, "a.glb", {{"a.glb", "old"}}, {}});
  list.push_back(
      {"bake_glb", rigc, {"bake", "@/a.glb", "-o", "@/a.glb"}, "a.glb", built("a.glb"), {}});
  list.push_back(
      {"bake_gltf", rigc, {"bake", "@/a.gltf", "-o", "@/a.gltf"}, "", built("a.gltf"), {}});
  list.push_back(update_command("a.glb"));
  list.push_back(update_command("a.gltf"));
  for (Command& command : list) {
    const Stage stage(command);
    stage.reset();
    const Outcome outcome = stage.run();
    REQUIRE_MESSAGE(outcome.status == 0, command.name << ": " << outcome.err);
    command.after = stage.files();
    REQUIRE(command.after != command.before);
  }
  return list;
}

}  // namespace

Stage::Stage(const Command& command) : command_(command), folder_(faults_folder() / command.name) {}

void Stage::reset() const {
  fs::remove_all(folder_);
  fs::create_directories(folder_);
  for (const auto& [name, text] : command_.before) {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
}

std::vector<std::string> Stage::arguments() const {
  std::vector<std::string> words = command_.arguments;
  for (std::string& word : words)
    if (word.starts_with("@/")) word = folder_.string() + word.substr(1);
  return words;
}

Outcome Stage::run(const Environment& environment) const {
  Surroundings surroundings;
  surroundings.environment = environment;
  return run_program(command_.binary, arguments(), surroundings);
}

bool Stage::run_and_kill(unsigned microseconds) const {
  std::vector<std::string> words = arguments();
  words.insert(words.begin(), command_.binary);
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (int output : {STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&actions, output, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int failed =
      ::posix_spawn(&child, command_.binary.c_str(), &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  REQUIRE(failed == 0);
  ::usleep(microseconds);
  ::kill(child, SIGKILL);
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFSIGNALED(status);
}

Files Stage::files() const {
  Files files;
  for (const auto& entry : fs::recursive_directory_iterator(folder_))
    if (entry.is_regular_file())
      files[fs::relative(entry.path(), folder_).string()] = file_text(entry.path());
  return files;
}

const std::vector<Command>& commands() {
  static const std::vector<Command> list = make_commands();
  return list;
}

std::string damage(const Command& command, const Files& files, bool leftovers) {
  for (const auto& [name, text] : command.before)
    if (!files.count(name) && command.after.count(name)) return name + " is gone";
  for (const auto& [name, text] : files) {
    if (leftovers && is_temporary(name)) continue;
    const auto old = command.before.find(name), fresh = command.after.find(name);
    const bool is_old = old != command.before.end() && old->second == text;
    const bool is_new = fresh != command.after.end() && fresh->second == text;
    if (!is_old && !is_new) return name + " is neither the old one nor the new one";
  }
  return {};
}

Environment faulty(const fs::path& folder, int at, const std::string& kind) {
  return {{"LD_PRELOAD", named("RIGC_FAULT_SHIM")},
          {"RIGC_FAULT_FOLDER", folder.string()},
          {"RIGC_FAULT_AT", std::to_string(at)},
          {"RIGC_FAULT_KIND", kind}};
}

std::vector<std::string> calls_of(const Stage& stage) {
  const fs::path log = stage.path().string() + ".log";
  fs::remove(log);
  stage.reset();
  Environment environment = faulty(stage.path(), 0, "0");
  environment.push_back({"RIGC_FAULT_LOG", log.string()});
  const Outcome outcome = stage.run(environment);
  const auto calls = lines_of(file_text(log));
  fs::remove(log);
  REQUIRE_MESSAGE(!calls.empty(), "the shim is not preloaded into " << stage.command().binary);
  REQUIRE(outcome.status == 0);
  REQUIRE(stage.files() == stage.command().after);
  return calls;
}

int count_from_environment(const char* name, int otherwise) {
  const char* value = std::getenv(name);
  return value ? std::atoi(value) : otherwise;
}

}  // namespace rigc::test
