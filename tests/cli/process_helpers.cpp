// SPDX-License-Identifier: MIT
// Running the rigc program: posix_spawn with both outputs going to files, so that no pipe can fill
// up.
#include "cli/process_helpers.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace rigc::test {

namespace fs = std::filesystem;

namespace {

/// This process' environment with some variables set.
std::vector<std::string> environment_with(
    const std::vector<std::pair<std::string, std::string>>& changes) {
  std::vector<std::string> result;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    const std::string name = text.substr(0, text.find('='));
    bool changed = false;
    for (const auto& change : changes) changed = changed || change.first == name;
    if (!changed) result.push_back(text);
  }
  for (const auto& [name, value] : changes) result.push_back(name + "=" + value);
  return result;
}

std::vector<char*> pointers(std::vector<std::string>& strings) {
  std::vector<char*> result;
  for (std::string& text : strings) result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

void limit(pid_t child, __rlimit_resource resource, std::size_t most) {
  const rlimit both = {most, most};
  if (most != 0 && prlimit(child, resource, &both, nullptr) != 0 && errno != ESRCH)
    throw std::runtime_error("prlimit failed");
}

void wait_for(pid_t child, Outcome& outcome) {
  int status = 0;
  rusage usage{};
  while (wait4(child, &status, 0, &usage) < 0) {
    if (errno != EINTR) throw std::runtime_error("wait4 failed");
  }
  outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  outcome.peak_bytes = static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

}  // namespace

std::string rigc_binary() {
  const char* binary = std::getenv("RIGC_BINARY");
  if (binary == nullptr) throw std::runtime_error("RIGC_BINARY is not set; run the tests by ctest");
  return binary;
}

Outcome run_rigc(const std::vector<std::string>& arguments, const Surroundings& surroundings) {
  return run_program(rigc_binary(), arguments, surroundings);
}

Outcome run_program(const std::string& binary, const std::vector<std::string>& arguments,
                    const Surroundings& surroundings) {
  static std::atomic<int> runs{0};
  const fs::path stem = fs::temp_directory_path() /
                        ("rigc_test_" + std::to_string(getpid()) + "_" + std::to_string(++runs));
  const std::string out = stem.string() + ".out";
  const std::string err = stem.string() + ".err";

  std::vector<std::string> words = {binary};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<std::string> environment = environment_with(surroundings.environment);
  std::vector<char*> argv = pointers(words);
  std::vector<char*> envp = pointers(environment);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), O_CREAT | O_WRONLY, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), O_CREAT | O_WRONLY, 0600);
  posix_spawn_file_actions_addchdir_np(&actions, surroundings.folder.c_str());
  pid_t child = 0;
  const int failed =
      posix_spawn(&child, binary.c_str(), &actions, nullptr, argv.data(), envp.data());
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) throw std::runtime_error("cannot start " + binary);

  limit(child, RLIMIT_AS, surroundings.address_space);
  limit(child, RLIMIT_CPU, surroundings.cpu_seconds);

  Outcome outcome;
  wait_for(child, outcome);
  outcome.out = file_text(out);
  outcome.err = file_text(err);
  fs::remove(out);
  fs::remove(err);
  return outcome;
}

std::vector<Printed> printed_diagnostics(const std::string& err, const std::string& main_file) {
  static const std::regex form(
      R"(^(?:(?:(.*/)?([^/]*)):(\d+):(\d+)|.*?): (error|warning)\[(RIG\d{4})\]: .*)");
  std::vector<Printed> result;
  std::istringstream lines(err);
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (!std::regex_match(line, match, form)) continue;
    std::string place = "-";
    if (match[3].matched) {
      place = match[3].str() + ":" + match[4].str();
      if (match[2] != main_file) place = match[2].str() + ":" + place;
    }
    result.push_back({match[5] == "error", place + " " + match[6].str()});
  }
  return result;
}

fs::path fresh_folder(const std::string& name) {
  const fs::path folder = fs::path(RIGC_TEST_OUT) / "cli" / name;
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

std::string file_text(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> result;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const auto first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos || line[first] == '#') continue;
    result.push_back(line.substr(first, line.find_last_not_of(" \t\r") - first + 1));
  }
  return result;
}

fs::path source_folder() { return RIGC_SOURCE_DIR; }

fs::path corpus_folder() {
  const char* named = std::getenv("RIGC_CORPUS");
  const fs::path folder = named != nullptr ? fs::path(named) : source_folder() / "../shared/corpus";
  return fs::is_directory(folder) ? folder : fs::path();
}

}  // namespace rigc::test
