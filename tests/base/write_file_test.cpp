// SPDX-License-Identifier: MIT
// Tests of write_file in src/base/files.h: old content or new, and nothing left behind.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/codes.h"
#include "base/files.h"
#include "base/files_helpers.h"

using namespace rigc;
using test::TestFolder;

namespace {

/// The code of the error that writing gives, 0 for none.
int write_code(const std::string& path, std::string_view text = "new") {
  Diagnostics diagnostics;
  const bool done = write_file(path, {text}, diagnostics);
  CHECK(done == diagnostics.ok());
  return diagnostics.all().empty() ? 0 : diagnostics.all()[0].code->number;
}

mode_t mode_of(const std::string& path) {
  struct stat status {};
  CHECK(::stat(path.c_str(), &status) == 0);
  return status.st_mode & 07777;
}

void make_old(const std::string& path) {
  const timespec times[2] = {{1000, 0}, {1000, 0}};
  CHECK(::utimensat(AT_FDCWD, path.c_str(), times, 0) == 0);
}

}  // namespace

TEST_CASE("base write: new files and replaced ones") {
  const TestFolder folder("write");
  Diagnostics diagnostics;
  CHECK(write_file(folder / "a", {"one ", "", "two"}, diagnostics));
  CHECK(folder.get("a") == "one two");
  CHECK(write_file(folder / "a", {}, diagnostics));
  CHECK(folder.get("a") == "");
  const std::string big(5'000'000, 'x');
  CHECK(write_file(folder / "a", {big, big}, diagnostics));
  CHECK(folder.get("a").size() == 10'000'000);
  CHECK(write_file(folder / std::string(255, 'n'), {"long name"}, diagnostics));
  CHECK(diagnostics.all().empty());
  CHECK(folder.count() == 2);
}

TEST_CASE("base write: the mode of a replaced file stays, new ones follow the umask") {
  const TestFolder folder("mode");
  folder.put("a", "old");
  REQUIRE(::chmod((folder / "a").c_str(), 0640) == 0);
  CHECK(write_code(folder / "a") == 0);
  CHECK(mode_of(folder / "a") == 0640);
  const mode_t mask = ::umask(027);
  CHECK(write_code(folder / "b") == 0);
  ::umask(mask);
  CHECK(mode_of(folder / "b") == 0640);
}

TEST_CASE("base write: the target of a symbolic link is replaced") {
  const TestFolder folder("link");
  std::filesystem::create_directory(folder / "sub");
  folder.put("sub/real", "old");
  std::filesystem::create_symlink("sub/real", folder / "one");
  std::filesystem::create_symlink("one", folder / "two");
  CHECK(write_code(folder / "two") == 0);
  CHECK(folder.get("sub/real") == "new");
  CHECK(std::filesystem::is_symlink(folder / "two"));
  std::filesystem::create_symlink("sub/later", folder / "dangling");
  CHECK(write_code(folder / "dangling") == 0);
  CHECK(folder.get("sub/later") == "new");
  std::filesystem::create_symlink("loop", folder / "loop");
  CHECK(write_code(folder / "loop") == codes::kCannotWrite.number);
  std::filesystem::create_symlink("none/x", folder / "nowhere");
  CHECK(write_code(folder / "nowhere") == codes::kNoSuchFolder.number);
}

TEST_CASE("base write: what is refused leaves nothing behind") {
  const TestFolder folder("refused");
  std::filesystem::create_directory(folder / "sub");
  REQUIRE(::mkfifo((folder / "fifo").c_str(), 0600) == 0);
  folder.put("a", "old");
  CHECK(write_code(folder / "none/a") == codes::kNoSuchFolder.number);
  CHECK(write_code(folder / "a/b") != 0);
  CHECK(write_code(folder / "sub") == codes::kNotRegularFile.number);
  CHECK(write_code(folder / "fifo") == codes::kNotRegularFile.number);
  CHECK(write_code("/dev/null") == codes::kNotRegularFile.number);
  CHECK(write_code("") == codes::kCannotWrite.number);
  CHECK(write_code(folder / "sub/") == codes::kCannotWrite.number);
  CHECK(write_code(folder / std::string("b\0c", 3)) == codes::kCannotWrite.number);
  CHECK(write_code(folder / std::string(256, 'n')) == codes::kCannotWrite.number);
  CHECK(write_code("/proc/rigc_test") == codes::kCannotWrite.number);
  CHECK(folder.count() == 3);
  CHECK(folder.get("a") == "old");
}

