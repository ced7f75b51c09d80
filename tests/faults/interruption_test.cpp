// SPDX-License-Identifier: MIT
// Signals to a command over many files, going on after them, and what a terminal shows meanwhile.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>

#include "faults/fault_helpers.h"

using namespace rigc::test;
namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

constexpr int kFiles = 40;

/// A folder of small files, and append_command over it.
class Run {
 public:
  explicit Run(const std::string& name) : folder_(faults_folder() / name) {
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "in");
    for (int i = 0; i < kFiles; ++i) std::ofstream(file(i)) << "text";
  }
  fs::path file(int i) const { return folder_ / "in" / (std::to_string(100 + i) + ".glb"); }
  fs::path report() const { return folder_ / "r.json"; }

  /// Files that have become `text`.
  int count(const std::string& text) const {
    int found = 0;
    for (int i = 0; i < kFiles; ++i) found += file_text(file(i)) == text ? 1 : 0;
    return found;
  }

  /// Starts the command, each file taking `pace` milliseconds; what it says goes to a file, or to
  /// `terminal`.
  pid_t start(int pace, const std::string& resume = "", const std::string& terminal = "") const {
    std::vector<std::string> words = {
        std::getenv("APPEND_COMMAND"), "", report(), resume, "2", folder_ / "in"};
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    std::string variable = "APPEND_PACE_MS=" + std::to_string(pace);
    std::vector<char*> environment = {variable.data(), nullptr};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    const std::string err = terminal.empty() ? (folder_ / "err").string() : terminal;
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, (folder_ / "out").c_str(),
                                     O_CREAT | O_TRUNC | O_WRONLY, 0600);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(),
                                     O_CREAT | O_TRUNC | O_WRONLY | O_NOCTTY, 0600);
    pid_t child = 0;
    const int failed =
        ::posix_spawn(&child, argv[0], &actions, nullptr, argv.data(), environment.data());
    posix_spawn_file_actions_destroy(&actions);
    REQUIRE(failed == 0);
    return child;
  }

  std::string out() const { return file_text(folder_ / "out"); }
  std::string err() const { return file_text(folder_ / "err"); }

 private:
  fs::path folder_;
};

/// Exit status; 128 + signal where one ended it.
int finish(pid_t child) {
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

void wait_for_first(const Run& run, pid_t child) {
  while (run.count("text+") == 0 && ::kill(child, 0) == 0) ::usleep(1000);
}

}  // namespace

TEST_CASE("faults: after a signal files in work are finished, and --resume does the others") {
  for (int signal : {SIGINT, SIGTERM}) {
    const Run run("interrupted");
    const pid_t child = run.start(100);
    wait_for_first(run, child);
    ::kill(child, signal);
    CHECK(finish(child) == 1);
    CHECK(run.err().find("error[RIG0813]: interrupted") != std::string::npos);
    CHECK(run.out().find(" not begun\n") != std::string::npos);
    const int done = run.count("text+");
    CHECK(done < kFiles);
    CHECK(done + run.count("text") == kFiles);
    const Json report = Json::parse(file_text(run.report()));
    CHECK(report["interrupted"] == true);
    CHECK(report["totals"]["changed"] == done);
    CHECK(report["totals"]["remaining"] == kFiles - done);

    CHECK(finish(run.start(0, run.report())) == 0);
    CHECK(run.count("text+") == kFiles);
    CHECK(Json::parse(file_text(run.report()))["totals"]["changed"] == kFiles);
  }
}

TEST_CASE("faults: a second signal ends the command at once, and files are whole") {
  const Run run("interrupted_twice");
  int status = 0;
  // A signal that comes before any file is begun ends the command as it should: then once more.
  for (int attempt = 0; attempt < 10 && !WIFSIGNALED(status); ++attempt) {
    fs::remove(run.report());
    const pid_t child = run.start(60'000);
    // Signals are watched for before the first report is written.
    while (!fs::exists(run.report())) ::usleep(1000);
    ::usleep(50'000);
    // Two that come at the same time are one.
    do {
      ::kill(child, SIGINT);
      ::usleep(20'000);
    } while (::waitpid(child, &status, WNOHANG) == 0);
  }
  CHECK(WIFSIGNALED(status));
  CHECK(run.count("text") == kFiles);
  // The report from the beginning is there: everything is to be done.
  CHECK(Json::parse(file_text(run.report()))["totals"]["remaining"] == kFiles);
}

TEST_CASE("faults: a terminal shows one line that is rewritten and taken away") {
  const int terminal = ::posix_openpt(O_RDWR | O_NOCTTY);
  const bool ready = terminal >= 0 && ::grantpt(terminal) == 0 && ::unlockpt(terminal) == 0;
  if (!ready) {
    MESSAGE("left out: there are no pseudo-terminals");
    return;
  }
  const Run run("terminal");
  const pid_t child = run.start(25, "", ::ptsname(terminal));
  std::string shown;
  char block[4096];
  while (true) {
    const ssize_t got = ::read(terminal, block, sizeof block);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;  // the other end is closed
    shown.append(block, static_cast<std::size_t>(got));
  }
  ::close(terminal);
  CHECK(finish(child) == 0);
  const auto lines = std::count(shown.begin(), shown.end(), '\r');
  CHECK(lines >= 2);
  CHECK(lines <= kFiles);
  CHECK(shown.find(" of 40 files, ") != std::string::npos);
  CHECK(shown.find('\n') == std::string::npos);
  CHECK(shown.ends_with("\r\x1b[K"));
  CHECK(run.out().find("        40 changed\n") != std::string::npos);
}
