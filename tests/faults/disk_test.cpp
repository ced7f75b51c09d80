// SPDX-License-Identifier: MIT
// Disks that are full and folders that cannot be written to.
#include <doctest/doctest.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <functional>

#include "faults/fault_helpers.h"

using namespace rigc::test;
namespace fs = std::filesystem;

namespace {

/// Runs the command from a child that `prepare` has made worse off; what it says goes to `said`.
int run_prepared(const Stage& stage, const std::function<bool()>& prepare, std::string& said) {
  const fs::path log = stage.path().string() + ".said";
  fs::remove(log);
  std::ofstream(log).close();
  fs::permissions(log, fs::perms::all);
  std::vector<std::string> words = stage.arguments();
  words.insert(words.begin(), stage.command().binary);
  const pid_t child = ::fork();
  if (child == 0) {
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    const bool ready = std::freopen(log.c_str(), "w", stderr) != nullptr &&
                       std::freopen("/dev/null", "w", stdout) != nullptr && prepare();
    if (ready) ::execv(argv[0], argv.data());
    ::_exit(99);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  said = file_text(log);
  fs::remove(log);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

bool become_nobody() { return ::setgid(65534) == 0 && ::setuid(65534) == 0; }

/// Whether an ordinary user can run the program and reach the folder.
bool nobody_can(const Stage& stage, const Command& command) {
  const pid_t child = ::fork();
  if (child == 0) {
    const bool can = become_nobody() && ::access(command.binary.c_str(), X_OK) == 0 &&
                     ::access(stage.path().c_str(), R_OK) == 0;
    ::_exit(can ? 0 : 1);
  }
  int status = 1;
  ::waitpid(child, &status, 0);
  return status == 0;
}

/// A file system of a few pages in memory, as long as this lives; only root can have one.
class SmallDisk {
 public:
  SmallDisk(const fs::path& folder, std::size_t bytes) : folder_(folder) {
    const std::string options = "size=" + std::to_string(bytes);
    mounted_ = ::mount("tmpfs", folder.c_str(), "tmpfs", 0, options.c_str()) == 0;
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  ~SmallDisk() {
    if (mounted_) ::umount2(folder_.c_str(), MNT_DETACH);
  }
  bool mounted() const { return mounted_; }

 private:
  fs::path folder_;
  bool mounted_;
};

}  // namespace

TEST_CASE("faults: the disk fills, at any size") {
  for (const Command& command : commands()) {
    CAPTURE(command.name);
    std::size_t before = 0, needed = 0;
    for (const auto& [name, text] : command.before) before += text.size() + 8192;
    for (const auto& [name, text] : command.after) needed += text.size() + 8192;
    for (std::size_t free = 0; free <= needed; free += needed / 6 + 1) {
      const Stage stage(command);
      stage.reset();
      const SmallDisk disk(stage.path(), before + free);
      if (!disk.mounted()) {
        MESSAGE("left out: only root can mount a small disk (" << std::strerror(errno) << ")");
        return;
      }
      stage.put_files();
      REQUIRE(stage.files() == command.before);
      const Outcome outcome = stage.run();
      CAPTURE(outcome.err);
      CHECK((outcome.status == 0 || outcome.status == 3));
      if (outcome.status == 3) CHECK(outcome.err.find("No space left") != std::string::npos);
      CHECK(damage(command, stage.files(), false) == "");
    }
  }
}

TEST_CASE("faults: files may not become as large as they would") {
  for (const Command& command : commands()) {
    CAPTURE(command.name);
    const Stage stage(command);
    stage.reset();
    std::string said;
    const int status = run_prepared(
        stage,
        [] {
          ::signal(SIGXFSZ, SIG_IGN);
          const rlimit limit{512, 512};
          return ::setrlimit(RLIMIT_FSIZE, &limit) == 0;
        },
        said);
    CHECK(status == 3);
    CHECK(damage(command, stage.files(), false) == "");
    if (command.name != "append") CHECK(stage.files() == command.before);
  }
}

TEST_CASE("faults: a folder that cannot be written to") {
  for (const Command& command : commands()) {
    CAPTURE(command.name);
    const Stage stage(command);
    stage.reset();
    const bool root = ::geteuid() == 0;
    fs::permissions(stage.path(), fs::perms::owner_read | fs::perms::owner_exec |
                                      fs::perms::others_read | fs::perms::others_exec);
    // Root may write everywhere.
    for (const auto& [name, text] : command.before)
      if (root && ::chown((stage.path() / name).c_str(), 65534, 65534) != 0) return;
    if (root && !nobody_can(stage, command)) {
      MESSAGE("left out: an ordinary user cannot reach " << stage.path().string());
      return;
    }
    std::string said;
    const int status = run_prepared(
        stage, [&] { return !root || become_nobody(); }, said);
    fs::permissions(stage.path(), fs::perms::owner_all);
    CHECK(status == 3);
    INFO(said);
    CHECK(said.find("Permission denied") != std::string::npos);
    CHECK(stage.files() == command.before);
  }
}