TEST_CASE("base write: hard links are reported") {
  const TestFolder folder("hard");
  folder.put("a", "old");
  std::filesystem::create_hard_link(folder / "a", folder / "b");
  CHECK(write_code(folder / "a") == codes::kHardLink.number);
  CHECK(folder.get("a") == "new");
  CHECK(folder.get("b") == "old");
}

TEST_CASE("base write: the old file stays when the disk refuses") {
  const TestFolder folder("full");
  folder.put("a", "old");
  // A limit on the size of files stands for the full disk; in a child, because it cannot be undone.
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{4096, 4096};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    Diagnostics diagnostics;
    const bool done = write_file(folder / "a", {std::string(10'000, 'x')}, diagnostics);
    const bool refused = !done && diagnostics.file_system_refused() &&
                         diagnostics.all()[0].code->number == codes::kCannotWrite.number;
    ::_exit(refused ? 0 : 1);
  }
  int status = -1;
  ::waitpid(child, &status, 0);
  CHECK(status == 0);
  CHECK(folder.get("a") == "old");
  CHECK(folder.count() == 1);
}

TEST_CASE("base write: files and folders without permission, as an ordinary user") {
  if (::geteuid() != 0) return;
  const TestFolder folder("permission");
  folder.put("a", "old");
  std::filesystem::create_directory(folder / "sub");
  REQUIRE(::chmod((folder / "a").c_str(), 0444) == 0);
  REQUIRE(::chmod(folder.path().c_str(), 0777) == 0);
  REQUIRE(::chmod((folder / "sub").c_str(), 0755) == 0);
  const pid_t child = ::fork();
  if (child == 0) {
    if (::chdir(folder.path().c_str()) != 0 || ::setgid(65534) != 0 || ::setuid(65534) != 0)
      ::_exit(9);
    Diagnostics diagnostics;
    const auto code = [&](std::size_t i) { return diagnostics.all().at(i).code->number; };
    const bool first = write_file("a", {"new"}, diagnostics);
    const bool second = write_file("sub/b", {"new"}, diagnostics);
    const bool right = !first && !second && code(0) == codes::kWriteProtected.number &&
                       code(1) == codes::kCannotWrite.number;
    ::_exit(right ? 0 : 1);
  }
  int status = -1;
  ::waitpid(child, &status, 0);
  CHECK(status == 0);
  CHECK(folder.get("a") == "old");
  CHECK(folder.count() == 2);
}

TEST_CASE("base write: leftovers of killed processes go, others stay") {
  const TestFolder folder("leftovers");
  for (const char* name : {".a.rigc-1-0.tmp", ".a.rigc-1-1.tmp", ".b.rigc-1-0.tmp", ".a.tmp"})
    folder.put(name, "x");
  make_old(folder / ".a.rigc-1-0.tmp");
  make_old(folder / ".b.rigc-1-0.tmp");
  make_old(folder / ".a.tmp");
  CHECK(write_code(folder / "a") == 0);
  CHECK(!file_exists(folder / ".a.rigc-1-0.tmp"));
  CHECK(file_exists(folder / ".a.rigc-1-1.tmp"));
  CHECK(file_exists(folder / ".b.rigc-1-0.tmp"));
  CHECK(file_exists(folder / ".a.tmp"));
  CHECK(list_folder(folder.path()) == std::vector<std::string>{".a.tmp", "a"});
}

TEST_CASE("base write: whoever is killed, the file is the old one or the new one") {
  const TestFolder folder("killed");
  const std::string old(300'000, 'o'), fresh(300'000, 'n');
  for (int i = 0; i < 30; ++i) {
    folder.put("a", old);
    const pid_t child = ::fork();
    if (child == 0) {
      Diagnostics diagnostics;
      while (true) {
        if (!write_file(folder / "a", {fresh}, diagnostics)) ::_exit(1);
        if (!write_file(folder / "a", {old}, diagnostics)) ::_exit(1);
      }
    }
    ::usleep(static_cast<useconds_t>(500 + 700 * i));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    CHECK(WIFSIGNALED(status));
    const std::string text = folder.get("a");
    const bool is_whole = text == old || text == fresh;
    CHECK(is_whole);
  }
}

namespace {

/// The code that writing gives where exactly what was opened must still be there.
int replace_code(const std::string& path, const Bytes& read) {
  Diagnostics diagnostics;
  WriteSettings settings;
  settings.expected = read.version();
  write_file(path, {"ours"}, diagnostics, settings);
  return diagnostics.ok() ? 0 : diagnostics.all()[0].code->number;
}

Bytes opened(const std::string& path) {
  Diagnostics diagnostics;
  const auto bytes = Bytes::open(path, 1 << 20, diagnostics);
  REQUIRE(bytes);
  REQUIRE(bytes->version());
  return *bytes;
}

}  // namespace

TEST_CASE("base write: what another program made of a file since it was read is not replaced") {
  const TestFolder folder("expected");
  folder.put("a", "old");
  CHECK(replace_code(folder / "a", opened(folder / "a")) == 0);
  CHECK(folder.get("a") == "ours");
  SUBCASE("changed") {
    const Bytes read = opened(folder / "a");
    folder.put("a", "longer than ours");
    CHECK(replace_code(folder / "a", read) == codes::kFileReplaced.number);
    CHECK(folder.get("a") == "longer than ours");
  }
  SUBCASE("replaced by one of the same size and time") {
    const Bytes read = opened(folder / "a");
    folder.put("b", "his!");
    make_old(folder / "b");
    make_old(folder / "a");
    std::filesystem::rename(folder / "b", folder / "a");
    CHECK(replace_code(folder / "a", read) == codes::kFileReplaced.number);
    CHECK(folder.get("a") == "his!");
  }
  SUBCASE("vanished") {
    const Bytes read = opened(folder / "a");
    std::filesystem::remove(folder / "a");
    CHECK(replace_code(folder / "a", read) == codes::kFileReplaced.number);
    CHECK(!file_exists(folder / "a"));
  }
  SUBCASE("the link points elsewhere") {
    folder.put("b", "ours");
    std::filesystem::create_symlink("a", folder / "link");
    const Bytes read = opened(folder / "link");
    std::filesystem::remove(folder / "link");
    std::filesystem::create_symlink("b", folder / "link");
    CHECK(replace_code(folder / "link", read) == codes::kFileReplaced.number);
    CHECK(folder.get("b") == "ours");
  }
  SUBCASE("only its mode") {
    const Bytes read = opened(folder / "a");
    REQUIRE(::chmod((folder / "a").c_str(), 0604) == 0);
    CHECK(replace_code(folder / "a", read) == codes::kFileReplaced.number);
    CHECK(mode_of(folder / "a") == 0604);
  }
  CHECK(folder.count() <= 3);
}

TEST_CASE("base write: a new file has the mode that is wanted, a replaced one keeps its own") {
  const TestFolder folder("wanted_mode");
  Diagnostics diagnostics;
  WriteSettings settings;
  settings.mode = 0600;
  CHECK(write_file(folder / "a", {"new"}, diagnostics, settings));
  CHECK(mode_of(folder / "a") == 0600);
  settings.mode = 0640;
  CHECK(write_file(folder / "a", {"newer"}, diagnostics, settings));
  CHECK(mode_of(folder / "a") == 0600);
}
